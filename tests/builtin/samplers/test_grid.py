from fractions import Fraction

import numpy as np
import pytest
from scipy import stats

import samplekit


@pytest.mark.parametrize(
    ("count", "sides"), [(1, (1, 1)), (6, (3, 2)), (96, (12, 8)), (49, (7, 7)), (27, (3, 3, 3)), (97, (97,))]
)
def test_regular_points_are_the_centres(count, sides):
    points = samplekit.points("regular", count, len(sides), realizations=2, seed=3)
    for index, point in enumerate(points[1].tolist()):
        for x, side in zip(point, sides, strict=True):
            index, cell = divmod(index, side)
            assert abs(Fraction(x) - (cell + Fraction(1, 2)) / side) <= Fraction(1, 2**54)
    assert np.array_equal(points[0], points[1])


@pytest.mark.parametrize("name", ["regular", "jittered"])
def test_cells_come_row_by_row(name):
    points = samplekit.points(name, 96, realizations=5)
    index = np.arange(96)
    assert (np.floor(points[:, :, 0] * 12) == index % 12).all()
    assert (np.floor(points[:, :, 1] * 8) == index // 12).all()


def test_places_in_cells_are_uniform_and_independent():
    """Chi-square of 16 x 16 places in a cell, and of a place with that in the next cell: false alarms 1e-4 each."""
    points = samplekit.points("jittered", 36, realizations=2000, seed=1) * 6
    places = np.floor((points - np.floor(points)) * 16).astype(int)
    within = places[:, :, 0] * 16 + places[:, :, 1]
    neighbours = places[:, :-1, 0] * 16 + places[:, 1:, 0]
    rows = places[:, :-6, 1] * 16 + places[:, 6:, 1]
    for codes in (within, neighbours, rows):
        assert stats.chisquare(np.bincount(codes.ravel(), minlength=256)).pvalue > 1e-4


def test_one_point_is_a_random_point():
    points = samplekit.points("jittered", 1, 5, realizations=20000)[:, 0]
    assert np.abs(points.mean(axis=0) - 0.5).max() < 5 / np.sqrt(12 * 20000)
    assert stats.kstest(points.ravel(), "uniform").pvalue > 1e-4


def test_a_jittered_mean_of_x_has_the_variance_of_its_strata():
    """1 / (12 N^3) for f(x) = x in one dimension: 20000 estimates, 5 standard errors of 1 %, false alarms 6e-7."""
    estimates = samplekit.points("jittered", 50, 1, realizations=20000)[:, :, 0].mean(axis=1)
    assert estimates.var() * 12 * 50**3 == pytest.approx(1.0, abs=0.05)
    assert abs(estimates.mean() - 0.5) < 5 * np.sqrt(1 / (12 * 50**3) / 20000)
