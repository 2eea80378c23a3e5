import numpy as np
import pytest
from scipy.stats import qmc

import samplekit

# Degree, inner coefficients, initial numbers of dimensions 2 to 10: Joe and Kuo 2008, new-joe-kuo-6.
TABLE = [
    (1, 0, [1]),
    (2, 1, [1, 3]),
    (3, 1, [1, 3, 1]),
    (3, 2, [1, 1, 1]),
    (4, 1, [1, 1, 3, 3]),
    (4, 4, [1, 3, 5, 13]),
    (5, 2, [1, 1, 5, 5, 17]),
    (5, 4, [1, 1, 5, 5, 5]),
    (5, 7, [1, 1, 7, 11, 19]),
]


def numbers(degree, coefficients, initial):
    """The direction numbers v_1, ..., v_32 as 32-bit fractions, by the recurrence of Bratley and Fox 1988."""
    v = [m << (31 - k) for k, m in enumerate(initial)]
    for k in range(degree, 32):
        value = v[k - degree] ^ (v[k - degree] >> degree)
        for i in range(1, degree):
            if coefficients >> (degree - 1 - i) & 1:
                value ^= v[k - i]
        v.append(value)
    return v


def coordinates(start, count, dims):
    """The points as 32-bit fractions."""
    points = samplekit.sampler("sobol").points(start + count, dims, start=start)[0]
    return (points * 2.0**32).astype(np.uint64)


def test_the_first_points():
    assert samplekit.points("sobol", 8)[0].tolist() == [
        [0.0, 0.0],
        [0.5, 0.5],
        [0.25, 0.75],
        [0.75, 0.25],
        [0.125, 0.625],
        [0.625, 0.125],
        [0.375, 0.375],
        [0.875, 0.875],
    ]


def test_direction_numbers_follow_the_published_recurrence():
    """Point 2^k is the direction number k."""
    found = np.array([coordinates(1 << k, 1, 10)[0] for k in range(32)])
    assert found[:, 0].tolist() == [1 << (31 - k) for k in range(32)]
    for dimension, row in enumerate(TABLE, start=1):
        assert found[:, dimension].tolist() == numbers(*row), dimension


def test_every_matrix_is_unit_upper_triangular():
    """Every dimension alone is a (0, 1)-sequence: direction number k ends at digit k, in all 4096 dimensions."""
    for k in range(32):
        [point] = coordinates(1 << k, 1, 4096)
        assert np.array_equal(
            point & -point.astype(np.int64).astype(np.uint64), np.full(4096, 1 << (31 - k), np.uint64)
        )


def test_points_are_sums_of_direction_numbers():
    directions = [coordinates(1 << k, 1, 7)[0] for k in range(32)]
    rng = np.random.default_rng(0)
    for index in [2**31 - 1, 2**31, 2**32 - 1, *rng.integers(0, 2**32, 20).tolist()]:
        expected = np.zeros(7, np.uint64)
        for k in range(32):
            if index >> k & 1:
                expected ^= directions[k]
        assert np.array_equal(coordinates(index, 1, 7)[0], expected)


def test_all_dimensions_are_scipys_in_another_order():
    """scipy numbers points by their Gray code."""
    index = np.arange(256)
    expected = qmc.Sobol(4096, scramble=False, bits=32).random(256)
    assert np.array_equal(samplekit.points("sobol", 256, 4096)[0][index ^ (index >> 1)], expected)


def test_many_points_are_scipys_in_another_order():
    index = np.arange(1 << 14)
    expected = qmc.Sobol(5, scramble=False, bits=32).random(1 << 14)
    assert np.array_equal(samplekit.points("sobol", 1 << 14, 5)[0][index ^ (index >> 1)], expected)


@pytest.mark.parametrize("name", ["sobol+owen", "sobol+xor"])
def test_scrambled_points_have_more_digits_than_the_sequence(name):
    """Without random digits after the 32nd every point would lie left in its cell."""
    words = samplekit.points(name, 64, 2, realizations=50) * 2.0**53
    low = words.astype(np.uint64) & np.uint64(2**21 - 1)
    assert np.array_equal(low, np.broadcast_to(low[:, :1], low.shape))
    assert np.unique(low[:, 0]).size > 90
    assert abs(low[:, 0].mean() / 2**21 - 0.5) < 5 / np.sqrt(12 * 100)
