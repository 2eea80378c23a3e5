import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

import samplekit
from samplekit import Scene, UsageError
from samplekit._builtin.scenes.motion_blur import BOARD, DIRECTION, DISKS, MotionBlur
from samplekit.quadrature._pixel_means import Curves, pixel_means

VARIANTS = [
    {},
    {"shutter": 0.0},
    {"shutter": 0.0, "aperture": 0.1},
    {"aperture": 0.1},
    {"aperture": 0.003, "shutter": 2.0},
    {"shutter": 1e-3},
    {"shutter": 1e6},
    {"aperture": 1e6},
    {"aperture": 1e-12, "shutter": 1e-12},
]
NAMES = [",".join(f"{name}={value:g}" for name, value in variant.items()) or "default" for variant in VARIANTS]


def board(x, y):
    even = (math.floor((x - BOARD[0]) / BOARD[1]) + math.floor((y - BOARD[0]) / BOARD[1])) % 2 == 0
    return BOARD[2] if even else BOARD[3]


def overlap(d, r, c):
    """The share of a disk of radius c that a disk of radius r at the distance d covers, as in textbooks."""
    if d >= r + c:
        return 0.0
    if d <= abs(r - c):
        return min(1.0, (r / c) ** 2)
    alpha, beta = math.acos((d * d + r * r - c * c) / (2 * d * r)), math.acos((d * d + c * c - r * r) / (2 * d * c))
    area = r * r * (alpha - math.sin(2 * alpha) / 2) + c * c * (beta - math.sin(2 * beta) / 2)
    return area / (math.pi * c * c)


def mean_over_lens_and_time(x, y, shutter, confusion):
    value = board(x, y)
    for cx, cy, radius, shade, speed in DISKS:

        def distance(t, cx=cx, cy=cy, speed=speed):
            moved = shutter * speed * (t - 0.5)
            return math.hypot(x - cx - moved * DIRECTION[0], y - cy - moved * DIRECTION[1])

        def share(t, distance=distance, radius=radius):
            d = distance(t)
            return overlap(d, radius, confusion) if confusion else float(d < radius)

        pieces = itertools.pairwise(np.linspace(0.0, 1.0, 41))
        shown = sum(quad(share, a, b, limit=60, epsabs=1e-9)[0] for a, b in pieces)
        value += shown * (shade - board(x, y))
    return value


@pytest.mark.filterwarnings("ignore::scipy.integrate.IntegrationWarning")
@pytest.mark.parametrize(("shutter", "aperture"), [(0.5, 0.0), (0.5, 0.1), (3.0, 0.02), (0.2, 0.6)])
def test_the_mean_over_lens_and_time_against_a_quadrature_of_the_textbook_areas(shutter, aperture):
    scene = MotionBlur(shutter=shutter, aperture=aperture)
    x, y = np.array([0.31, 0.5, 0.62, 0.8]), np.array([0.22, 0.44, 0.7])
    exact = scene.exact_at(x, y)
    for (row, b), (column, a) in itertools.product(enumerate(y), enumerate(x)):
        assert exact[row, column] == pytest.approx(mean_over_lens_and_time(a, b, shutter, aperture / 2), abs=3e-7)


@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_the_moving_pixel_means_against_a_much_finer_rule(variant):
    scene = MotionBlur(**variant)
    edges = np.arange(15) / 14
    constant = scene.constant(edges, edges)
    chosen = np.random.default_rng(14).random(constant.shape) < 30 / max(30, np.isnan(constant).sum())
    known = np.where(chosen & np.isnan(constant), np.nan, 0.0)
    fine, _ = pixel_means(
        scene._means,
        edges,
        edges,
        known=known,
        curves=Curves(*scene._edges(edges, edges)),
        largest=1 / 70,
        tolerance=1e-8,
    )
    error = np.abs(scene.exact(edges, edges) - fine)[np.isnan(known)]
    assert error.max() <= scene.reference_error


class NeverMoved(Scene):
    def value(self, points):
        values = []
        for x, y in points.T:
            shown = [shade for cx, cy, r, shade, _ in DISKS if (x - cx) ** 2 + (y - cy) ** 2 < r * r]
            values.append(shown[0] if shown else board(x, y))
        return np.array(values)


def test_the_reference_of_motion_is_far_below_the_smallest_error_of_a_study():
    # Of all samplers rank1 had the smallest at 512 x 512 pixels: 1.75e-8.
    result = samplekit.render("motion-blur", "rank1", 4096, size=(64, 64), seed=1)
    assert result.metrics["reference_error"] ** 2 <= 0.01 * min(result.metrics["mse"], 1.75e-8)


def test_a_still_scene_without_a_lens_is_one_that_never_had_time_or_lens():
    still = samplekit.scene("motion-blur:shutter=0")
    assert still.needs == {"pixel": 2}
    image = samplekit.render(still, "sobol+owen", 4, size=(32, 24), error=False).image
    still._scene = NeverMoved()
    np.testing.assert_array_equal(samplekit.render(still, "sobol+owen", 4, size=(32, 24), error=False).image, image)


def test_dimensions_are_those_that_the_options_need():
    for options, needs in (
        ("", {"pixel": 2, "time": 1}),
        (":aperture=0.1", {"pixel": 2, "lens": 2, "time": 1}),
        (":aperture=0.1,shutter=0", {"pixel": 2, "lens": 2}),
        (":aperture=0.1,pixel-filter=center", {"lens": 2, "time": 1}),
    ):
        scene = samplekit.scene("motion-blur" + options)
        assert scene.needs == needs
        assert scene.blocks == tuple(needs.values())


@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_what_is_left_out_of_motion_changes_no_bit(variant):
    scene = samplekit.scene("motion-blur", **variant)
    some = samplekit.render(scene, "random", 17, size=(61, 47), error=False)
    every = samplekit.render(scene, "random", 17, size=(61, 47), error=False, full=True)
    np.testing.assert_array_equal(some.image, every.image)


def test_estimates_agree_with_the_reference_in_five_dimensions():
    result = samplekit.render("motion-blur:aperture=0.05", "random", 1024, size=(20, 20), seed=6)
    varying = np.isnan(result.plan.pixels.constant).reshape(result.image.shape)
    # A pixel's variance is at most 1/4 (values span less than 1): |mean of errors| < 4 sigma, a false alarm in 16 000.
    assert abs(result.error[varying].mean()) < 4 * 0.5 / math.sqrt(1024 * varying.sum())
    assert result.metrics["mse"] < 0.25 / 1024


@pytest.mark.parametrize("options", [{"shutter": -1.0}, {"shutter": math.inf}, {"aperture": -1.0}, {"aperture": 1e7}])
def test_impossible_cameras_are_refused(options):
    with pytest.raises(UsageError):
        samplekit.scene("motion-blur", **options)
