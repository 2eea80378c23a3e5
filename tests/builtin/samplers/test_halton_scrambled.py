"""Halton's sequence with its digits scrambled: uniform, in bases of any size, and free of their correlation."""

import numpy as np
import pytest
from scipy import stats

import samplekit
from samplekit.kernels._digits import primes

SCRAMBLED = ["halton:scramble=digits", "halton:scramble=owen"]
LARGE = [998, 999]
"""The dimensions of 7907 and 7919."""


def correlations(text, realizations):
    points = samplekit.points(text, 256, 1000, realizations=realizations, seed=3)[:, :, LARGE]
    return np.array([np.corrcoef(one.T)[0, 1] for one in points])


def test_large_bases_are_correlated_without_a_scrambling():
    assert primes(1000)[998:] == (7907, 7919)
    assert correlations("halton", 1) == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("text", SCRAMBLED)
def test_scrambled_large_bases_are_not(text):
    """Random points: mean 0, root mean square 1/16. 100 sets; the mean within 4.5 standard errors."""
    found = correlations(text, 100)
    assert abs(found.mean()) < 4.5 * found.std() / 10
    assert np.sqrt((found**2).mean()) < 0.1


@pytest.mark.parametrize("text", SCRAMBLED)
def test_every_digit_place_is_uniform(text):
    """The first two digits of points 0 and 7 over 20000 realisations: 8 chi-square tests, false alarms 1e-4 each."""
    points = samplekit.points(text, 8, 4, realizations=20000, seed=4)
    for d, base in enumerate((2, 3, 5, 7)):
        for i in (0, 7):
            cells = np.floor(points[:, i, d] * base**2).astype(int)
            assert stats.chisquare(np.bincount(cells, minlength=base**2)).pvalue > 1e-4


def test_digits_permutes_each_place_the_same_way_for_all_points():
    """In base 7: the second digit of a point depends on the second digit of its index alone.

    Of 50 random permutations of 7 digits, six or more come again with a probability of 3e-7.
    """
    points = samplekit.points("halton:scramble=digits", 49, 4, realizations=50, seed=5)[:, :, 3]
    second = np.floor(points * 49).astype(int).reshape(50, 7, 7) % 7
    assert (second == second[:, :, :1]).all()
    assert (np.sort(second[:, :, 0], axis=1) == np.arange(7)).all()
    assert np.unique(second[:, :, 0], axis=0).shape[0] > 44


def test_permutations_of_digits_are_uniform():
    """Images of the digits 0, 1, 2 in base 3, jointly, over 30000 realisations: false alarms 1e-4."""
    points = samplekit.points("halton:scramble=digits", 3, 2, realizations=30000, seed=6)[:, :, 1]
    digits = np.floor(points * 3).astype(int)
    orders = np.unique(digits, axis=0, return_counts=True)[1]
    assert orders.size == 6
    assert stats.chisquare(orders).pvalue > 1e-4


def test_the_slope_on_the_disk_is_that_of_stratified_points():
    """Root mean square error over 1000 sets at 2^4 ... 2^10: measured slopes of the variance -1.49."""
    counts = 2 ** np.arange(4, 11)
    for text in SCRAMBLED:
        variances = [
            samplekit.estimate("disk:radius=0.3", text, count=int(n), realizations=1000, seed=1).var() for n in counts
        ]
        assert np.polyfit(np.log(counts), np.log(variances), 1)[0] < -1.4
