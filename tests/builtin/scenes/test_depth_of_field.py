"""The lens mean is checked against an integral over columns of the lens; the pixel means against finer rules."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

import samplekit
from samplekit import UsageError
from samplekit._bases.scene import Scene
from samplekit._builtin.scenes.depth_of_field import FRONT, RING, WALL, DepthOfField
from samplekit.quadrature._pixel_means import Curves, pixel_means

VARIANTS = [
    {},
    {"focus": 0.5},
    {"focus": 2.0},
    {"focus": math.inf},
    {"aperture": 0.02, "focus": 1.1},
    {"aperture": 0.6, "focus": 3.0},
    {"aperture": 8.0, "focus": 0.4},
    {"aperture": 1e6},
    {"aperture": 1e-12, "focus": 0.7},
]
NAMES = [",".join(f"{name}={value:g}" for name, value in variant.items()) or "default" for variant in VARIANTS]


def seen(scene, x, y, u, v):
    """What the ray from (x, y) through the lens point (u, v) meets, in words of the declaration."""
    front, ring, wall = (((x + c * u), (y + c * v)) for c in scene.confusion)
    for cx, cy, radius, value in FRONT:
        if math.hypot(front[0] - cx, front[1] - cy) < radius:
            return value
    if RING[2] <= math.hypot(ring[0] - RING[0], ring[1] - RING[1]) < RING[3]:
        return RING[4]
    column, row = (math.floor((place - WALL[0]) / WALL[1]) for place in wall)
    if not (0 <= column < WALL[2] and 0 <= row < WALL[2]):
        return WALL[5]
    return WALL[3] if (column + row) % 2 == 0 else WALL[4]


def lens_mean(scene, x, y):
    """The mean over the lens, column by column: in a column the value changes at places that are known exactly."""
    circles = [(*disk[:3], scene.confusion[0]) for disk in FRONT]
    circles += [(RING[0], RING[1], radius, scene.confusion[1]) for radius in RING[2:4]]
    lines = WALL[0] + WALL[1] * np.arange(WALL[2] + 1)

    def column(u):
        half = math.sqrt(max(0.0, 1.0 - u * u))
        places = [-half, half]
        for cx, cy, radius, c in circles:
            rest = radius**2 - (x + c * u - cx) ** 2
            if c and rest > 0:
                places += [(cy - y + side * math.sqrt(rest)) / c for side in (-1, 1)]
        places += [(line - y) / scene.confusion[2] for line in lines if scene.confusion[2]]
        places = sorted(place for place in places if -half <= place <= half)
        parts = itertools.pairwise(places)
        return sum((b - a) * seen(scene, x, y, u, 0.5 * (a + b)) for a, b in parts)

    breaks = [-1.0, 1.0]
    for cx, _, radius, c in circles:
        breaks += [(cx - x + side * radius) / c for side in (-1, 1) if c]
    breaks += [(line - x) / scene.confusion[2] for line in lines if scene.confusion[2]]
    breaks = sorted(place for place in breaks if -1.0 <= place <= 1.0)
    parts = itertools.pairwise(breaks)
    return sum(quad(column, a, b, limit=30, epsabs=1e-8, epsrel=1e-6)[0] for a, b in parts) / math.pi


@pytest.mark.filterwarnings("ignore::scipy.integrate.IntegrationWarning")
@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_the_lens_mean_against_columns_of_the_lens(variant):
    scene = DepthOfField(**variant)
    rng = np.random.default_rng(3)
    # Points about the edges of things, where layers hide each other.
    points = [(0.30, 0.33), (0.32, 0.42), (0.78, 0.54), (0.72, 0.60), (0.47, 0.49), *rng.random((2, 2)).tolist()]
    for x, y in points:
        exact = scene.exact_at(np.array([x]), np.array([y]))[0, 0]
        assert exact == pytest.approx(lens_mean(scene, x, y), abs=2e-6), (x, y)


@pytest.mark.parametrize("variant", VARIANTS[:6] + VARIANTS[8:], ids=NAMES[:6] + NAMES[8:])
@pytest.mark.parametrize("size", [5, 40])
def test_the_pixel_means_against_a_much_finer_rule(variant, size):
    scene = DepthOfField(**variant)
    edges = np.arange(size + 1) / size
    exact = scene.exact(edges, edges)
    constant = scene.constant(edges, edges)
    chosen = np.random.default_rng(size).random(exact.shape) < (4 if size == 5 else 16) / max(
        1, np.isnan(constant).sum()
    )
    chosen[0, 0] = True
    known = np.where(chosen & np.isnan(constant), np.nan, 0.0)
    # Here every edge is followed, whatever its blur: not the choice that the scene makes.
    fine, _ = pixel_means(
        scene._mean_over_lens,
        edges,
        edges,
        known=known,
        curves=Curves(*scene._edges(math.inf)),
        largest=1 / 64,
        orders=(3, 5),
        tolerance=1e-7,
    )
    error = np.abs(exact - fine)[np.isnan(known)]
    assert error.max(initial=0.0) <= scene.reference_error
    assert error.size == 0 or math.sqrt(np.mean(error**2)) <= 5e-6


def test_the_reference_is_far_below_the_smallest_error_of_a_study():
    # Of all samplers rank1 had the smallest, at 8 x 8, 64 x 64 and 512 x 512 pixels: 2.8e-7, 1.2e-7, 6.7e-8.
    result = samplekit.render("depth-of-field", "rank1", 4096, size=(128, 128), seed=1)
    assert result.metrics["reference_error"] ** 2 <= 0.01 * result.metrics["mse"]
    assert result.metrics["reference_error"] ** 2 <= 0.01 * 6.7e-8


class NeverHadALens(Scene):
    """The layers of the pinhole picture, written without a thought of lenses."""

    def value(self, points):
        scene = DepthOfField(aperture=0.0)
        return np.array([seen(scene, x, y, 0.0, 0.0) for x, y in points.T])


def test_without_aperture_the_image_is_that_of_a_scene_without_a_lens():
    with_option = samplekit.render("depth-of-field:aperture=0", "random", 4, size=(40, 30), seed=3, error=False)
    assert with_option.plan.pixels.scene.needs == {"pixel": 2}
    pinhole = samplekit.scene("depth-of-field:aperture=0")
    pinhole._scene = NeverHadALens()
    without = samplekit.render(pinhole, "random", 4, size=(40, 30), seed=3, error=False)
    assert without.metrics["pixels_left_out"] == 0
    np.testing.assert_array_equal(with_option.image, without.image)


def test_a_pinhole_is_what_an_aperture_of_nearly_nothing_shows():
    # Samplers whose dimensions do not depend on their number draw the same pixel places with a lens and without.
    for sampler in ("random", "sobol+owen", "latin-hypercube"):
        pinhole = samplekit.render("depth-of-field:aperture=0", sampler, 16, size=(32, 32), error=False)
        nearly = samplekit.render("depth-of-field:aperture=1e-12", sampler, 16, size=(32, 32), error=False)
        assert nearly.plan.pixels.scene.dims == 4
        np.testing.assert_array_equal(pinhole.image, nearly.image)


@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
@pytest.mark.parametrize("size", [(31, 17), (64, 64)])
def test_what_is_left_out_changes_no_bit(variant, size):
    scene = samplekit.scene("depth-of-field", **variant)
    some = samplekit.render(scene, "random", 33, size=size, error=False)
    every = samplekit.render(scene, "random", 33, size=size, error=False, full=True)
    np.testing.assert_array_equal(some.image, every.image)
    assert every.metrics["pixels_left_out"] == 0


@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_constant_pixels_are_constant_at_the_rim_of_the_lens_and_the_corners_of_the_pixel(variant):
    scene = DepthOfField(**variant)
    edges = np.arange(49) / 48
    constant = scene.constant(edges, edges)
    almost_one = 1.0 - 2.0**-53
    # The square's border is the lens's rim.
    border = [(t, side) for t in np.linspace(0, almost_one, 17) for side in (0.0, almost_one)]
    border += [(b, a) for a, b in border]
    corners = [(a, b, *rim) for a in (0.0, almost_one) for b in (0.0, almost_one) for rim in border]
    tile = np.array(corners).T[None]
    for row, column in np.argwhere(~np.isnan(constant)):
        sides = np.diff(edges)
        box = np.array([[edges[column]], [sides[column]], [edges[row]], [sides[row]]])
        values = np.empty(tile.shape[2])
        singles = np.ascontiguousarray(tile[0].T[:, :, None])
        scene.sums(singles, np.repeat(box, values.size, axis=1), values)
        assert (values == constant[row, column]).all(), (row, column)


def test_more_than_half_of_the_default_picture_is_left_out():
    edges = np.arange(257) / 256
    assert 0.3 < np.isnan(DepthOfField().constant(edges, edges)).mean() < 0.45


def test_out_of_view_everything_is_constant():
    # Far from the layers nothing but what lies beyond the wall is seen.
    edges = np.linspace(100.0, 101.0, 9)
    scene = DepthOfField()
    np.testing.assert_array_equal(scene.constant(edges, edges), WALL[5])
    np.testing.assert_array_equal(scene.exact(edges, edges), WALL[5])


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"focus": 0.0}, "focus"),
        ({"focus": -1.0}, "focus"),
        ({"focus": 1e-300}, "wider"),
        ({"focus": math.nan}, "focus"),
        ({"aperture": math.inf}, "aperture"),
        ({"aperture": -0.1}, "aperture"),
        ({"aperture": 1e13}, "aperture"),
    ],
)
def test_what_no_lens_does_is_refused_in_one_line(options, reason):
    with pytest.raises(UsageError, match=reason) as caught:
        samplekit.scene("depth-of-field", **options)
    assert "\n" not in str(caught.value)


def test_ratios_to_random_are_those_of_the_course():
    # Over 24 x 24 pixels and two seeds a ratio's standard deviation is about 8 %: each limit is 5 of them away or more.
    edges = np.arange(25) / 24
    reference = samplekit.scene("depth-of-field").exact(edges, edges)

    def error(sampler, count):
        images = [
            samplekit.render("depth-of-field", sampler, count, size=(24, 24), seed=seed, error=False).image
            for seed in range(2)
        ]
        return np.mean((np.array(images) - reference) ** 2)

    low, high = error("random", 16), error("random", 256)
    assert error("uncorrelated-jitter", 16) < 0.6 * low
    assert error("uncorrelated-jitter", 256) < 0.45 * high
    assert error("sobol+owen", 256) < 0.25 * high
