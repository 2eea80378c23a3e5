"""Means and variances over realisations: large means, small deviations, and merges in any order."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

import samplekit
from samplekit._stability.measurement import _digits_lost, _root_mean_square, _spread

ROUNDOFF = Fraction(1, 2**53)


def exact_variance(values):
    values = [Fraction(float(value)) for value in values]
    mean = sum(values) / len(values)
    return sum((value - mean) ** 2 for value in values) / (len(values) - 1)


def deviations(seed=0, count=1000):
    return np.random.default_rng(seed).standard_normal(count)


DATA = {
    "unit": deviations(),
    "large-mean-1e8": 1e8 + deviations(),
    "large-mean-1e15": 1e15 + np.round(deviations() * 8),
    "mean-far-above-the-spread": 1.0 + deviations() * 1e-13,
    "one-large": np.concatenate([[1e8], deviations()]),
    "huge": deviations() * 1e200,
    "tiny": deviations() * 1e-200,
    "denormal": np.arange(1, 50) * 2.0**-1070,
    "1e300-twice": np.array([1e300, 1e300, 1e299]),
}


@pytest.mark.parametrize("values", DATA.values(), ids=DATA.keys())
def test_the_spread_is_that_of_exact_arithmetic(values):
    """Within 20 roundings and one of the mean, which takes part once: no difference of squares is formed."""
    spread, exact = Fraction(_spread(values)), exact_variance(values)
    largest = max(abs(Fraction(float(value))) for value in values)
    tolerance = 40 * ROUNDOFF * exact + (largest * ROUNDOFF) ** 2 + Fraction(1, 2**1050) ** 2
    assert abs(spread * spread - exact) <= tolerance


def test_a_root_mean_square_neither_overflows_nor_vanishes():
    for scale in (1e-300, 1e-160, 1.0, 1e160, 1e300):
        assert _root_mean_square(np.array([3.0, -4.0]) * scale) == pytest.approx(np.sqrt(12.5) * scale, rel=1e-15)
    assert _root_mean_square(np.zeros(3)) == 0.0


def test_digits_lost_of_denormal_sums_are_finite():
    tiny = np.array([5e-324])
    assert _digits_lost(tiny, tiny) == pytest.approx(53 * np.log10(2), rel=1e-15)


def test_spectra_merge_in_any_order_within_a_few_roundings():
    """Powers on a large mean, in three parts: all six orders against exact means and variances."""
    spectrum = pytest.importorskip("samplekit_spectrum.moments")
    random = np.random.default_rng(8)
    rings = np.array([0, 1, 1, 2], np.int32)
    amplitudes = 1e4 + random.standard_normal((30, 4)) + 1j * random.standard_normal((30, 4))
    powers = [[abs_squared(value) for value in row] for row in amplitudes]
    means = [sum(column) / 30 for column in zip(*powers, strict=True)]
    for order in itertools.permutations(range(3)):
        total = spectrum.Moments(rings)
        for part in order:
            moments = spectrum.Moments(rings)
            moments.add([(0, amplitudes[10 * part : 10 * part + 10])], 10, 1, exact_dc=False)
            total.merge(moments)
        for k in range(1, 4):
            deviation = sum((row[k] - means[k]) ** 2 for row in powers)
            assert abs(Fraction(float(total.mean[k])) - means[k]) <= 8 * ROUNDOFF * means[k]
            # Powers of 1e8 that are rounded once, over deviations of 1e4.
            assert abs(Fraction(float(total.squares[k])) - deviation) <= Fraction(1e-11) * deviation


def abs_squared(value):
    return Fraction(float(value.real)) ** 2 + Fraction(float(value.imag)) ** 2


def test_realisations_do_not_depend_on_how_many_are_asked_for_at_once():
    """Partial results put side by side are the whole, bit for bit."""
    whole = samplekit.estimate("offset:pedestal=1e8", "sobol+owen", 300, realizations=40, seed=2)
    for part in (1, 7, 39):
        assert np.array_equal(
            samplekit.estimate("offset:pedestal=1e8", "sobol+owen", 300, realizations=part, seed=2), whole[:part]
        )
