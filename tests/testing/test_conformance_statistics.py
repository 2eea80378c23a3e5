"""The statistical checks raise false alarms as rarely as they say, and see what they say they see."""

import math

import numpy as np
import pytest

from samplekit.testing import _statistics as statistics
from samplekit.testing._checks import joint
from samplekit.testing._checks.dimensions import pair_correlations
from samplekit.testing._checks.joint import held_in_cells, walsh
from samplekit.testing._checks.uniformity import SIDE, cell_counts, integrands


def test_the_shares_add_up_to_the_family_rate():
    assert statistics.family_rate(64) == pytest.approx(1e-3)
    assert pytest.approx(1e-3) == 64 * statistics.CHECK_RATE * statistics.STATISTICAL_CHECKS


def test_thresholds_are_quantiles():
    # Tails of the normal distribution, of Student's with many degrees, of chi-square with two (the exponential).
    z = statistics.normal_threshold(10)
    assert math.erfc(z / math.sqrt(2)) * 10 == pytest.approx(statistics.CHECK_RATE, rel=1e-6)
    assert statistics.student_threshold(10, 10**7) == pytest.approx(z, rel=1e-4)
    assert math.exp(-statistics.chi_square_threshold(10, 2) / 2) * 10 == pytest.approx(statistics.CHECK_RATE, rel=1e-6)


def test_chi_square_of_uniform_points_has_the_quantiles_it_should():
    """At a threshold of 1 in 20, so that false alarms can be counted: 400 samples of 524 706 points."""
    from scipy.special import chdtri

    rng = np.random.default_rng(8)
    expected = 546.0
    counts = rng.multinomial(546 * SIDE**2, np.full(SIDE**2, 1 / SIDE**2), size=400)
    statistic = ((counts - expected) ** 2).sum(axis=1) / expected
    alarms = int((statistic > chdtri(SIDE**2 - 1, 0.05)).sum())
    assert 5 <= alarms <= 38  # 20 expected; 4 standard deviations


def test_the_density_that_is_seen_is_the_one_that_is_stated():
    rng = np.random.default_rng(9)
    weights = 1.0 + 0.024 * rng.choice([-1.0, 1.0], SIDE**2)
    counts = rng.multinomial(546 * SIDE**2, weights / weights.sum(), size=200)
    statistic = ((counts - 546.0) ** 2).sum(axis=1) / 546.0
    assert (statistic > statistics.chi_square_threshold(2, SIDE**2 - 1)).mean() > 0.9


def test_cells_are_counted():
    x, y = np.meshgrid((np.arange(SIDE) + 0.5) / SIDE, (np.arange(SIDE) + 0.5) / SIDE)
    assert (cell_counts(np.stack([x.ravel(), y.ravel()]), (0, 1)) == 1).all()


def test_integrals_are_those_of_the_integrands():
    """Against the midpoint rule, whose error on 400 x 400 points is below 1e-3 for steps."""
    x, y = np.meshgrid((np.arange(400) + 0.5) / 400, (np.arange(400) + 0.5) / 400)
    grid = np.stack([x.ravel(), y.ravel()])[None]
    for each in integrands(2):
        assert each.function(grid).mean() == pytest.approx(each.integral, abs=1.5e-3), each.name


def test_correlations_are_pearsons():
    rng = np.random.default_rng(3)
    values = rng.random((2, 3, 50))
    found = pair_correlations(values)
    for row in range(2):
        matrix = np.corrcoef(values[row])
        assert found[row] == pytest.approx([matrix[0, 1], matrix[0, 2], matrix[1, 2]])
    values[0, 1] = 0.5
    assert pair_correlations(values)[0, 0] == 0.0


def test_the_bias_and_the_correlation_that_are_seen_are_those_that_are_stated():
    """Nine times in ten means 1.28 standard deviations beyond the threshold."""
    beyond = 1.2816
    bias = (statistics.normal_threshold(25) + beyond) * math.sqrt(1 / 12) / math.sqrt(2**14 * 256)
    assert bias == pytest.approx(9.3e-4, rel=0.05)
    neighbours = (statistics.normal_threshold(48) + beyond) / math.sqrt(2**17)
    assert neighbours <= 0.02
    # Padded nets have twice the variance of independent points.
    dimensions = (statistics.normal_threshold(56) + beyond) * math.sqrt(2 / (64 * 4095))
    assert dimensions <= 0.019


def test_the_joint_density_that_is_seen_is_the_one_that_is_stated():
    """Nine times in ten: an interval that holds n points is known to 1 / sqrt(n)."""
    whole, quick = (
        (joint._POINTS, joint._GROUPS, 0.003, 0.024),
        (joint._QUICK_POINTS, joint._QUICK_GROUPS, 0.013, 0.101),
    )
    for points, groups, half, narrow in (whole, quick):
        beyond = statistics.student_threshold(joint._TESTS, groups - 1) + 1.2816
        assert beyond / math.sqrt(points) <= half
        assert beyond / math.sqrt(points / 64) <= narrow


def test_coincidences_are_limited_by_their_rate():
    """The limit is a tail of the Poisson distribution, here summed by hand."""
    limit = statistics.poisson_threshold(3.0, 10)
    below = math.fsum(math.exp(-3.0) * 3.0**n / math.factorial(n) for n in range(limit))
    assert 1.0 - below <= statistics.CHECK_RATE / 10
    assert statistics.poisson_threshold(1e-9, 10) == 2


def test_cells_hold_every_point_once():
    points = np.random.default_rng(4).random((3, 5000))
    held = dict(held_in_cells(points, {1: 16, 2: 4, 3: 2}))
    assert list(held) == [(0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)]
    assert all(each.sum() == 5000 for each in held.values())
    assert held[0, 1][4 * 3 + 1] == ((points[0] >= 0.75) & (points[1] >= 0.25) & (points[1] < 0.5)).sum()


def test_walsh_functions_see_what_no_pair_of_dimensions_shows():
    held = np.zeros((1, 2, 2, 2))
    for x, y, z in ((0, 0, 1), (0, 1, 0), (1, 0, 0), (1, 1, 1)):
        held[0, x, y, z] = 1.0
    found = walsh(held)[0]
    assert found[0, 0, 0] == 4.0
    assert found[1, 1, 1] == -4.0
    assert np.count_nonzero(found) == 2
