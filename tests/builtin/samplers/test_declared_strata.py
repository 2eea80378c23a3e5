"""Every stratum that a sampler declares holds its one point, in rational arithmetic.

Hammersley's i / N lies on a stratum's edge, which is no float64 unless N is a power of 2: the edge is then the float64
nearest to it, as the point is.
"""

import math

import numpy as np
import pytest

import samplekit

SQUARES = (1, 2, 4, 6, 12, 49, 96, 100, 961, 1024)
LARGE_SQUARES = (1026, 1056, 2025, 2048, 2491, 3000)  # 2491 = 53 x 47


def assert_once(cells, count):
    assert np.array_equal(np.sort(cells, axis=-1), np.broadcast_to(np.arange(count), cells.shape))


def sides(count, dims):
    """The grid nearest to a cube, longest side first."""
    if dims == 1:
        return (count,)
    found = [(s, *sides(count // s, dims - 1)) for s in range(1, count + 1) if count % s == 0]
    found = [grid for grid in found if list(grid) == sorted(grid, reverse=True)]
    return min(found, key=lambda grid: grid[0] / grid[-1])


def assert_grid(points, grid, exact_cells):
    """One of the points [R, N, dims] in each cell."""
    index = np.zeros(points.shape[:2], np.int64)
    for d, side in enumerate(grid):
        index = index * side + exact_cells(points[:, :, d], side)
    assert_once(index, math.prod(grid))


@pytest.mark.parametrize("count", [1, 2, 3, 7, 49, 97, 1000, 1023, 1024, 1025, 1999, 2001, 3001, 4096, 5000])
@pytest.mark.parametrize("name", ["latin-hypercube", "n-rooks"])
def test_latin_strata(name, count, exact_cells):
    points = samplekit.points(name, count, 2, realizations=100, seed=count)
    for d in range(2):
        assert_once(exact_cells(points[:, :, d], count), count)


@pytest.mark.parametrize("count", [2, 1024, 1999])
def test_latin_strata_in_many_dimensions(count, exact_cells):
    points = samplekit.points("latin-hypercube", count, 40, realizations=3)
    for d in range(40):
        assert_once(exact_cells(points[:, :, d], count), count)


@pytest.mark.parametrize("count", SQUARES + LARGE_SQUARES)
@pytest.mark.parametrize("name", ["multi-jittered", "correlated-multi-jittered"])
def test_multi_jittered_strata(name, count, exact_cells):
    points = samplekit.points(name, count, 4, realizations=100 if count <= 1024 else 25, seed=count)
    for d in range(4):
        assert_once(exact_cells(points[:, :, d], count), count)
    for pair in (points[:, :, :2], points[:, :, 2:]):
        assert_grid(pair, sides(count, 2), exact_cells)


@pytest.mark.parametrize("count", [6, 1024, 2025])
@pytest.mark.parametrize("name", ["multi-jittered", "correlated-multi-jittered"])
def test_multi_jittered_strata_in_an_odd_number_of_dimensions(name, count, exact_cells):
    points = samplekit.points(name, count, 5, realizations=20)
    for d in range(5):
        assert_once(exact_cells(points[:, :, d], count), count)


@pytest.mark.parametrize("dims", [1, 2, 3, 4])
@pytest.mark.parametrize("name", ["jittered", "regular"])
def test_grid_strata(name, dims, exact_cells):
    counts = {
        1: (1, 2, 3, 97, 1000, 1999, 2003),
        2: SQUARES + LARGE_SQUARES,
        3: (1, 2, 8, 12, 27, 1000, 2448),
        4: (1, 16, 81, 1296, 2401),
    }[dims]
    for count in counts:
        points = samplekit.points(name, count, dims, realizations=100, seed=count)
        assert_grid(points, sides(count, dims), exact_cells)


@pytest.mark.parametrize("power", range(13))
@pytest.mark.parametrize("name", ["hammersley", "hammersley+owen", "hammersley+xor"])
def test_hammersleys_first_dimension_has_strata(name, power, exact_cells):
    count = 2**power
    points = samplekit.points(name, count, 3, realizations=5, seed=power)
    assert_once(exact_cells(points[:, :, 0], count), count)


@pytest.mark.parametrize("count", [1, 3, 7, 49, 97, 100, 1000, 1999, 3001])
def test_hammersleys_first_dimension_has_strata_for_any_count(count, rounded_cells):
    assert_once(rounded_cells(samplekit.points("hammersley", count)[:, :, 0], count), count)


@pytest.mark.parametrize("power", [0, 1, 5, 10, 12])
@pytest.mark.parametrize("name", ["sobol", "sobol+owen", "sobol+xor"])
def test_every_dimension_of_sobol_has_strata(name, power, exact_cells):
    count = 2**power
    points = samplekit.points(name, count, 200, realizations=2, seed=power)
    for d in range(200):
        assert_once(exact_cells(points[:, :, d], count), count)


@pytest.mark.parametrize(
    "text", ["latin-hypercube", "multi-jittered", "correlated-multi-jittered", "jittered", "regular"]
)
def test_strata_at_large_indices(text, exact_cells):
    """Of 2^32 points, the last: each in the cell of its index or in one that no other of them is in."""
    count, start = 2**32, 2**32 - 3000
    points = samplekit.sampler(text).points(count, 2, realizations=2, seed=2, start=start)
    index = np.arange(start, count)
    if text in ("jittered", "regular", "multi-jittered", "correlated-multi-jittered"):
        assert np.array_equal(exact_cells(points[:, :, 0], 2**16), np.broadcast_to(index % 2**16, (2, 3000)))
        assert np.array_equal(exact_cells(points[:, :, 1], 2**16), np.broadcast_to(index // 2**16, (2, 3000)))
    if text in ("latin-hypercube", "multi-jittered", "correlated-multi-jittered"):
        for row in points:
            for d in range(2):
                assert np.unique(exact_cells(row[:, d], count)).size == 3000
