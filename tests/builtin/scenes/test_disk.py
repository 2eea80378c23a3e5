import itertools
import math

import mpmath
import numpy as np
import pytest

from samplekit._builtin.scenes.disk import Disk

BOXES = 250


def mean_by_strips(x0, x1, y0, y1, cx, cy, radius, digits=160):
    """The mean over a box, by integrating the length of its vertical cuts from left to right."""
    with mpmath.workdps(digits):
        x0, x1, y0, y1 = (mpmath.mpf(e) - mpmath.mpf(c) for e, c in ((x0, cx), (x1, cx), (y0, cy), (y1, cy)))
        r = mpmath.mpf(radius)
        start, end = max(x0, -r), min(x1, r)
        if start >= end:
            return mpmath.mpf(0)
        crossings = [mpmath.sqrt(r * r - y * y) for y in (y0, y1) if abs(y) < r]
        cuts = sorted({start, end, *(s * c for c in crossings for s in (1, -1) if start < s * c < end)})
        area = mpmath.mpf(0)
        for a, b in itertools.pairwise(cuts):
            half = mpmath.sqrt(r * r - ((a + b) / 2) ** 2)
            if half <= y0 or -half >= y1:
                continue
            under_arc = antiderivative(b, r) - antiderivative(a, r)
            top = y1 * (b - a) if half >= y1 else under_arc
            bottom = y0 * (b - a) if -half <= y0 else -under_arc
            area += top - bottom
        return area / ((x1 - x0) * (y1 - y0))


def antiderivative(x, r):
    return (x * mpmath.sqrt(max(r * r - x * x, 0)) + r * r * mpmath.asin(x / r)) / 2


def power(random, low, high):
    return 10.0 ** random.uniform(low, high)


def around(random, x, y, width, height):
    x0, y0 = x - random.random() * width, y - random.random() * height
    return x0, x0 + width, y0, y0 + height


def beside(random, x, y, width, height):
    """A box with a corner at (x, y), in any of the four directions."""
    x0, x1 = (x, x + width) if random.random() < 0.5 else (x - width, x)
    y0, y1 = (y, y + height) if random.random() < 0.5 else (y - height, y)
    return x0, x1, y0, y1


def pixel_on_the_circle(random):
    r, h, t = power(random, -12, 12), power(random, -12, 0), random.uniform(0, 2 * math.pi)
    cx, cy = random.uniform(-1, 1, 2)
    return *around(random, cx + r * math.cos(t), cy + r * math.sin(t), h, h), cx, cy, r


def huge_circle_through_the_image(random):
    r, h, t = power(random, 0, 12), power(random, -12, 0), random.uniform(0, 2 * math.pi)
    x, y = random.random(2)
    return *around(random, x, y, h, h), x - r * math.cos(t), y - r * math.sin(t), r


def tangent(random):
    r = power(random, -12, 12)
    width, height = power(random, -3, 1) * r, power(random, -3, 1) * r
    x0 = r * (1 - power(random, -16, -1))
    y0 = power(random, -17, -1) * r if random.random() < 0.3 else -random.random() * height
    x = (x0, x0 + width) if random.random() < 0.5 else (-x0 - width, -x0)
    y = (y0, y0 + height)
    return (*x, *y, 0.0, 0.0, r) if random.random() < 0.5 else (*y, *x, 0.0, 0.0, r)


def tangent_at_the_origin(random):
    """Edges near 0 resolve how deep the circle enters to far less than an ulp of the radius."""
    r = 2.0 ** random.integers(-40, 40)
    depth, width, height = power(random, -40, -1) * r, power(random, -40, 0) * r, power(random, -40, 0) * r
    y0 = random.choice([-1, 1]) * random.random() * height
    return -depth, width - depth, y0, y0 + height, -r, 0.0, r


def corner_near_the_circle(random):
    r, t = power(random, -12, 12), random.uniform(0, math.pi / 2)
    distance = r * (1 + random.choice([-1, 1]) * power(random, -15, -2))
    size = power(random, -12, 0) * r, power(random, -12, 0) * r
    return *beside(random, distance * math.cos(t), distance * math.sin(t), *size), 0.0, 0.0, r


def corner_on_the_circle(random):
    """Pythagorean triples: the corner lies on the circle exactly, or one to two ulps from there."""
    a, b, c = random.choice([(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29)])
    unit = 2.0 ** random.integers(-40, 40)
    x = a * unit * (1 + 2.0**-52 * random.integers(-2, 3))
    y = b * unit * (1 + 2.0**-52 * random.integers(-2, 3))
    return *beside(random, x, y, power(random, -12, 0) * x, power(random, -12, 0) * y), 0.0, 0.0, c * unit


def corner_near_a_far_circle(random):
    """Differences edge - centre that no float64 holds decide how much of the box is inside."""
    r, t = power(random, 3, 12), random.uniform(0, 2 * math.pi)
    x, y = random.random(2)
    cx, cy = x - r * math.cos(t), y - r * math.sin(t)
    with mpmath.workdps(60):
        sine = mpmath.sqrt(max(mpmath.mpf(r) ** 2 - (mpmath.mpf(x) - mpmath.mpf(cx)) ** 2, 0))
        y = float(mpmath.mpf(cy) + (sine if math.sin(t) > 0 else -sine))
    return *beside(random, x, y, power(random, -12, -3), power(random, -12, -3)), cx, cy, r


