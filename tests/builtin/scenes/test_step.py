import itertools
import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings, strategies

from samplekit._builtin.scenes.step import Step

BOXES = 200


def mean_by_clipping(x0, x1, y0, y1, cosine, sine, offset):
    """The mean over a box in rational numbers: clip the rectangle (Sutherland, Hodgman 1974), then Gauss's area."""
    x0, x1, y0, y1, cosine, sine, offset = map(Fraction, (x0, x1, y0, y1, cosine, sine, offset))
    rectangle = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    inside = []
    for start, end in zip(rectangle, rectangle[1:] + rectangle[:1], strict=True):
        here, there = (offset - cosine * x - sine * y for x, y in (start, end))
        if here >= 0:
            inside.append(start)
        if here * there < 0:
            t = here / (here - there)
            inside.append((start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])))
    twice = sum(a[0] * b[1] - b[0] * a[1] for a, b in itertools.pairwise([*inside, *inside[:1]]))
    return Fraction(twice) / (2 * (x1 - x0) * (y1 - y0))


ANGLES = {
    "any": lambda random: random.uniform(-720, 720),
    "nanodegrees": lambda random: random.choice([-1e-9, 1e-9]),
    "nearly-axis-aligned": lambda random: 90 * random.integers(-4, 5) + 10.0 ** random.uniform(-14, 0),
    "axis-aligned": lambda random: 90.0 * random.integers(-9, 10),
    "diagonal": lambda random: 45.0 * random.integers(-9, 10),
    "millions": lambda random: 1e6 * random.integers(-9, 10),
    "hardly-there": lambda random: 10.0 ** random.uniform(-300, -12),
}


def box_on_the_line(random, step, width, height, place):
    """A box about a point of the line, or with a corner there; and a step whose line passes that point."""
    x, y = random.uniform(-place, place, 2)
    x0 = x if random.random() < 0.2 else x - random.uniform(-0.01, 1.01) * width
    y0 = y if random.random() < 0.2 else y - random.uniform(-0.01, 1.01) * height
    return (x0, x0 + width, y0, y0 + height), step.cosine * x + step.sine * y


@pytest.mark.parametrize("place", [1.0, 1e6])
@pytest.mark.parametrize("angles", ANGLES.values(), ids=ANGLES.keys())
def test_exact_means_within_1e_15(angles, place):
    random = np.random.default_rng(30)
    partial = 0
    for _ in range(BOXES):
        angle = float(angles(random))
        smallest = -12 if place == 1.0 else -6
        width = 10.0 ** random.uniform(smallest, 0)
        height = width if random.random() < 0.5 else 10.0 ** random.uniform(smallest, 0)
        box, offset = box_on_the_line(random, Step(angle=angle), width, height, place)
        step = Step(angle=angle, offset=offset)
        mean = step.exact(np.array(box[:2]), np.array(box[2:]))[0, 0]
        truth = mean_by_clipping(*box, step.cosine, step.sine, step.offset)
        partial += 0 < truth < 1
        assert abs(Fraction(float(mean)) - truth) <= Fraction(1e-15), (angle, offset, box)
    assert partial > BOXES / 2


@settings(deadline=None, max_examples=300)
@given(
    strategies.floats(-1e6, 1e6),
    strategies.floats(-2, 2),
    strategies.floats(-1, 1),
    strategies.floats(-1, 1),
    strategies.floats(1e-12, 1),
    strategies.floats(1e-12, 1),
)
def test_exact_means_of_arbitrary_boxes(angle, offset, x0, y0, width, height):
    x, y = np.array([x0, x0 + width]), np.array([y0, y0 + height])
    step = Step(angle, offset)
    truth = mean_by_clipping(*x, *y, step.cosine, step.sine, step.offset)
    assert abs(Fraction(float(step.exact(x, y)[0, 0])) - truth) <= Fraction(1e-15)


@pytest.mark.parametrize("angle", [0.1, 1e-9, 30, 45, 89.999999, 123.4, 1e6, -1e15, 1e300, 720 + 1e-9, -359.5])
def test_direction_is_that_of_the_angle(angle):
    step = Step(angle=angle)
    with mpmath.workdps(400):
        radians = mpmath.radians(mpmath.mpf(angle))
        assert abs(step.cosine - mpmath.cos(radians)) <= 2e-16
        assert abs(step.sine - mpmath.sin(radians)) <= 2e-16


@pytest.mark.parametrize("turns", [0, 360, -720, 360 * 10**9])
def test_right_angles_are_exact(turns):
    directions = [(Step(turns + 90 * k).cosine, Step(turns + 90 * k).sine) for k in range(4)]
    assert directions == [(1, 0), (0, 1), (-1, 0), (0, -1)]
    diagonals = [(Step(turns + 45 + 90 * k).cosine, Step(turns + 45 + 90 * k).sine) for k in range(4)]
    half = math.sqrt(0.5)
    assert diagonals == [(half, half), (-half, half), (-half, -half), (half, -half)]


def test_an_axis_aligned_image_has_one_column_of_fractions():
    edges = np.arange(11) / 10
    means = Step(angle=0, offset=0.3125).exact(edges, edges)
    np.testing.assert_array_equal(means[:, :3], 1.0)
    np.testing.assert_array_equal(means[:, 4:], 0.0)
    np.testing.assert_allclose(means[:, 3], (0.3125 - edges[3]) / (edges[4] - edges[3]), rtol=1e-15)
    np.testing.assert_array_equal(Step(angle=90, offset=0.3125).exact(edges, edges), means.T)
    opposite = Step(angle=180, offset=-0.3125).exact(edges, edges)
    np.testing.assert_allclose(opposite, 1.0 - means, atol=1e-15)


def test_the_diagonal_halves_its_pixels():
    edges = np.arange(17) / 16
    means = Step(angle=-45, offset=0.0).exact(edges, edges)  # Ones where x < y.
    np.testing.assert_array_equal(means, np.tri(16, k=-1) + np.eye(16) / 2)


@pytest.mark.parametrize("count", [1, 3, 16, 64, 1024])
def test_sums_count_the_samples_on_the_side_of_ones(count):
    random = np.random.default_rng(31)
    tile = random.random((40, 2, count))
    left, width, top, height = boxes = random.random((4, 40))
    out = np.full(40, np.nan)
    step = Step(angle=33.0, offset=1.1)
    step.sums(tile, boxes, out)
    x = left[:, None] + tile[:, 0] * width[:, None]
    y = top[:, None] + tile[:, 1] * height[:, None]
    np.testing.assert_array_equal(out, (step.cosine * x + step.sine * y < step.offset).sum(axis=1))


@pytest.mark.parametrize("size", [61, 64, 256])
@pytest.mark.parametrize(
    ("angle", "offset"),
    [(0.0, 0.5), (90.0, 0.5), (180.0, -0.25), (-45.0, 0.0), (45.0, 0.75), (1e-9, 0.5), (200.0, -0.6), (1e6, 0.1)],
)
def test_constant_pixels_give_that_value_at_every_sample(angle, offset, size, constant_pixels):
    step = Step(angle, offset)
    edges = np.arange(size + 1) / size
    constant, sampled = constant_pixels(step, size)
    known = ~np.isnan(constant)
    np.testing.assert_array_equal(sampled[known], constant[known])
    assert known.mean() > 1 - 3 / size
    np.testing.assert_allclose(step.exact(edges, edges).ravel()[known], constant[known], rtol=0, atol=1e-13)
