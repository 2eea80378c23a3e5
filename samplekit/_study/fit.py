"""The law mse = constant x count^slope: a weighted regression in logarithms, and how far its slope is known.

A row's logarithm is off by what its trials scatter, and by what the law itself is off there, since no sampler follows
one exactly. The second is estimated from the scatter about the line (Paule and Mandel 1982, "Consensus values and
weighting factors", J. Res. NBS 87(5)); weights are those of both together. Rows of a progressive sampler share their
trials: their covariance is that of the trials.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._study.intervals import student
from samplekit._study.results import Interval

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """What a fit found: see :class:`samplekit._study.results.Fit`."""

    slope: Interval
    constant: float
    scatter: float


def fit_line(counts: Sequence[int], mses: Sequence[float], influences: Sequence[Array | None]) -> Line | None:
    """The line through the logarithms of rows; None where they are fewer than two.

    Parameters
    ----------
    counts, mses
        Of the rows; all above 0.
    influences
        Of each row's batches on its mse, relative, float64[B]; None where it has no variance.
        Rows of the same number of batches may share trials.
    """
    rows = len(counts)
    if rows < 2:
        return None
    x, y = np.log(np.asarray(counts, np.float64)), np.log(np.asarray(mses, np.float64))
    covariance = _covariance(influences)
    known = np.diag(covariance).copy()
    scatter = _scatter(x, y, known) if rows > 2 else 0.0
    weights = _weights(known, scatter)
    coefficients, intercept = _slope(x, weights)
    slope = float(coefficients @ y)
    constant = math.exp(float(intercept @ y))
    by_trials = float(coefficients @ covariance @ coefficients)
    by_scatter = scatter * float(coefficients @ coefficients)
    total = by_trials + by_scatter
    if total <= 0.0:
        return Line(Interval(slope), constant, math.sqrt(scatter))
    batches = min((len(part) for part in influences if part is not None), default=2)
    # Welch and Satterthwaite: degrees of freedom of a sum of two estimated variances.
    dof = total**2 / (by_trials**2 / max(batches - 1, 1) + by_scatter**2 / max(rows - 2, 1))
    reach = student(dof) * math.sqrt(total)
    return Line(Interval(slope, slope - reach, slope + reach), constant, math.sqrt(scatter))


def _covariance(influences: Sequence[Array | None]) -> Array:
    """Of the rows' logarithms."""
    rows = len(influences)
    covariance = np.zeros((rows, rows))
    for i, mine in enumerate(influences):
        for j, theirs in enumerate(influences):
            if mine is not None and theirs is not None and len(mine) == len(theirs) and len(mine) > 1:
                covariance[i, j] = float(np.sum(mine * theirs)) * len(mine) / (len(mine) - 1)
    return covariance


def _weights(known: Array, scatter: float) -> Array:
    variances = known + scatter
    if variances.max() <= 0.0:
        return np.ones_like(variances)
    # A row without a variance (a sampler that is not random) weighs no more than the best known of the others.
    least = variances[variances > 0.0].min()
    weights: Array = 1.0 / np.maximum(variances, least)
    return weights


def _slope(x: Array, weights: Array) -> tuple[Array, Array]:
    """What slope and intercept are in terms of y: linear, with these coefficients."""
    share = weights / weights.sum()
    middle = float(share @ x)
    slope = share * (x - middle) / float(share @ (x - middle) ** 2)
    return slope, share - middle * slope


def _scatter(x: Array, y: Array, known: Array) -> float:
    """The variance about the line beyond ``known`` that makes the weighted residuals what they should be."""

    def excess(scatter: float) -> float:
        weights = _weights(known, scatter)
        slope, intercept = _slope(x, weights)
        residuals = y - float(intercept @ y) - float(slope @ y) * x
        return float(weights @ residuals**2) - (x.size - 2)

    slope, intercept = _slope(x, np.ones_like(x))
    largest = float(np.sum((y - float(intercept @ y) - float(slope @ y) * x) ** 2))
    if largest <= 1e-24 or (known.max() > 0.0 and excess(0.0) <= 0.0):
        return 0.0
    low, high = 0.0, 4.0 * largest
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > 0.0 else (low, middle)
    return high
