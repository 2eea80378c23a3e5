"""Confidence intervals: over independent trials, and of numbers that follow from several others.

The squared error of one estimate is heavily skewed. For a normal error its relative variance is 2, for other errors it
is larger, and sometimes one trial in a hundred contributes most of the mean. An interval by Student's t then covers the
truth far too rarely. The interval used here, at 95 %, takes at either end the wider of

- Hall's transformation of t, which corrects for the observed skewness (Hall 1992, "On the removal of skewness by
  transformation", J. R. Stat. Soc. B 54(1)); and
- the interval of a multiple of chi-square with the degrees of freedom that its variance implies (Satterthwaite 1946);
  the variance is raised for small samples, which tend to miss the rare large values. For many pixels, whose mean square
  is nearly normal, Student's t of the logarithm takes its place.

At the upper end the squares vary at least about as much as those of normal errors: few trials of an estimate with few
values, such as the share of samples inside a shape, may all be alike and miss the rarer and larger errors.

The mean error of an unbiased sampler is known: it is 0. Where the mean of the trials is not, large errors on one side
are missing among them, and the upper end is raised by what a regression of the squares on the errors expects of those.

From ``LEAST_TRIALS`` trials of one pixel on, the interval covers the truth in 90 to 99 % of studies for uniform, normal
and exponential errors and for shares of samples inside a shape that many samples hit. Heavier tails need more trials:
``benchmarks/coverage.py`` measures how many.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtri, stdtrit

from samplekit._study.results import LEVEL, Interval

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit._study.trials import Array

LEAST_TRIALS = 32
"""Smallest number of trials of one pixel from which intervals are taken; with fewer they cover too rarely."""
_TAIL = (1.0 - LEVEL) / 2.0
_NORMAL = 2.0
"""Relative variance of the square of a normal variable with mean 0."""
_FEW = 5
"""Smallest number of batches whose own skewness is used."""
_TYPICAL, _UPPER = (10.0, 4.0), (200.0, 8.0)
"""How the observed variance of squared errors is raised, in general and for the upper end of an interval: the weight
of the normal expectation, in trials, and for how many more batches large values are reckoned with."""


@lru_cache(1024)
def student(dof: float) -> float:
    """Return the bound within which 95 % of Student's t with ``dof`` degrees of freedom lies."""
    return float(stdtrit(max(dof, 1e-3), 1.0 - _TAIL))


@lru_cache(1024)
def far_student(dof: float) -> float:
    """Return the bound beyond which Student's t with ``dof`` degrees of freedom lies once in 1000 cases."""
    return float(stdtrit(max(dof, 1e-3), 1.0 - 0.5e-3))


def mean_interval(sums: Array, sizes: Array) -> Interval:
    """Return the mean of nearly normal numbers, with its interval by Student's t.

    Parameters
    ----------
    sums, sizes
        float64[B]: the sums over batches of independent numbers, and the number of numbers in each.
    """
    mean, error = mean_and_error(sums, sizes)
    if mean is None or error is None:
        return Interval(mean)
    half = student(_count_batches(sizes) - 1) * error
    return Interval(mean, mean - half, mean + half)


def positive_interval(sums: Array, sizes: Array, *, one_pixel: bool, missed: float = 1.0) -> Interval:
    """Return the mean of squared errors, with an interval that allows for their skewness: see the module.

    Parameters
    ----------
    sums, sizes
        float64[B]: the sums over batches of independent numbers, and the number of numbers in each.
    one_pixel
        Whether the numbers are squares of single errors; otherwise they are means over many pixels.
    missed
        The factor, from 1 on, by which the upper end is raised for large errors that are missing among the trials.
    """
    mean, error = mean_and_error(sums, sizes)
    # If all trials are exact, none tells how large the error of the next may be.
    if mean is None or error is None or mean <= 0.0:
        return Interval(mean)
    batches = _count_batches(sizes)
    relative = batches * (error / mean) ** 2
    if one_pixel:
        low, high = _by_chi_square(relative, batches, float(sizes.sum()) / batches)
    else:
        reach = student(batches - 1) * math.sqrt(relative / batches)
        low, high = math.exp(-min(reach, 700.0)), math.exp(min(reach, 700.0))
    if batches < _FEW:
        return Interval(mean, mean * low, mean * high)
    skew_low, skew_high = _by_hall(sums, sizes, mean, error)
    return Interval(mean, min(mean * low, max(skew_low, 0.0)), max(mean * high, skew_high) * missed)


