"""Scenes with one thing wrong each, and the check that must see it."""

import numpy as np

from samplekit import Scene, SceneSpec


class Ramp(Scene):
    """x + y, right."""

    error = 0.0

    def value(self, points):
        return points[0] + points[1]

    def exact(self, x_edges, y_edges):
        middles = np.add.outer((y_edges[:-1] + y_edges[1:]) / 2, (x_edges[:-1] + x_edges[1:]) / 2)
        return middles + self.error


class SlightlyWrong(Ramp):
    error = 1e-9


class HalfAPixelOff(Ramp):
    def exact(self, x_edges, y_edges):
        return np.add.outer(y_edges[:-1], (x_edges[:-1] + x_edges[1:]) / 2)


class WrongDisk(Scene):
    """A disk whose reference is that of a larger one."""

    def value(self, points):
        return ((points[0] - 0.5) ** 2 + (points[1] - 0.5) ** 2 < 0.3**2).astype(float)

    def exact(self, x_edges, y_edges):
        from samplekit._builtin.scenes.disk import Disk

        return Disk(0.302, 0.5, 0.5).exact(x_edges, y_edges)


class CallsToomuchConstant(WrongDisk):
    def exact(self, x_edges, y_edges):
        from samplekit._builtin.scenes.disk import Disk

        return Disk(0.3, 0.5, 0.5).exact(x_edges, y_edges)

    def constant(self, x_edges, y_edges):
        # By the corner of the pixel alone.
        inside = np.add.outer((y_edges[:-1] - 0.5) ** 2, (x_edges[:-1] - 0.5) ** 2) < 0.3**2
        return inside.astype(float)


class DrawsALensForNothing(Ramp):
    def dimensions(self):
        return {"pixel": 2, "lens": 2}


class CountsItsCalls(Ramp):
    calls = 0

    def value(self, points):
        CountsItsCalls.calls += 1
        return points[0] + points[1] + 1e-9 * CountsItsCalls.calls


class KnowsALowerMaximum(Ramp):
    value_range = (0.0, 1.9)


def spec(name, target, **declared):
    return SceneSpec(name, f"broken_scenes:{target}", f"{name}: for tests", **declared)


SPECS = [
    (spec("slightly-wrong", "SlightlyWrong"), "reference"),
    (spec("half-a-pixel-off", "HalfAPixelOff"), "reference"),
    (spec("not-additive", "HalfAPixelOff"), "refinement"),
    (spec("wrong-disk", "WrongDisk"), "reference"),
    (spec("calls-too-much-constant", "CallsToomuchConstant"), "constants"),
    (spec("draws-a-lens", "DrawsALensForNothing", purposes=(("pixel", 2), ("lens", 2))), "dimensions-used"),
    (spec("undeclared-purpose", "DrawsALensForNothing"), "dimensions-used"),
    (spec("counts-its-calls", "CountsItsCalls"), "purity"),
    (spec("knows-a-lower-maximum", "KnowsALowerMaximum"), "value-range"),
]
