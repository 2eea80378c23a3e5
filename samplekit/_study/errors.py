"""The errors of a combination and their intervals, from the sums of its trials."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from samplekit._study.intervals import mean_interval, positive_interval, student
from samplekit._study.results import Interval
from samplekit._study.trials import BLURRED, ERROR, INVALID, PAIRS, PRODUCT, SQUARE, TRIALS, Array


def errors_of(sums: Array, *, one_pixel: bool) -> dict[str, Any]:
    """Return the errors of a combination by the names that they have in :class:`samplekit._study.results.Row`.

    Parameters
    ----------
    sums
        float64[B, COLUMNS]: its batches in the order of their trials.
    one_pixel
        Whether the trials are estimates of the unit square; otherwise they are images.
    """
    trials = sums[:, TRIALS]
    mse = positive_interval(sums[:, SQUARE], trials, one_pixel=one_pixel)
    pairs = _whole_pairs(sums)
    return {
        "trials": int(trials.sum()),
        "mse": mse,
        "rmse": _square_root(mse),
        "bias": mean_interval(sums[:, ERROR], trials),
        "variance": _variance_of_pixel(sums) if one_pixel else _variance_from_pairs(pairs),
        "squared_bias": mean_interval(pairs[:, PRODUCT], pairs[:, PAIRS]),
        "blurred_mse": None if one_pixel else positive_interval(sums[:, BLURRED], trials, one_pixel=False),
        "invalid_pixels": int(sums[:, INVALID].sum()),
    }


def influence(sums: Array) -> Array:
    """Return what each batch float64[B] adds to the relative deviation of the mean square; the total is 0."""
    squares, trials = sums[:, SQUARE], sums[:, TRIALS]
    mean = float(np.sum(squares)) / trials.sum()
    deviations: Array = (squares - trials * mean) / (mean * trials.sum())
    return deviations


def ratio_of(sums: Array, baseline: Array) -> Interval | None:
    """Return the mean square relative to that of another sampler whose trials have the same seeds.

    The interval is narrower where the trials of both samplers are correlated; otherwise they count as independent.

    Parameters
    ----------
    sums, baseline
        float64[B, COLUMNS]: the batches of the sampler and of the other one.

    Returns
    -------
    None if one of the mean squares is 0 or not finite.
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


def _square_root(interval: Interval) -> Interval:
    values = (interval.estimate, interval.low, interval.high)
    return Interval(*(None if value is None else math.sqrt(value) for value in values))


def _variance_of_pixel(sums: Array) -> Interval:
    """Return the variance of the estimates of one pixel, with its interval from their squared deviations."""
    trials = sums[:, TRIALS]
    number = float(trials.sum())
    if number < 2.0:
        return Interval(None)
    mean = float(np.sum(sums[:, ERROR])) / number
    # Sums of (e - mean)^2 over the batches. Rounding must not make them negative.
    squares = np.maximum(sums[:, SQUARE] - 2.0 * mean * sums[:, ERROR] + trials * mean * mean, 0.0)
    return positive_interval(squares * (number / (number - 1.0)), trials, one_pixel=True)


def _variance_from_pairs(pairs: Array) -> Interval:
    """Return the variance of images: half the mean squared difference of the two images of a pair."""
    number = pairs[:, PAIRS]
    halves = np.where(number > 0, 0.5 * pairs[:, SQUARE] - pairs[:, PRODUCT], 0.0)
    return positive_interval(np.maximum(halves, 0.0), number, one_pixel=False)


def _whole_pairs(sums: Array) -> Array:
    """Return the sums over batches that consist of whole pairs of trials."""
    if not len(sums) or sums[:, TRIALS].max() > 1.0:
        # Batches are even, so all of their trials are in pairs. Those of an odd number or with a gap are left out.
        whole = sums.copy()
        whole[whole[:, TRIALS] != 2.0 * whole[:, PAIRS]] = 0.0
        return whole
    even = sums[: len(sums) // 2 * 2].reshape(-1, 2, sums.shape[1])
    return np.asarray(even.sum(axis=1))
