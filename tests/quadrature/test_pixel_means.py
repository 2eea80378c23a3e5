import math
import os

import numpy as np
import pytest

import samplekit
from samplekit._builtin.scenes.disk import Disk
from samplekit._builtin.scenes.gaussian import Gaussian
from samplekit._threads import default_threads
from samplekit.quadrature import _pixel_means as pixel_means_module
from samplekit.quadrature._pixel_means import Curves, pixel_means


def inside(radius, cx=0.4523, cy=0.5317):
    return lambda points: ((points[0] - cx) ** 2 + (points[1] - cy) ** 2 < radius * radius).astype(float)


def test_smooth_functions_within_the_tolerance():
    edges = np.arange(9) / 8
    gaussian = Gaussian()
    means, errors = pixel_means(
        lambda p: np.exp(-((p[0] - 0.4523) ** 2 + (p[1] - 0.5317) ** 2) / 0.02), edges, edges, borders=True
    )
    true_error = np.abs(means - gaussian.exact(edges, edges))
    assert true_error.max() < 1e-8
    assert (true_error <= errors + 1e-15).all()


@pytest.mark.parametrize("radius", [0.3, 0.01, 0.5])
def test_a_step_on_a_named_circle_is_integrated_along_it(radius):
    edges = np.array([0.0, 0.1, 0.13, 0.3, 0.44, 0.5317, 0.7, 0.95, 1.0])
    curves = Curves(circles=np.array([[0.4523, 0.5317, radius]]))
    means, _ = pixel_means(inside(radius), edges, edges, curves=curves)
    np.testing.assert_allclose(means, Disk(radius=radius).exact(edges, edges), rtol=0, atol=1e-6)


def test_a_step_that_nobody_names_within_its_own_estimate():
    edges = np.arange(17) / 16
    means, errors = pixel_means(inside(0.3), edges, edges, borders=True, evaluations=2**22)
    true_error = np.abs(means - Disk().exact(edges, edges))
    assert true_error.max() < 1e-5
    assert (true_error <= errors + 1e-15).all()
    assert errors.max() < 2e-3


def test_square_roots_on_lines_and_circles():
    # x^(1/2) from the line x = 1/3 on; the mean of (x - 1/3)^(1/2) over [1/3, 1] is 2/3 (2/3)^(1/2).
    lines = np.array([[1.0, 0.0, 1 / 3], [0.0, 1.0, 0.7], [0.6, -0.8, 0.05]])
    means, _ = pixel_means(
        lambda p: np.sqrt(np.maximum(0.0, p[0] - 1 / 3)),
        np.array([0.0, 1.0]),
        np.array([0.0, 1.0]),
        curves=Curves(lines=lines),
        tolerance=1e-10,
    )
    assert means[0, 0] == pytest.approx(2 / 3 * (2 / 3) ** 1.5, abs=1e-9)
    # Half a ball: the mean height over the square around it.
    means, _ = pixel_means(
        lambda p: np.sqrt(np.maximum(0.0, 0.09 - (p[0] - 0.5) ** 2 - (p[1] - 0.5) ** 2)),
        np.array([0.0, 1.0]),
        np.array([0.0, 1.0]),
        curves=Curves(circles=np.array([[0.5, 0.5, 0.3]])),
        tolerance=1e-10,
    )
    assert means[0, 0] == pytest.approx(2 / 3 * math.pi * 0.3**3, abs=1e-9)


def test_what_is_known_is_left_alone_and_small_features_are_met():
    edges = np.array([0.0, 0.5, 1.0])
    known = np.array([[0.25, np.nan], [np.nan, 0.5]])
    asked = []

    def function(points):
        asked.append(points.copy())
        return inside(0.002, 0.7507, 0.2503)(points)

    means, _ = pixel_means(function, edges, edges, known=known, largest=1 / 256, tolerance=1e-7)
    assert means[0, 0] == 0.25
    assert means[1, 1] == 0.5
    assert means[1, 0] == 0.0
    assert means[0, 1] == pytest.approx(math.pi * 0.002**2 / 0.25, rel=1e-2)
    everywhere = np.concatenate(asked, axis=1)
    assert not ((everywhere < 0.5).all(axis=0) | (everywhere > 0.5).all(axis=0)).any()


def test_where_the_evaluations_end_the_rest_is_kept():
    edges = np.array([0.0, 1.0])
    counted = []

    def function(points):
        counted.append(points.shape[1])
        return inside(0.3)(points)

    means, errors = pixel_means(function, edges, edges, evaluations=10_000)
    assert sum(counted) <= 10_000
    assert abs(means[0, 0] - math.pi * 0.09) <= errors[0, 0]


@pytest.mark.parametrize(
    "text", ["depth-of-field", "depth-of-field:aperture=0.8,focus=inf", "motion-blur:aperture=0.1", "ambient-occlusion"]
)
# At 160 a circle of confusion is eight pixels, at 40 the largest cell is one: where an ulp would decide.
@pytest.mark.parametrize(("size", "crop"), [(160, (37, 41, 30, 9)), (160, (101, 99, 1, 1)), (40, (17, 3, 7, 20))])
def test_the_reference_of_a_crop_is_that_of_the_whole_bit_for_bit(text, size, crop, monkeypatch):
    monkeypatch.setenv("SAMPLEKIT_CACHE", "")
    scene = samplekit.scene(text)
    x, y, width, height = crop
    # The whole is what surrounds the crop: the rest of the picture would add nothing but time.
    left, top = x - 3, y - 2
    columns, rows = (np.arange(start, start + length + 1) / size for start, length in ((left, 40), (top, 30)))
    whole = scene.exact(columns, rows)
    part = scene.exact(columns[x - left :][: width + 1], rows[y - top :][: height + 1])
    np.testing.assert_array_equal(part, whole[y - top :, x - left :][:height, :width])


def test_a_reference_takes_no_more_threads_than_were_asked_for(monkeypatch):
    taken = []

    class Recording(pixel_means_module.ThreadPoolExecutor):
        def __init__(self, workers):
            taken.append(workers)
            super().__init__(workers)

    monkeypatch.setenv("SAMPLEKIT_CACHE", "")
    monkeypatch.setattr(pixel_means_module, "ThreadPoolExecutor", Recording)
    # Of 200 x 200 pixels, all of which vary, there are three batches.
    for threads, most in ((1, 1), (2, 2), (1024, 3)):
        taken.clear()
        samplekit.render("ambient-occlusion", "random", 1, size=(200, 200), threads=threads)
        assert max(taken) == most
    assert default_threads() <= (os.cpu_count() or 1)