def derived_interval(value: Callable[..., float], inputs: Sequence[Interval]) -> Interval:
    """Return the interval of a positive number that follows from independent ones.

    Each input is moved to either end of its interval while the others stay; in logarithms, the deviations of the number
    in either direction are added as independent ones are, by their squares. For products and sums this is the method of
    variance estimates recovery (Zou and Donner 2008, "Construction of confidence limits about effect measures", Stat.
    Med. 27(10)).

    Parameters
    ----------
    value
        Returns the number, above 0, for values of the inputs.
    inputs
        Intervals with an estimate and both ends.
    """
    estimates = [each.estimate or 0.0 for each in inputs]
    estimate = value(*estimates)
    low = high = 0.0
    for place, each in enumerate(inputs):
        moved = [[*estimates[:place], end or 0.0, *estimates[place + 1 :]] for end in (each.low, each.high)]
        deviations = [math.log(value(*one) / estimate) for one in moved]
        low, high = math.hypot(low, min(0.0, *deviations)), math.hypot(high, max(0.0, *deviations))
    return Interval(estimate, estimate * math.exp(-low), estimate * math.exp(high))


def raised_variance(relative: float, batches: int, per_batch: float, raised: tuple[float, float] = _TYPICAL) -> float:
    """Return the relative variance of squared errors to reckon with, where ``relative`` was observed.

    Few batches tend to miss the rare large values, and all of few may be alike: at least a part is what normal errors
    would have.
    """
    weight, more = raised
    expected = (relative * batches + weight * _NORMAL / per_batch) / (batches + weight)
    missed = (batches + more) / (batches - 2) if batches >= _FEW else 1.0
    return max(relative * missed, expected)


def _by_chi_square(relative: float, batches: int, per_batch: float) -> tuple[float, float]:
    """Return low / mean and high / mean for a mean of ``batches`` numbers with this relative variance."""
    most, least = (2.0 * batches / raised_variance(relative, batches, per_batch, each) for each in (_TYPICAL, _UPPER))
    return most / float(chdtri(most, _TAIL)), least / max(float(chdtri(least, 1.0 - _TAIL)), 1e-300)


def _by_hall(sums: Array, sizes: Array, mean: float, error: float) -> tuple[float, float]:
    """Return the ends of the interval by Hall's transformation."""
    batches = _count_batches(sizes)
    deviations = (sums - sizes * mean)[sizes > 0]
    spread = math.sqrt(float(np.mean(deviations**2)))
    skewness = float(np.mean((deviations / spread) ** 3)) / math.sqrt(batches) if spread > 0.0 else 0.0
    reach = student(batches - 1)
    if abs(skewness) < 1e-6:
        return mean - reach * error, mean + reach * error

    def inverse(t: float) -> float:
        return 3.0 / skewness * (float(np.cbrt(1.0 + skewness * (t - skewness / 6.0))) - 1.0)

    return mean - error * inverse(reach), mean - error * inverse(-reach)


def _count_batches(sizes: Array) -> int:
    """Return the number of batches that are not empty."""
    return int(np.count_nonzero(sizes))


def mean_and_error(sums: Array, sizes: Array) -> tuple[float | None, float | None]:
    """Return the mean and its standard error; None for the mean of nothing, and for the error of a single batch."""
    total = float(sizes.sum())
    if total == 0.0:
        return None, None
    mean = float(np.sum(sums)) / total
    if not math.isfinite(mean):
        return None, None
    batches = _count_batches(sizes)
    if batches < 2:
        return mean, None
    # Batches may differ in size: this is the error of a ratio of sums (Cochran 1977, "Sampling Techniques", 6.3).
    deviations = sums - sizes * mean
    error = math.sqrt(batches / (batches - 1) * float(np.sum(deviations * deviations))) / total
    return mean, error if math.isfinite(error) else None