def tiny_disk(random):
    r, (cx, cy) = power(random, -12, -1), random.random(2)
    return *around(random, cx, cy, power(random, -1, 1), power(random, -1, 1)), cx, cy, r


def tiny_disk_on_a_corner(random):
    r, (cx, cy) = power(random, -12, -1), random.random(2)
    x, y = cx + random.uniform(-1, 1) * r, cy + random.uniform(-1, 1) * r
    return *beside(random, x, y, power(random, -1, 1), power(random, -1, 1)), cx, cy, r


def sliver(random):
    r, t = power(random, -12, 12), random.uniform(0, 2 * math.pi)
    if random.random() < 0.5:
        t = random.integers(4) * math.pi / 2 + random.choice([-1, 1]) * power(random, -14, -1)
    size = power(random, -14, 1) * r, power(random, -14, 1) * r
    return *around(random, r * math.cos(t), r * math.sin(t), *size), 0.0, 0.0, r


FAMILIES = [
    pixel_on_the_circle,
    huge_circle_through_the_image,
    tangent,
    tangent_at_the_origin,
    corner_near_the_circle,
    corner_on_the_circle,
    corner_near_a_far_circle,
    tiny_disk,
    tiny_disk_on_a_corner,
    sliver,
]


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.__name__)
def test_exact_means_within_1e_14_relative(family):
    random = np.random.default_rng(20)
    partial = 0
    for _ in range(BOXES):
        x0, x1, y0, y1, cx, cy, r = (float(number) for number in family(random))
        if x0 == x1 or y0 == y1:
            continue  # The width asked for is below the ulp there.
        mean = Disk(radius=r, cx=cx, cy=cy).exact(np.array([x0, x1]), np.array([y0, y1]))[0, 0]
        truth = mean_by_strips(x0, x1, y0, y1, cx, cy, r)
        partial += 0 < truth < 1
        assert abs(mean - truth) <= 1e-14 * truth + 1e-300, (x0, x1, y0, y1, cx, cy, r)
    assert partial > BOXES / 5


def test_pixels_of_an_image_add_up_to_the_disk():
    edges = np.arange(513) / 512
    means = Disk().exact(edges, edges)
    assert means.shape == (512, 512)
    assert means.mean() == pytest.approx(math.pi * 0.3**2, rel=1e-14)
    assert means[272, 231] == 1.0  # The centre's.
    assert means[0, 0] == 0.0


def test_rows_are_y_and_columns_are_x():
    means = Disk(radius=0.5, cx=3.0, cy=0.5).exact(np.arange(5.0), np.arange(3.0))
    assert means.shape == (2, 4)
    assert means[0, 2] == means[0, 3] == pytest.approx(math.pi / 8, rel=1e-15)
    assert means.sum() == means[0, 2:].sum()


def test_radius_zero_is_empty():
    edges = np.linspace(0.0, 1.0, 9)
    disk = Disk(radius=0.0, cx=0.5, cy=0.5)
    assert not disk.exact(edges, edges).any()
    np.testing.assert_array_equal(disk.constant(edges, edges), 0.0)


def test_no_box_gives_nan():
    random = np.random.default_rng(21)
    for exponent in (-150, -100, -12, 0, 12, 100, 149):
        edges = np.unique(random.uniform(-3, 3, 6) * 10.0 ** random.uniform(-200, 200, 6))
        edges = np.unique(np.concatenate([edges, [0.0, 10.0**exponent, -(10.0**exponent)]]))
        for centre in (0.0, 1e-300, 0.3, 10.0**exponent):
            means = Disk(radius=10.0**exponent, cx=centre, cy=-centre).exact(edges, edges)
            assert ((means >= 0) & (means <= 1)).all()


@pytest.mark.parametrize("count", [1, 3, 16, 64, 1024])
def test_sums_count_the_samples_inside(count):
    random = np.random.default_rng(22)
    tile = random.random((40, 2, count))
    left, width, top, height = boxes = random.random((4, 40))
    out = np.full(40, np.nan)
    Disk(0.4, 0.6, 0.7).sums(tile, boxes, out)
    x = left[:, None] + tile[:, 0] * width[:, None] - 0.6
    y = top[:, None] + tile[:, 1] * height[:, None] - 0.7
    np.testing.assert_array_equal(out, (x * x + y * y < 0.4 * 0.4).sum(axis=1))


@pytest.mark.parametrize(
    ("disk", "size"),
    [
        (Disk(), 512),
        (Disk(), 61),
        (Disk(0.25, 0.5, 0.5), 64),  # Corners and edges of pixels on the circle.
        (Disk(5.0, -3.0, -4.0), 32),  # Through a corner of the image.
        (Disk(1e-3, 0.25, 0.75), 16),
        (Disk(1e12, 1e12, 0.3), 128),
        (Disk(1e9 + 0.5, 1e9, 0.3), 100),
    ],
)
def test_constant_pixels_give_that_value_at_every_sample(disk, size, constant_pixels):
    constant, sampled = constant_pixels(disk, size)
    known = ~np.isnan(constant)
    np.testing.assert_array_equal(sampled[known], constant[known])


def test_few_pixels_of_an_image_are_left_to_sample():
    edges = np.arange(513) / 512
    constant = Disk().constant(edges, edges)
    assert np.isnan(constant).mean() < 0.01
    known = ~np.isnan(constant)
    np.testing.assert_array_equal(constant[known], Disk().exact(edges, edges)[known])
