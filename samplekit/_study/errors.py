"""The errors of a combination and their intervals, from the sums of its trials."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from samplekit._integrate.hits import describe_hits, effective_hits
from samplekit._study.intervals import (
    LEAST_TRIALS,
    derived_interval,
    far_student,
    mean_and_error,
    mean_interval,
    positive_interval,
    raised_variance,
    student,
)
from samplekit._study.results import LEVEL, Interval
from samplekit._study.trials import BLURRED, ERROR, INVALID, PAIRS, PRODUCT, SQUARE, TRIALS, Array

_ENOUGH_HITS = 16.0
"""Effective number of trials that must differ before errors have an interval; or a fifth of them, if that is less.

With fewer, rare errors of another size are likely to be missing."""
_LEAST_PAIRS = 4
"""Smallest number of pairs of images from which the squared bias has an interval."""
FEW_TRIALS, INFINITE_VARIANCE, HEAVY_TAILS = "few trials", "infinite variance", "heavy tails"


def errors_of(
    sums: Array,
    *,
    one_pixel: bool,
    sampled: int = LEAST_TRIALS,
    random: bool = True,
    unbiased: bool = True,
    finite_variance: bool = True,
    finite_kurtosis: bool = True,
    floor: float = 0.0,
    largest: float | None = None,
) -> dict[str, Any]:
    """Return the errors of a combination by the names that they have in :class:`samplekit._study.results.Row`.

    An interval says something about the next trials only if these trials found what makes up the error. They did not

    - if all of them gave one value, and it is not the mean of the scene: no hits;
    - if few of them differ from the others (:func:`samplekit._integrate.hits.describe_hits`): few hits;
    - if the mean of an unbiased sampler is too many standard errors from the known mean of the scene: few hits.

    Parameters
    ----------
    sums
        float64[B, COLUMNS]: its batches in the order of their trials.
    one_pixel
        Whether the trials are estimates of the unit square; otherwise they are images.
    sampled
        Number of pixels of an image that are not constant. If it is 1, its errors scatter as those of one pixel.
    random, unbiased
        Whether the sampler is random, and whether its mean over realisations is the integral.
    finite_variance, finite_kurtosis
        Whether the squares, and the fourth powers, of the values of the scene have a finite mean.
    floor
        Largest error that rounding and the reference may cause in a pixel.
    largest
        Largest error that an estimate of a pixel can have; None: not known.
    """
    trials = sums[:, TRIALS]
    number = int(trials.sum())
    pairs = _whole_pairs(sums)
    single = one_pixel or sampled == 1
    missed = _missed(sums) if unbiased else 1.0
    mse = positive_interval(sums[:, SQUARE], trials, one_pixel=single, missed=missed)
    bias = mean_interval(sums[:, ERROR], trials)
    variance = _variance_of_pixel(sums) if one_pixel else _variance_from_pairs(pairs)
    if unbiased and variance.estimate is not None and mse.low is not None and mse.high is not None:
        # The variance of an unbiased estimate is its mean squared error, whose interval uses the known mean.
        variance = Interval(variance.estimate, min(mse.low, variance.estimate), max(mse.high, variance.estimate))
    by_pairs = mean_interval(pairs[:, PRODUCT], pairs[:, PAIRS])
    if np.count_nonzero(pairs[:, PAIRS]) < _LEAST_PAIRS:
        by_pairs = Interval(by_pairs.estimate)
    found: dict[str, Any] = {
        "mse": mse,
        "bias": bias,
        "variance": variance,
        "squared_bias": _squared_bias(mse, variance, bias) if one_pixel else _difference(mse, variance, by_pairs),
        "blurred_mse": None
        if one_pixel
        else positive_interval(sums[:, BLURRED], trials, one_pixel=single, missed=missed),
    }
    no_interval = ""
    if not random:
        found |= {"variance": Interval(0.0), "squared_bias": mse}
        found = {name: each and Interval(each.estimate, each.estimate, each.estimate) for name, each in found.items()}
    elif number:
        no_interval = INFINITE_VARIANCE if not finite_variance else "" if finite_kurtosis else HEAVY_TAILS
        no_interval = no_interval or _judge_hits(sums, one_pixel=single, unbiased=unbiased, floor=floor)
        estimates = number if one_pixel else number * sampled
        if not no_interval and (number < 2 or 0 < estimates < LEAST_TRIALS):
            no_interval = FEW_TRIALS
        if no_interval:
            found = {name: each and Interval(each.estimate) for name, each in found.items()}
        if no_interval == "no hits":
            found = {name: each and Interval(None) for name, each in found.items()}
            found["mse"] = Interval(None, None, _bound_from_no_events(mse, number, largest))
        elif mse.estimate is not None and math.sqrt(mse.estimate) <= floor:
            # No trial differs by more than rounding and the reference's own error. The next may be of another kind.
            found["mse"] = Interval(mse.estimate, 0.0, _bound_from_no_events(mse, number, largest))
    return {
        "trials": number,
        "no_interval": no_interval,
        **found,
        "rmse": _square_root(found["mse"]),
        "invalid_pixels": int(sums[:, INVALID].sum()),
    }


def _judge_hits(sums: Array, *, one_pixel: bool, unbiased: bool, floor: float) -> str:
    """Return ``no hits``, ``few hits`` or nothing: whether the trials found what makes up the error."""
    own = sums[sums[:, TRIALS] > 0.0]
    if len(own) < 2:
        return ""
    values = own[:, ERROR if one_pixel else SQUARE] / own[:, TRIALS]
    largest = float(np.abs(values).max())
    rounding = floor if one_pixel else 2.0 * floor * math.sqrt(largest)
    hits = describe_hits(effective_hits(values, rounding), min(_ENOUGH_HITS, 0.2 * len(own)))
    if hits == "no hits":
        return hits if largest > (floor if one_pixel else floor * floor) else ""
    if hits:
        return hits
    mean, error = mean_and_error(own[:, ERROR], own[:, TRIALS])
    # Two images can have equal means by chance: a standard error of 0 tells nothing.
    far = unbiased and mean is not None and error and abs(mean) > floor + far_student(len(own) - 1) * error
    return "few hits" if far else ""


def _bound_from_no_events(seen: Interval, trials: int, largest: float | None) -> float | None:
    """Return a one-sided 95 % bound of the mean square if all trials gave the same: the next may be of another kind.

    If a share q of all trials differ, none of T does with probability (1 - q)^T, which is 5 % for the q used here.
    """
    if largest is None or seen.estimate is None:
        return None
    share = 1.0 - float((1.0 - LEVEL) ** (1.0 / trials))
    return (1.0 - share) * seen.estimate + share * largest * largest


def _missed(sums: Array) -> float:
    """Return by how much the mean square rises, as a factor, if the mean error is set to 0, which it is known to be."""
    trials = sums[:, TRIALS]
    total = float(trials.sum())
    square = float(sums[:, SQUARE].sum())
    if not total or not 0.0 < square < math.inf:
        return 1.0
    error = float(sums[:, ERROR].sum()) / total
    deviations = sums[:, ERROR] - trials * error
    spread = float(deviations @ deviations)
    slope = float(deviations @ (sums[:, SQUARE] - trials * (square / total))) / spread if spread > 0.0 else 0.0
    return max(1.0, 1.0 - slope * error * total / square)


def _squared_bias(mse: Interval, variance: Interval, bias: Interval) -> Interval:
    """Return mse - variance of one pixel; the ends are the least and the largest square of the interval of the bias."""
    if mse.estimate is None or variance.estimate is None:
        return Interval(None)
    difference = mse.estimate - variance.estimate
    if bias.low is None or bias.high is None:
        return Interval(difference)
    squares = bias.low * bias.low, bias.high * bias.high
    return Interval(difference, min(difference, 0.0 if bias.low <= 0.0 <= bias.high else min(squares)), max(squares))


def _difference(mse: Interval, variance: Interval, by_pairs: Interval) -> Interval:
    """Return mse - variance, with the width of the interval of the products of pairs, which have the same mean."""
    if mse.estimate is None or variance.estimate is None:
        return Interval(None)
    difference = mse.estimate - variance.estimate
    if by_pairs.estimate is None or by_pairs.low is None or by_pairs.high is None:
        return Interval(difference)
    half = by_pairs.high - by_pairs.estimate
    return Interval(difference, difference - half, difference + half)


def influence(sums: Array, *, one_pixel: bool) -> Array:
    """Return what each batch float64[B] adds to the relative deviation of the mean square; the total is 0.

    For one pixel the deviations are raised as in :func:`samplekit._study.intervals.positive_interval`: few trials tend
    to miss the large ones.
    """
    squares, trials = sums[:, SQUARE], sums[:, TRIALS]
    number = float(trials.sum())
    mean = float(np.sum(squares)) / number
    deviations: Array = (squares - trials * mean) / (mean * number)
    batches = int(np.count_nonzero(trials))
    observed = float(deviations @ deviations) * batches * batches / max(batches - 1, 1)
    if one_pixel and observed > 0.0:
        deviations *= math.sqrt(raised_variance(observed, batches, number / batches) / observed)
    return deviations


def ratio_of(sums: Array, baseline: Array, mse: Interval, other: Interval, *, one_pixel: bool) -> Interval | None:
    """Return the mean square relative to that of another sampler whose trials have the same seeds.

    The interval is narrower where the trials of both samplers are correlated; otherwise they count as independent.

    Parameters
    ----------
    sums, baseline
        float64[B, COLUMNS]: the batches of the sampler and of the other one.
    mse, other
        Their mean squares, with the intervals of :func:`errors_of`.
    one_pixel
        Whether the trials are estimates of one pixel; otherwise they are images.

    Returns
    -------
    None if one of the mean squares is 0, not finite or unknown.
    """
    if not (mse.estimate and other.estimate and math.isfinite(mse.estimate / other.estimate)):
        return None
    ratio = mse.estimate / other.estimate
    if not (mse.low and mse.high and other.low and other.high):
        return Interval(ratio)
    apart = derived_interval(lambda one, another: one / another, [mse, other])
    width = _width_of_correlated(sums, baseline, one_pixel=one_pixel)
    ends = (ratio * ((end or 0.0) / ratio) ** width for end in (apart.low, apart.high))
    return Interval(ratio, *ends)


def _width_of_correlated(sums: Array, baseline: Array, *, one_pixel: bool) -> float:
    """Return by which factor correlation narrows the interval of a ratio of mean squares; 1 if there is none."""
    mine, theirs = (influence(each, one_pixel=one_pixel) for each in (sums, baseline))
    squares = float(mine @ mine), float(theirs @ theirs)
    if len(mine) != len(theirs) or len(mine) < 2 or min(squares) <= 0.0:
        return 1.0
    covariance = float(mine @ theirs)
    if covariance <= math.sqrt(squares[0] * squares[1] / len(mine)) * student(len(mine) - 1):
        return 1.0
    return math.sqrt(max(1.0 - 2.0 * covariance / sum(squares), 0.0))


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
