"""The scenes that come with samplekit: what each declares, without importing it."""

from __future__ import annotations

import math

from samplekit import Option, SceneSpec

_SCENES = "samplekit._builtin.scenes."
GENZ_FAMILIES = ("oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous")


def _centre(least: float, most: float, x: float = 0.4523, y: float = 0.5317) -> tuple[Option, Option]:
    """Return the options cx and cy. Their defaults lie on no pixel edge and break every symmetry."""
    return (
        Option("cx", x, "centre, from the left edge", least, most),
        Option("cy", y, "centre, from the top edge", least, most),
    )


def _each(name: str, *values: object) -> tuple[str, ...]:
    """Return the options of each extreme: one option with one value."""
    return tuple(f"{name}={value}" for value in values)


SCENES = (
    SceneSpec(
        "disk",
        _SCENES + "disk:Disk",
        "1 inside a disk, 0 outside",
        options=(Option("radius", 0.3, "radius of the disk", 0.0, 1e150), *_centre(-1e150, 1e150)),
        extremes=_each("radius", "0.3", "1e-2", "1e-4", "1e-6", "1e-9", "0.5317", "1e9"),
    ),
    SceneSpec(
        "ellipse",
        _SCENES + "ellipse:Ellipse",
        "1 inside an ellipse; a needle if its aspect is small",
        options=(
            Option("radius", 0.3, "half of the longer axis", 1e-60, 1e60),
            Option("aspect", 0.1, "shorter axis over longer", 1e-12, 1.0),
            Option("angle", 30.0, "angle of the longer axis from the x axis, in degrees"),
            *_centre(-1e60, 1e60),
        ),
        extremes=_each("aspect", "1", "1e-1", "1e-3", "1e-5", "1e-7", "1e-9"),
    ),
    SceneSpec(
        "gaussian",
        _SCENES + "gaussian:Gaussian",
        "exp(-|x - c|^2 / 2 sigma^2)",
        options=(Option("sigma", 0.1, "standard deviation", 1e-150), *_centre(-1e50, 1e50)),
        extremes=_each("sigma", "1e8", "1e3", "0.1", "1e-2", "1e-3", "1e-5", "1e-8", "1e-12"),
    ),
    SceneSpec(
        "zoneplate",
        _SCENES + "zoneplate:ZonePlate",
        "1/2 + 1/2 cos(k |x - c|^2)",
        options=(Option("k", 1024.0, "radians at distance 1", 0.0, 1e100), *_centre(-1e100, 1e100, x=0.0, y=0.0)),
        extremes=_each("k", "1e-8", "1", "1024", "1e6", "1e9", "1e12"),
    ),
    SceneSpec(
        "step",
        _SCENES + "step:Step",
        "1 on one side of a line, sheer or as a sigmoid",
        options=(
            Option("angle", 0.0, "angle of the line's normal from the x axis, in degrees"),
            Option("offset", 0.5, "distance of the line from the origin", -1e150, 1e150),
            Option("width", 0.0, "width of the sigmoid; 0: a sheer step", 0.0, 1e150),
        ),
        extremes=_each("angle=27,offset=0.61,width", "1", "1e-1", "1e-2", "1e-4", "1e-8", "1e-15", "0"),
    ),
    SceneSpec(
        "checker",
        _SCENES + "checker:Checker",
        "a checkerboard",
        options=(Option("cells", 8, "number of cells along a side", 1, 2**20),),
        extremes=_each("cells", 1, 7, 1001, 2**20 - 1),
    ),
    SceneSpec("bilinear", _SCENES + "bilinear:Bilinear", "x times y"),
    SceneSpec(
        "power",
        _SCENES + "power:Power",
        "x^-a, unbounded at the left edge; the variance is finite for a < 0.5",
        reference="Owen 2006",
        options=(Option("a", 0.25, "exponent", 0.0, 0.99),),
        extremes=_each("a", 0, 0.25, 0.4, 0.49, 0.6, 0.9, 0.99),
    ),
    SceneSpec(
        "spike",
        _SCENES + "spike:Spike",
        "a small bright square on a dark ground",
        options=(
            Option("peak", 1e30, "value in the square", 0.0, 1e290),
            Option("background", 1e-30, "value elsewhere", 0.0, 1e290),
            Option("area", 1e-4, "area of the square", 1e-30, 1.0),
            *_centre(-1.0, 2.0),
        ),
        extremes=_each("area", "1e-1", "1e-2", "1e-4", "1e-6", "1e-9", "1e-12"),
    ),
    SceneSpec(
        "oscillating",
        _SCENES + "oscillating:Oscillating",
        "Genz's six families of integrands in 1 to 12 dimensions",
        reference="Genz 1984",
        options=(
            Option("family", "oscillatory", "family of integrands", choices=GENZ_FAMILIES),
            Option("d", 2, "number of dimensions", 1, 12),
            Option("difficulty", 10.0, "sum of the coefficients", 1e-9, 1e12),
            Option("u", 0.4523, "place of the peak, kink or step; phase in turns", 0.0, 1.0),
        ),
        purposes=(("pixel", 2), ("further", 10)),
        extremes=tuple(
            f"family={family},d={d},difficulty={difficulty}"
            for family in GENZ_FAMILIES
            for d, difficulty in ((1, "10"), (4, "1e-9"), (4, "10"), (12, "10"), (4, "1e12"))
        ),
    ),
    SceneSpec(
        "offset",
        _SCENES + "offset:Offset",
        "any scene on a pedestal",
        options=(
            Option(
                "scene",
                "gaussian",
                "another scene as on the command line, its options joined by +: disk:radius=0.2+cx=0.5",
            ),
            Option("pedestal", 1e8, "number that is added to the scene", -1e290, 1e290),
        ),
        purposes=(("pixel", 2), ("lens", 2), ("time", 1), ("direction", 2), ("further", 10)),
        extremes=_each("pedestal", "0", "1e4", "1e8", "1e12", "1e15"),
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
            Option("shutter", 0.5, "time for which the shutter is open; 0: nothing moves", 0.0, 1e6),
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
            Option("radius", 0.9, "radius of the sphere; 0: no sphere", 0.0, 1e6),
            Option("height", 1.0, "height of the sphere's centre, at least the radius", 0.0, 1e6),
            Option("cx", 0.0, "place of the sphere, to the right", -1e6, 1e6),
            Option("cy", 0.0, "place of the sphere, to the back", -1e6, 1e6),
        ),
        purposes=(("pixel", 2), ("direction", 2)),
    ),
)
