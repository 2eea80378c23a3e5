"""From the sums of a cell's trials to its errors and their intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._study.intervals import mean_interval, positive_interval, student
from samplekit._study.results import Interval
from samplekit._study.trials import BLURRED, ERROR, INVALID, PAIRS, PRODUCT, SQUARE, TRIALS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@dataclass(frozen=True)
class Errors:
    """Errors of a cell; see :class:`samplekit._study.results.Row`."""

    trials: int
    mse: Interval
    rmse: Interval
    bias: Interval
    variance: Interval
    squared_bias: Interval
    blurred_mse: Interval | None
    invalid_pixels: int


def errors_of(sums: Array, *, one_pixel: bool) -> Errors:
    """The errors, from the batches float64[B, COLUMNS] in the order of their trials."""
    trials = sums[:, TRIALS]
    mse = positive_interval(sums[:, SQUARE], trials, one_pixel=one_pixel)
    pairs = _pairs(sums)
    return Errors(
        int(trials.sum()),
        mse,
        _root(mse),
        mean_interval(sums[:, ERROR], trials),
        _variance_of_one(sums) if one_pixel else _variance_of_pairs(pairs),
        mean_interval(pairs[:, PRODUCT], pairs[:, PAIRS]),
        None if one_pixel else positive_interval(sums[:, BLURRED], trials, one_pixel=False),
        int(sums[:, INVALID].sum()),
    )


def influence(sums: Array) -> Array:
    """How much each batch float64[B] adds to the relative deviation of the mean square, 0 on the whole."""
    squares, trials = sums[:, SQUARE], sums[:, TRIALS]
    mean = float(np.sum(squares)) / trials.sum()
    deviations: Array = (squares - trials * mean) / (mean * trials.sum())
    return deviations


def ratio_of(sums: Array, baseline: Array) -> Interval | None:
    """The mean square over that of another sampler, whose trials have the same seeds.

    Where trials go together their ratio is known better than if they did not, and the interval says so; else trials
    count as independent.
    """
    mean, other = (float(np.nan_to_num(s[:, SQUARE].sum() / max(s[:, TRIALS].sum(), 1.0))) for s in (sums, baseline))
    if not (mean > 0.0 and other > 0.0 and math.isfinite(mean / other)):
        return None
    mine, theirs = influence(sums), influence(baseline)
    counts = [np.count_nonzero(s[:, TRIALS]) for s in (sums, baseline)]
    if min(counts) < 2:
        return Interval(mean / other)
    squares = [float(np.sum(part * part)) * n / (n - 1) for part, n in zip((mine, theirs), counts, strict=True)]
    error = math.sqrt(squares[0] + squares[1])
    if len(mine) == len(theirs) and min(squares) > 0.0:
        covariance = float(np.sum(mine * theirs)) * counts[0] / (counts[0] - 1)
        correlation = covariance / math.sqrt(squares[0] * squares[1])
        if correlation > student(counts[0] - 1) / math.sqrt(counts[0]):
            error = math.sqrt(max(squares[0] + squares[1] - 2.0 * covariance, 0.0))
    reach = min(student(min(counts) - 1) * error, 700.0)
    return Interval(mean / other, mean / other * math.exp(-reach), mean / other * math.exp(reach))


def _root(interval: Interval) -> Interval:
    values = (interval.estimate, interval.low, interval.high)
    return Interval(*(None if value is None else math.sqrt(value) for value in values))


def _variance_of_one(sums: Array) -> Interval:
    """The variance of the estimates of one pixel, and its interval from those of the squared deviations."""
    trials = sums[:, TRIALS]
    number = float(trials.sum())
    if number < 2.0:
        return Interval(None)
    mean = float(np.sum(sums[:, ERROR])) / number
    # Sums of (e - mean)^2 over the batches; what is left of rounding must not be negative.
    squares = np.maximum(sums[:, SQUARE] - 2.0 * mean * sums[:, ERROR] + trials * mean * mean, 0.0)
    return positive_interval(squares * (number / (number - 1.0)), trials, one_pixel=True)


def _variance_of_pairs(pairs: Array) -> Interval:
    """Half the mean squared difference of the images of a pair."""
    number = pairs[:, PAIRS]
    halves = np.where(number > 0, 0.5 * pairs[:, SQUARE] - pairs[:, PRODUCT], 0.0)
    return positive_interval(np.maximum(halves, 0.0), number, one_pixel=False)


def _pairs(sums: Array) -> Array:
    """The sums over batches of whole pairs of trials."""
    if not len(sums) or sums[:, TRIALS].max() > 1.0:
        # Batches are even: all of theirs are pairs. The last of an odd number, and those with a gap, are left out.
        whole = sums.copy()
        whole[whole[:, TRIALS] != 2.0 * whole[:, PAIRS]] = 0.0
        return whole
    even = sums[: len(sums) // 2 * 2].reshape(-1, 2, sums.shape[1])
    return np.asarray(even.sum(axis=1))
