"""The samplers, randomizers and scenes that come with samplekit, offered through the same hooks as any stranger's."""

from __future__ import annotations

import math

from samplekit import CommandSpec, Option, RandomizerSpec, SamplerSpec, SceneSpec, hookimpl
from samplekit._builtin.declarations.commands import COMMANDS
from samplekit._builtin.declarations.samplers import SAMPLERS

_RANDOMIZERS = "samplekit._builtin.randomizers."
_SCENES = "samplekit._builtin.scenes."
_GENZ = ("oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous")
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
            extremes=tuple(f"radius={radius}" for radius in ("0.3", "1e-2", "1e-4", "1e-6", "1e-9", "0.5317", "1e9")),
        ),
        SceneSpec(
            "ellipse",
            _SCENES + "ellipse:Ellipse",
            "1 inside an ellipse; a needle if its aspect is small",
            options=(
                Option("radius", 0.3, "half of the longer axis", 1e-60, 1e60),
                Option("aspect", 0.1, "shorter axis over longer", 1e-12, 1.0),
                Option("angle", 30.0, "of the longer axis from the x axis, degrees"),
                *_CENTRE,
            ),
            extremes=tuple(f"aspect={aspect}" for aspect in ("1", "1e-1", "1e-3", "1e-5", "1e-7", "1e-9")),
        ),
        SceneSpec(
            "gaussian",
            _SCENES + "gaussian:Gaussian",
            "exp(-|x - c|^2 / 2 sigma^2)",
            options=(Option("sigma", 0.1, "standard deviation", 1e-150), *_CENTRE),
            extremes=tuple(f"sigma={s}" for s in ("1e8", "1e3", "0.1", "1e-2", "1e-3", "1e-5", "1e-8", "1e-12")),
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
            extremes=tuple(f"k={k}" for k in ("1e-8", "1", "1024", "1e6", "1e9", "1e12")),
        ),
        SceneSpec(
            "step",
            _SCENES + "step:Step",
            "1 on one side of a line, sheer or as a sigmoid",
            options=(
                Option("angle", 0.0, "of the line's normal from the x axis, degrees"),
                Option("offset", 0.5, "distance of the line from the origin"),
                Option("width", 0.0, "of the sigmoid; 0: sheer", 0.0, 1e150),
            ),
            extremes=tuple(
                f"angle=27,offset=0.61,width={width}" for width in ("1", "1e-1", "1e-2", "1e-4", "1e-8", "1e-15", "0")
            ),
        ),
        SceneSpec(
            "checker",
            _SCENES + "checker:Checker",
            "a checkerboard",
            options=(Option("cells", 8, "along a side", 1, 2**20),),
            extremes=tuple(f"cells={cells}" for cells in (1, 7, 1001, 2**20 - 1)),
        ),
        SceneSpec("bilinear", _SCENES + "bilinear:Bilinear", "x times y"),
        SceneSpec(
            "power",
            _SCENES + "power:Power",
            "x^-a, unbounded at the left edge; the variance is finite for a < 0.5",
            reference="Owen 2006",
            options=(Option("a", 0.25, "exponent", 0.0, 0.99),),
            extremes=tuple(f"a={a}" for a in (0, 0.25, 0.4, 0.49, 0.6, 0.9, 0.99)),
        ),
        SceneSpec(
            "spike",
            _SCENES + "spike:Spike",
            "a small bright square on a dark ground",
            options=(
                Option("peak", 1e30, "value in the square", 0.0, 1e290),
                Option("background", 1e-30, "value elsewhere", 0.0, 1e290),
                Option("area", 1e-4, "of the square", 1e-30, 1.0),
                *_CENTRE,
            ),
            extremes=tuple(f"area={area}" for area in ("1e-1", "1e-2", "1e-4", "1e-6", "1e-9", "1e-12")),
        ),
        SceneSpec(
            "oscillating",
            _SCENES + "oscillating:Oscillating",
            "Genz's six families of integrands in 1 to 12 dimensions",
            reference="Genz 1984",
            options=(
                Option("family", "oscillatory", "of integrands", choices=_GENZ),
                Option("d", 2, "dimensions", 1, 12),
                Option("difficulty", 10.0, "sum of the coefficients", 1e-9, 1e12),
                Option("u", 0.4523, "place of the peak, kink or step; phase in turns", 0.0, 1.0),
            ),
            purposes=(("pixel", 2), ("further", 10)),
            extremes=tuple(
                f"family={family},d={d},difficulty={difficulty}"
                for family in _GENZ
                for d, difficulty in ((1, "10"), (4, "1e-9"), (4, "10"), (12, "10"), (4, "1e12"))
            ),
        ),
        SceneSpec(
            "offset",
            _SCENES + "offset:Offset",
            "any scene on a pedestal",
            options=(
                Option("scene", "gaussian", "as on the command line, its options joined by +: disk:radius=0.2+cx=0.5"),
                Option("pedestal", 1e8, "what is added to it", -1e290, 1e290),
            ),
            purposes=(("pixel", 2), ("lens", 2), ("time", 1), ("direction", 2), ("further", 10)),
            extremes=tuple(f"pedestal={pedestal}" for pedestal in ("0", "1e4", "1e8", "1e12", "1e15")),
        ),
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


@hookimpl
def samplekit_commands() -> list[CommandSpec]:
    """The built-in commands."""
    return list(COMMANDS)
