"""Stiff scenes: values against many digits, constant pixels against samples, extremes of options right or refused."""

import math

import mpmath
import numpy as np
import pytest
from mpmath import mp, mpf

import samplekit
from samplekit import UsageError
from samplekit._integrate.loop import unit_square
from samplekit._registry import BUILTIN, registry
from samplekit._stability.sweep import scenes_of
from samplekit.testing import check_scene
from samplekit.testing._result import broken

ROUNDOFF = 2.0**-53
PLANE = ("disk", "ellipse", "gaussian", "zoneplate", "step", "checker", "power", "spike", "oscillating")
EXTREMES = [f"{name}:{extreme}" for name, extreme in scenes_of(PLANE)]
MORE = [
    f"oscillating:family={family},d={d},difficulty={difficulty}"
    for family in ("oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous")
    for d, difficulty in ((2, "1e6"), (12, "1e-9"), (12, "1e12"))
]


def values_at(text, points):
    """The scene at points float64[n, D] of the unit square."""
    return samplekit.scene(text).values(np.ascontiguousarray(points.T[None]), unit_square(1))[0]


def true_value(scene, name, point):
    """The value in many digits, and how many roundings of it and of 1 samples may be off."""
    x, y, *_ = (mpf(float(u)) for u in point)
    if name == "disk":
        return mpf((x - mpf(scene.cx)) ** 2 + (y - mpf(scene.cy)) ** 2 < mpf(scene.radius) ** 2), 0, 0
    if name == "ellipse":
        c, s = mpf(scene.cosine), mpf(scene.sine)
        dx, dy = x - mpf(scene.cx), y - mpf(scene.cy)
        p, q = (c * dx + s * dy) / mpf(scene.major), (c * dy - s * dx) / mpf(scene.minor)
        return mpf(p * p + q * q < 1), 0, 0
    if name == "spike":
        x0, x1, y0, y1 = (mpf(float(side)) for side in scene.square)
        return mpf(scene.peak if x0 <= x < x1 and y0 <= y < y1 else scene.background), 0, 0
    if name == "checker":
        return mpf((mp.floor(x * scene.cells) + mp.floor(y * scene.cells)) % 2 == 0), 0, 0
    if name == "power":
        return x ** -mpf(scene.a), 4, 0
    if name == "gaussian":
        distance2 = (x - mpf(scene.cx)) ** 2 + (y - mpf(scene.cy)) ** 2
        exponent = distance2 / (2 * mpf(scene.sigma) ** 2)
        # The place of the centre is rounded in units of the picture.
        shift = 2 * mp.sqrt(distance2) / mpf(scene.sigma) ** 2 + ROUNDOFF / mpf(scene.sigma) ** 2
        return mp.exp(-exponent), 4 + 8 * float(exponent) + float(shift), 0
    if name == "zoneplate":
        phase = mpf(scene.k) * (x * x + y * y)
        return mpf(1) / 2 + mp.cos(phase) / 2, 0, 8 + 4 * float(phase)
    if name == "step":
        distance = mpf(scene.cosine) * x + mpf(scene.sine) * y - mpf(scene.offset)
        if scene.width == 0.0:
            return mpf(distance < 0), 0, 0
        v = distance / mpf(scene.width)
        # Each of the three products and sums is rounded in units of the picture.
        return 1 / (1 + mp.exp(v)), 8 + 4 * float(abs(v)) + 4 / scene.width, 0
    return genz(scene, [mpf(float(u)) for u in point])


def genz(scene, x):
    a, u = [mpf(float(each)) for each in scene.coefficients], mpf(scene.u)
    pairs = list(zip(a, x, strict=False))
    if scene.family == "oscillatory":
        turns = u + sum(each * place for each, place in pairs)
        return mp.cospi(2 * turns), 0, 8 + 16 * len(a) * float(abs(turns))
    if scene.family == "product-peak":
        return mp.fprod(1 / (1 + (each * (place - u)) ** 2) for each, place in pairs), 8 * len(a), 0
    if scene.family == "corner-peak":
        return (1 + sum(each * place for each, place in pairs)) ** -(len(a) + 1), 4 * (len(a) + 2) ** 2, 0
    if scene.family == "gaussian":
        exponent = sum((each * (place - u)) ** 2 for each, place in pairs)
    elif scene.family == "continuous":
        exponent = sum(each * abs(place - u) for each, place in pairs)
    else:
        if any(place > u for place in x[: min(2, len(a))]):
            return mpf(0), 0, 0
        exponent = sum(each * ((u if k < 2 else 1) - place) for k, (each, place) in enumerate(pairs))
    return mp.exp(-exponent), 4 + 8 * len(a) * min(float(exponent), 1e4), 0


@pytest.mark.parametrize("text", EXTREMES + MORE)
def test_values_are_right_at_points(text):
    """At random points, and at points near what is hard of the scene."""
    scene = samplekit.scene(text)
    random = np.random.default_rng(4)
    points = random.random((60, scene.dims))
    points[:20, :2] = np.array([0.4523, 0.5317]) + random.standard_normal((20, 2)) * 10.0 ** random.uniform(
        -13, 0, (20, 1)
    )
    points = np.clip(points, 1e-9, 1.0 - ROUNDOFF)
    found = values_at(text, points)
    with mpmath.workdps(60):
        for point, value in zip(points, found, strict=True):
            truth, relative, absolute = true_value(scene._scene, text.partition(":")[0], point)
            allowed = relative * ROUNDOFF * abs(truth) + absolute * ROUNDOFF + mpf(2) ** -1070
            assert abs(mpf(float(value)) - truth) <= allowed, (point.tolist(), value)


