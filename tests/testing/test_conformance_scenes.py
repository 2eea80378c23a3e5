"""Scenes are held to their references, constants and dimensions; broken ones are caught."""

import numpy as np
import pytest
from broken_scenes import SPECS

import samplekit
from samplekit._registry import BUILTIN, registry
from samplekit.testing import check_scene
from samplekit.testing._result import broken
from samplekit.testing._suite import SUITES

pytestmark = pytest.mark.slow

NAMES = [name for name, offer in registry().all("scene").items() if offer.plugin.name == BUILTIN]


@pytest.mark.parametrize("name", NAMES)
def test_our_scenes_conform(name):
    # Lattices in four dimensions take seconds: `samplekit check` runs them.
    only = None if len(samplekit.scene(name).needs) == 1 else [c.name for c in SUITES["scene"] if c.name != "reference"]
    outcomes = check_scene(name, quick=True, only=only)
    assert not broken(outcomes), [(each.check, each.message) for each in broken(outcomes)]


@pytest.mark.parametrize(("spec", "check"), SPECS, ids=lambda each: getattr(each, "name", each))
def test_a_broken_scene_is_caught(spec, check):
    outcome = next(each for each in check_scene(spec, quick=True) if each.check == check)
    assert outcome.status == "failed", outcome
    assert not outcome.message.startswith("raised"), outcome.message


def test_the_quadrature_is_right():
    """Its own error, against integrals in closed form: smooth to 1e-10, a disk within what it says."""
    from samplekit.testing._checks.scenes import _quadrature
    from samplekit.testing._subject import SceneSubject

    box = np.array([0.25, 0.5, 0.125, 0.25])
    mean, tolerance = _quadrature(SceneSubject("bilinear"), box, 100)
    assert abs(mean - 0.5 * 0.25) <= tolerance <= 1e-10
    mean, tolerance = _quadrature(SceneSubject("disk:radius=0.4,cx=0.5,cy=0.5"), np.array([0.0, 1.0, 0.0, 1.0]), 100)
    assert abs(mean - np.pi * 0.16) <= tolerance < 5e-3


@pytest.mark.parametrize("name", ["ellipse:aspect=1e-4", "spike:area=1e-6"])
def test_what_passes_between_the_nodes_of_a_quadrature_is_not_blamed(name):
    """Rules of 16 and 32 nodes both see nothing, and agree: that is no convergence."""
    outcomes = check_scene(name, quick=True, only=["reference"])
    assert not broken(outcomes), [(each.check, each.message) for each in broken(outcomes)]
