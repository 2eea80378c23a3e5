"""The samplers, randomizers and scenes that come with samplekit, offered through the same hooks as any stranger's."""

from __future__ import annotations

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
        ),
        RandomizerSpec(
            "owen",
            _RANDOMIZERS + "owen:Owen",
            "nested uniform scrambling of the digits",
            reference="Owen 1995; Laine, Karras 2011; Burley 2020",
            keeps=("net",),
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
    ]