@pytest.mark.parametrize("text", [*EXTREMES, "offset:scene=disk,pedestal=1e15", "offset:scene=step:width=1e-8"])
def test_constant_pixels_are_proven_and_references_refine(text):
    outcomes = check_scene(text, quick=True, only=["constants", "refinement", "purity"])
    # A picture of 1e18 in one pixel and 1e-30 in its neighbours is judged by the largest.
    assert not broken(outcomes), [(each.check, each.message) for each in broken(outcomes)]


@pytest.mark.parametrize("text", ["ellipse:aspect=1e-5", "step:width=1e-4,angle=30", "spike:area=1e-3", "power:a=0"])
def test_pixels_left_out_change_no_bit(text):
    left_out, whole = (samplekit.render(text, "random", 5, size=(40, 40), full=full) for full in (False, True))
    assert np.array_equal(left_out.image, whole.image)
    assert left_out.metrics["pixels_left_out"] > 100


REFUSED = [
    "step:width=-1",
    "step:width=1e-151",
    "step:width=inf",
    "ellipse:aspect=0",
    "ellipse:aspect=1.1",
    "ellipse:aspect=1e-13",
    "ellipse:radius=0",
    "ellipse:radius=1e61",
    "ellipse:angle=nan",
    "power:a=1",
    "power:a=-0.1",
    "power:a=nan",
    "spike:area=0",
    "spike:area=1e-31",
    "spike:peak=1e291",
    "spike:background=-1",
    "offset:pedestal=inf",
    "offset:scene=offset",
    "offset:scene=nothing",
    "offset:scene=disk:radius=-1",
    "offset:scene=disk:pixel-filter=center",
    "oscillating:d=0",
    "oscillating:d=13",
    "oscillating:d=2.5",
    "oscillating:family=smooth",
    "oscillating:difficulty=0",
    "oscillating:difficulty=1e13",
    "oscillating:u=1.5",
    "oscillating:d=2,pixel-filter=center",
    "zoneplate:k=1e101",
    "gaussian:sigma=0",
]


@pytest.mark.parametrize("text", REFUSED)
def test_options_out_of_range_are_refused_in_one_line(text):
    with pytest.raises(UsageError, match=r"^[^\n]+$"):
        samplekit.scene(text)


ENDS = [
    "step:width=1e-150,angle=1",
    "step:width=1e150,angle=1,offset=1e150",
    "ellipse:radius=1e60,aspect=1e-12",
    "ellipse:radius=1e-60,aspect=1e-12,angle=1e300",
    "ellipse:cx=1e60,cy=-1e60",
    "spike:peak=1e290,background=1e290",
    "spike:peak=0,background=0",
    "spike:area=1,cx=-1,cy=2",
    "power:a=0.99",
    "offset:pedestal=1e290",
    "offset:pedestal=-1e-290,scene=disk:radius=0",
    "oscillating:difficulty=1e12,d=12,u=0",
    "oscillating:difficulty=1e-9,d=1,u=1",
    "oscillating:family=corner-peak,d=12,difficulty=1e12",
]


@pytest.mark.parametrize("text", ENDS)
def test_the_ends_of_all_ranges_have_finite_means(text):
    edges = np.array([0.0, 1e-9, 0.3, 1.0 - 2.0**-53, 1.0])
    means = samplekit.scene(text).exact(edges, edges)
    assert np.isfinite(means).all()


def test_what_is_left_out_of_a_spike_is_its_ground():
    image = samplekit.render("spike:area=1e-12", "random", 4, size=(64, 64))
    assert image.metrics["pixels_left_out"] == 64 * 64 - 1
    assert image.reference.max() == pytest.approx(1e30 * 1e-12 * 64**2, rel=1e-9)
    assert image.reference.min() == 1e-30


def test_a_pedestal_is_added_to_any_scene():
    inner = samplekit.scene("motion-blur:shutter=0.2,aperture=0.1")
    whole = samplekit.scene("offset:scene=motion-blur:shutter=0.2+aperture=0.1,pedestal=1e4")
    assert whole.needs == inner.needs
    on_it = samplekit.estimate(whole, "sobol+owen", 64, realizations=4)
    plain = samplekit.estimate(inner, "sobol+owen", 64, realizations=4)
    assert np.abs(on_it - 1e4 - plain).max() <= 1e-11


def test_further_dimensions_have_a_purpose_of_their_own():
    assert samplekit.scene("oscillating:d=1").needs == {"pixel": 2}
    assert samplekit.scene("oscillating:d=12").needs == {"pixel": 2, "further": 10}
    centred = samplekit.scene("oscillating:d=5,family=corner-peak,pixel-filter=center")
    assert centred.needs == {"further": 3}
    rendering = samplekit.render(centred, "sobol+owen", 1024, size=(4, 4))
    assert rendering.metrics["max_error"] < 0.1 * rendering.reference.max()


def test_infinite_variance_is_said():
    for name, finite in (("power:a=0.49", True), ("power:a=0.5", False), ("offset:scene=power:a=0.6", False)):
        scene = samplekit.scene(name)
        assert scene.finite_variance is finite
        assert any("variance" in note for note in scene.notes()) is not finite


def test_every_scene_that_can_be_stiff_declares_how():
    plain = {"bilinear", "depth-of-field", "motion-blur", "ambient-occlusion"}
    ours = {name: o.spec for name, o in registry().all("scene").items() if o.plugin.name == BUILTIN}
    assert {name for name, spec in ours.items() if not spec.extremes} <= plain
    for name, spec in ours.items():
        for extreme in spec.extremes:
            assert math.isfinite(
                samplekit.scene(f"{name}:{extreme}").exact(np.array([0.0, 1.0]), np.array([0.0, 1.0]))[0, 0]
            )
