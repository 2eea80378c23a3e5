"""Pmj02: the order in which it fills the square, prefixes, padded pairs, and the rates of scrambled nets."""

import numpy as np
import pytest

import samplekit
from samplekit._builtin.samplers.pmj02 import pmj02_columns


def cells(points, digits):
    return np.floor(points * 2**digits).astype(int)


@pytest.mark.parametrize("k", [0, 1, 2, 3, 4])
def test_point_4_k_plus_i_lies_opposite_point_i_in_the_same_cell(k):
    n = 4**k
    points = samplekit.points("pmj02", 2 * n, realizations=5, seed=k)
    first, second = points[:, :n], points[:, n:]
    assert np.array_equal(cells(first, k), cells(second, k))
    assert (cells(first, k + 1) != cells(second, k + 1)).all()


@pytest.mark.parametrize("k", [0, 1, 2, 3, 4])
def test_point_2_4_k_plus_i_differs_from_point_i_in_one_coordinate(k):
    n = 2 * 4**k
    points = samplekit.points("pmj02", 2 * n, realizations=5, seed=k)
    first, second = points[:, :n], points[:, n:]
    assert np.array_equal(cells(first, k), cells(second, k))
    moved = cells(first, k + 1) != cells(second, k + 1)
    assert (moved.sum(axis=2) == 1).all()
    assert moved[..., k % 2].all()


def test_columns_are_triangular():
    """Column m of both matrices ends with digit m + 1: each prefix of 2^m is stratified in x and in y."""
    columns = pmj02_columns()
    for m in range(32):
        assert columns[0, m] & -columns[0, m].astype(np.int64) == 1 << (31 - m)


def test_a_prefix_is_a_set_of_its_own():
    whole = samplekit.points("pmj02", 3000, 6, realizations=2, seed=3)
    for count in (1, 2, 3, 64, 100, 2048):
        assert np.array_equal(samplekit.points("pmj02", count, 6, realizations=2, seed=3), whole[:, :count])


def test_pairs_are_shuffled_on_their_own():
    """Points 0 and 2 share a half of y where the order is pmj02's, by chance where it is shuffled."""
    halves = samplekit.points("pmj02", 4, 8, realizations=4000, seed=9) >= 0.5
    shared = (halves[:, 0] == halves[:, 2]).mean(axis=0)
    assert shared[:2].tolist() == [0.0, 1.0]
    assert np.abs(shared[2:] - 0.5).max() < 0.05
    together = ((halves[:, 0, 3] == halves[:, 2, 3]) & (halves[:, 0, 5] == halves[:, 2, 5])).mean()
    assert abs(together - 0.25) < 0.04


def exact(scene):
    return float(samplekit.scene(scene).exact(np.array([0.0, 1.0]), np.array([0.0, 1.0]))[0, 0])


@pytest.mark.parametrize(("scene", "slope", "within"), [("disk", -1.5, 0.12), ("gaussian", -2.75, 0.2)])
@pytest.mark.parametrize("text", ["pmj02", "owen-sobol"])
def test_error_falls_as_that_of_owens_scrambling(text, scene, slope, within):
    counts = 2 ** np.arange(4, 13)
    mse = [np.mean((samplekit.estimate(scene, text, n, realizations=300, seed=1) - exact(scene)) ** 2) for n in counts]
    assert np.polyfit(np.log(counts), np.log(mse), 1)[0] == pytest.approx(slope, abs=within)
