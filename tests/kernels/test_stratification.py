from fractions import Fraction

import numpy as np
import pytest

from samplekit.kernels import _stratification as stratification

LARGEST = np.uint64(2**64 - 1)


def plain(function):
    return getattr(function, "py_func", function)


offset_bits, place_in_cell = plain(stratification.offset_bits), plain(stratification.place_in_cell)


def place(cell, random, cells):
    bits = offset_bits(cells)
    return float(place_in_cell(float(cell), np.uint64(random), np.uint64(64 - bits), 2.0**-bits, 1.0 / cells))


def assert_inside(cell, cells):
    for random in (0, LARGEST):
        x = place(cell, random, cells)
        assert Fraction(cell, cells) < Fraction(x) < Fraction(cell + 1, cells), (cell, cells, random)
        assert 0.0 < x < 1.0


@pytest.mark.parametrize("first", range(1, 2001, 250))
def test_extremes_lie_in_their_cell(first):
    """Also where (i + r) / n is 1.0 for the largest r below 1, which is so for every n from 2 to 1999."""
    for cells in range(first, first + 250):
        for cell in {0, 1 % cells, cells // 3, cells // 2, max(cells - 2, 0), cells - 1}:
            assert_inside(cell, cells)


@pytest.mark.parametrize("cells", [3, 49, 1025, 1999])
def test_extremes_lie_in_every_cell(cells):
    for cell in range(cells):
        assert_inside(cell, cells)


@pytest.mark.parametrize("cells", [2**16 - 1, 2**16 + 1, 10**6, 2**24 + 3, 2**31 - 1, 2**31, 2**32 - 5, 2**32])
def test_extremes_lie_in_their_cell_of_very_many(cells):
    rng = np.random.default_rng(cells)
    for cell in {0, 1, cells // 2, cells - 2, cells - 1, *(int(c) for c in rng.integers(0, cells, 200))}:
        assert_inside(cell, cells)


@pytest.mark.parametrize(("cells", "bits"), [(1, 50), (2, 49), (3, 48), (4, 48), (5, 47), (1024, 40), (1025, 39)])
def test_bits_of_a_place(cells, bits):
    assert offset_bits(cells) == bits


def test_places_are_centred_in_their_cell():
    """The extremes are equally far from both ends, so that the mean over random words is the cell's centre."""
    for cells in (1, 2, 8, 1024):
        low, high = place(0, 0, cells), place(0, LARGEST, cells)
        assert Fraction(low) + Fraction(high) == Fraction(1, cells)
