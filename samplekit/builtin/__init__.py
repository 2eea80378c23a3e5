"""The samplers, randomizers and scenes that come with samplekit, offered through the same hooks as any stranger's."""

from __future__ import annotations

import math

from samplekit.builtin.declarations.samplers import SAMPLERS
from samplekit.hookspecs import hookimpl
from samplekit.specs import Option, RandomizerSpec, SamplerSpec, SceneSpec

_RANDOMIZERS = "samplekit.builtin.randomizers."
_SCENES = "samplekit.builtin.scenes."
_CENTRE = (
    Option("cx", 0.4523, "centre, from the left edge"),
    Option("cy", 0.5317, "centre, from the top edge"),
)


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """The built-in samplers."""
    return list(SAMPLERS)


@hookimpl
def samplekit_randomizers() -> list[RandomizerSpec]:
    """The built-in randomizers."""
    return [
        RandomizerSpec(
            "shift",
            _RANDOMIZERS + "shift:Shift",
            "one random toroidal shift of the whole set: homogenisation",
            reference="Cranley, Patterson 1976",
            keeps=("distance",),
        ),
        RandomizerSpec(
            "xor",
            _RANDOMIZERS + "xor:Xor",
            "one random digit added at each place",
            reference="L'Ecuyer, Lemieux 2002",
            keeps=("net",),
            largest_index=2**32 - 1,
        ),
        RandomizerSpec(
            "owen",
            _RANDOMIZERS + "owen:Owen",
            "nested uniform scrambling of the digits",
            reference="Owen 1995; Laine, Karras 2011; Burley 2020",
            keeps=("net",),
            largest_index=2**32 - 1,
        ),
    ]


@hookimpl
def samplekit_scenes() -> list[SceneSpec]:
    """The built-in scenes."""
    return [
        SceneSpec(
            "disk",
            _SCENES + "disk:Disk",
            "1 inside a disk, 0 outside",
            options=(Option("radius", 0.3, "radius", 0.0), *_CENTRE),
        ),
        SceneSpec(
            "gaussian",
            _SCENES + "gaussian:Gaussian",
            "exp(-|x - c|^2 / 2 sigma^2)",
            options=(Option("sigma", 0.1, "standard deviation", 1e-150), *_CENTRE),
        ),
        SceneSpec(
            "zoneplate",
            _SCENES + "zoneplate:ZonePlate",
            "1/2 + 1/2 cos(k |x - c|^2)",
            options=(
                Option("k", 1024.0, "radians at distance 1", 0.0),
                Option("cx", 0.0, "centre, from the left edge"),
                Option("cy", 0.0, "centre, from the top edge"),
            ),
        ),
        SceneSpec(
            "step",
            _SCENES + "step:Step",
            "1 on one side of a line",
            options=(
                Option("angle", 0.0, "of the line's normal from the x axis, degrees"),
                Option("offset", 0.5, "distance of the line from the origin"),
            ),
        ),
        SceneSpec(
            "checker",
            _SCENES + "checker:Checker",
            "a checkerboard",
            options=(Option("cells", 8, "along a side", 1, 2**20),),
        ),
        SceneSpec("bilinear", _SCENES + "bilinear:Bilinear", "x times y"),
        SceneSpec(
            "depth-of-field",
            _SCENES + "depth_of_field:DepthOfField",
            "disks, a ring and a wall through a thin lens",
            reference="Cook, Porter, Carpenter 1984; Shirley, Chiu 1997 (the lens)",
            options=(
                Option("aperture", 0.1, "diameter of the lens; 0: a pinhole", 0.0, 1e12),
                Option("focus", 1.0, "depth in focus: 0.5 disks, 1 ring, 2 wall", 0.0, math.inf),
            ),
            purposes=(("pixel", 2), ("lens", 2)),
        ),
        SceneSpec(
            "motion-blur",
            _SCENES + "motion_blur:MotionBlur",
            "moving disks over a board, through a lens if need be",
            reference="Cook, Porter, Carpenter 1984",
            options=(
                Option("shutter", 0.5, "time that it is open; 0: all stands still", 0.0, 1e6),
                Option("aperture", 0.0, "diameter of the lens; 0: a pinhole", 0.0, 1e6),
            ),
            purposes=(("pixel", 2), ("lens", 2), ("time", 1)),
        ),
        SceneSpec(
            "ambient-occlusion",
            _SCENES + "ambient_occlusion:AmbientOcclusion",
            "the sky that a floor and a sphere see",
            reference="Langer, Bülthoff 2000",
            options=(
                Option("radius", 0.9, "of the sphere; 0: none", 0.0, 1e6),
                Option("height", 1.0, "of the sphere's centre, at least the radius", 0.0, 1e6),
                Option("cx", 0.0, "where the sphere stands, to the right", -1e6, 1e6),
                Option("cy", 0.0, "where the sphere stands, to the back", -1e6, 1e6),
            ),
            purposes=(("pixel", 2), ("direction", 2)),
        ),
    ]
