import itertools
import math

import mpmath
import numpy as np
import pytest

from samplekit._builtin.scenes.gaussian import Gaussian


def normal_means(edges, centre, sigma):
    """Means of the bell by error functions at 80 digits, complementary ones on a flank."""
    scale = 1 / (mpmath.mpf(sigma) * mpmath.sqrt(2))
    places = [scale * (mpmath.mpf(edge) - mpmath.mpf(centre)) for edge in edges.tolist()]
    means = []
    for left, right in itertools.pairwise(places):
        if left < 0 < right:
            difference = mpmath.erf(right) - mpmath.erf(left)
        else:
            near, far = sorted((abs(left), abs(right)))
            difference = mpmath.erfc(near) - mpmath.erfc(far)
        means.append(mpmath.sqrt(mpmath.pi) / 2 * difference / (right - left))
    return means


def adversarial_edges(rng, centre, sigma):
    """Edges out to 30 sigma, 1e-8 sigma to 30 sigma apart, on both sides of the centre and on it, and far beyond."""
    places = [-30, *rng.uniform(-30, 30, 3), *rng.uniform(-6, 6, 2), *rng.uniform(-1, 1, 2), 30]
    places += [place + 10 ** rng.uniform(-8, 0) for place in places[:6]]
    places += [-1e-8, 0, 1e-3, -1e4, 1e7]
    return np.unique(centre + sigma * np.array(places))


@pytest.mark.parametrize("centre", [0.0, 0.4523])
@pytest.mark.parametrize("sigma", [1e-12, 1e-9, 1e-4, 0.1, 1.0, 1e3, 1e8])
def test_exact_against_error_functions(sigma, centre):
    rng = np.random.default_rng([int(1e12 * sigma), int(centre)])
    x_edges, y_edges = adversarial_edges(rng, centre, sigma), adversarial_edges(rng, -centre, sigma)
    assert (x_edges.size - 1) * (y_edges.size - 1) >= 200
    exact = Gaussian(sigma, centre, -centre).exact(x_edges, y_edges)
    with mpmath.workdps(80):
        columns, rows = normal_means(x_edges, centre, sigma), normal_means(y_edges, -centre, sigma)
        for j, row in enumerate(rows):
            for i, column in enumerate(columns):
                mean = row * column
                assert abs(exact[j, i] - mean) <= max(5e-15 * mean, 1e-320), (sigma, centre, i, j)


@pytest.mark.parametrize("sigma", [1e-3, 0.05, 0.1, 2.0])
def test_exact_over_pixels(sigma):
    edges = np.arange(33) / 32
    exact = Gaussian(sigma).exact(edges, edges)
    with mpmath.workdps(80):
        columns, rows = normal_means(edges, 0.4523, sigma), normal_means(edges, 0.5317, sigma)
        for j, i in np.ndindex(32, 32):
            mean = rows[j] * columns[i]
            assert abs(exact[j, i] - mean) <= max(5e-15 * mean, 1e-320)


@pytest.mark.parametrize("sigma", [5e-324, 1e-308, 1e-200, 1e-100, 1e100, 1e308])
@pytest.mark.parametrize("centre", [0.5, 0.4523, 1e50])
def test_extreme_widths_of_the_bell_underflow_or_fill_the_image(sigma, centre, boxes_of, sums):
    edges = np.arange(5) / 4
    scene = Gaussian(sigma, centre, centre)
    exact, constant = scene.exact(edges, edges), scene.constant(edges, edges)
    sampled = sums(scene, np.random.default_rng(2).random((16, 2, 8)), boxes_of(edges, edges)) / 8
    expected = 1.0 if sigma > 1e60 else 0.0
    np.testing.assert_allclose(exact, expected, atol=1e-180)
    assert np.array_equal(sampled, np.full(16, expected))
    assert np.all(np.isnan(constant) | (constant == expected))


@pytest.mark.parametrize("count", [1, 7, 64, 1024])
def test_sums_against_numpy(count, boxes_of, sums):
    rng = np.random.default_rng(count)
    edges = np.arange(6) / 5
    boxes = boxes_of(edges, edges)
    tile = rng.random((25, 2, count))
    x = boxes[0][:, None] + tile[:, 0] * boxes[1][:, None] - 0.4523
    y = boxes[2][:, None] + tile[:, 1] * boxes[3][:, None] - 0.5317
    expected = np.exp(-(x * x + y * y) / (2 * 0.1**2)).sum(axis=1)
    np.testing.assert_allclose(sums(Gaussian(), tile, boxes), expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("sigma", "value"), [(1e-12, 0.0), (1e-3, 0.0), (0.015, 0.0), (2e7, 1.0), (8e7, 1.0), (2e8, 1.0), (1e12, 1.0)]
)
def test_constant_pixels_give_that_value_at_every_sample(sigma, value, constant_pixels):
    constant, sampled = constant_pixels(Gaussian(sigma), 16)
    known = np.isfinite(constant)
    assert known.any()
    assert np.all(constant[known] == value)
    assert np.array_equal(sampled[known], constant[known])


def test_pixels_that_only_underflow_are_constant():
    edges = np.arange(257) / 256
    scene = Gaussian(0.01)
    x, y = np.meshgrid(*[np.abs(edges[:-1] + 1 / 512 - c) for c in (scene.cx, scene.cy)])
    radii = np.hypot(x, y)
    constant = scene.constant(edges, edges)
    assert np.isnan(constant[radii < 0.38]).all()
    assert np.all(constant[radii > 0.01 * math.sqrt(2 * 746) + 1 / 256] == 0.0)
