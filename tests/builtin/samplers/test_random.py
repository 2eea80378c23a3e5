import numpy as np
import pytest
from scipy import stats

import samplekit


def test_points_are_uniform_in_the_square():
    """Chi-square on 31 x 31 cells, 61 a cell: false alarms 1e-4."""
    points = samplekit.points("random", 61 * 961, seed=11)[0]
    cells = np.floor(points * 31).astype(int)
    assert stats.chisquare(np.bincount(cells[:, 0] * 31 + cells[:, 1], minlength=961)).pvalue > 1e-4


def test_coordinates_are_uniform_in_every_dimension():
    """Kolmogorov-Smirnov in 50 dimensions: false alarms 1e-4 together."""
    points = samplekit.points("random", 5000, 50, seed=12)[0]
    assert min(stats.kstest(row, "uniform").pvalue for row in points.T) > 1e-4 / 50


@pytest.mark.parametrize("lag", [1, 2, 3, 64, 1024])
def test_successive_points_are_independent(lag):
    """Joint counts of a coordinate and the one ``lag`` later on 16 x 16 cells: false alarms 1e-4 each."""
    points = samplekit.points("random", 60000, 1, seed=13)[0, :, 0]
    cells = np.floor(points * 16).astype(int)
    assert stats.chisquare(np.bincount(cells[:-lag] * 16 + cells[lag:], minlength=256)).pvalue > 1e-4


def test_the_low_digits_are_as_random_as_the_high():
    """Each of 53 bits over 60000 numbers: within 5 standard errors, false alarms 3e-5."""
    words = (samplekit.points("random", 60000, 1, seed=14)[0, :, 0] * 2.0**53).astype(np.uint64)
    ones = [np.count_nonzero(words >> np.uint64(bit) & np.uint64(1)) for bit in range(53)]
    assert np.abs(np.array(ones) / 60000 - 0.5).max() < 5 * 0.5 / np.sqrt(60000)


def test_a_million_points_are_distinct():
    points = samplekit.points("random", 10**6, 1, seed=15)[0, :, 0]
    assert np.unique(points).size >= 10**6 - 1


def test_points_do_not_depend_on_the_count():
    assert np.array_equal(samplekit.points("random", 7, 3), samplekit.points("random", 5000, 3)[:, :7])
