"""The law mse = constant x count^slope, fitted to the rows of a sampler by weighted regression in logarithms.

The logarithm of a row deviates from the line for two reasons: its trials scatter, and no sampler follows a power law
exactly. The second deviation is estimated from the scatter about the line (Paule and Mandel 1982, "Consensus values and
weighting factors", J. Res. NBS 87(5)); weights use the variances of both together. The rows of a progressive sampler
share their trials, and the covariance of the rows is that of these trials.

Theory has exponents for some samplers in two dimensions, in the worst case (the indicator of a disk) and in the best
case (a Gaussian): Pilleboue, Singh, Coeurjolly, Kazhdan, Ostromoukhov 2015, "Variance analysis for Monte Carlo
integration", ACM TOG 34(4).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._study.intervals import student
from samplekit._study.results import Interval

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.trials import Array


_LARGEST = 709.0
"""Largest number whose exponential is a float."""
_CASES = {"disk": "worst", "gaussian": "best"}
_EXPONENTS: dict[str, dict[str, float]] = {
    "random": {"worst": -1.0, "best": -1.0},
    "jittered": {"worst": -1.5, "best": -2.0},
    "poisson-disk": {"worst": -1.0, "best": -1.0},
    "ccvt": {"worst": -1.5, "best": -3.0},
}


def theoretical_exponent(scene: str, sampler: str) -> tuple[str | None, float | None]:
    """Return the case that a scene is, and the exponent of a sampler in it; None where theory has none.

    Parameters
    ----------
    scene, sampler
        Texts as on the command line.
    """
    case = _CASES.get(scene.partition(":")[0].rpartition("/")[2])
    name = sampler.partition("+")[0].partition(":")[0].rpartition("/")[2]
    return case, _EXPONENTS.get(name, {}).get(case) if case else None


def fit_line(
    counts: Sequence[int], mses: Sequence[float], influences: Sequence[Array | None]
) -> tuple[Interval, float | None, float] | None:
    """Fit a line to the logarithms of rows.

    Parameters
    ----------
    counts, mses
        The count and the mean squared error of each row; all above 0.
    influences
        For each row the relative influence float64[B] of its batches on its mean squared error, None if it has no
        variance. Rows with the same number of batches may share trials.

    Returns
    -------
    Slope, constant and scatter, as in :class:`samplekit._study.results.Fit`; None if there are fewer than two rows.
    """
    rows = len(counts)
    if rows < 2:
        return None
    x, y = np.log(np.asarray(counts, np.float64)), np.log(np.asarray(mses, np.float64))
    covariance = _covariance(influences)
    known = np.diag(covariance).copy()
    scatter = _find_scatter(x, y, known) if rows > 2 else 0.0
    weights = _weigh(known, scatter)
    coefficients, intercept = _line_coefficients(x, weights)
    slope = float(coefficients @ y)
    # A steep line through large counts leaves the range of floats before one sample.
    logarithm = float(intercept @ y)
    constant = math.exp(logarithm) if logarithm < _LARGEST else None
    by_trials = float(coefficients @ covariance @ coefficients)
    by_scatter = scatter * float(coefficients @ coefficients)
    total = by_trials + by_scatter
    if total <= 0.0:
        return Interval(slope), constant, math.sqrt(scatter)
    batches = min((len(part) for part in influences if part is not None), default=2)
    # Welch and Satterthwaite: degrees of freedom of a sum of two estimated variances.
    dof = total**2 / (by_trials**2 / max(batches - 1, 1) + by_scatter**2 / max(rows - 2, 1))
    reach = student(dof) * math.sqrt(total)
    return Interval(slope, slope - reach, slope + reach), constant, math.sqrt(scatter)


def _covariance(influences: Sequence[Array | None]) -> Array:
    """Return the covariance of the rows' logarithms, from their trials."""
    rows = len(influences)
    covariance = np.zeros((rows, rows))
    for i, mine in enumerate(influences):
        for j, theirs in enumerate(influences):
            if mine is not None and theirs is not None and len(mine) == len(theirs) and len(mine) > 1:
                covariance[i, j] = float(np.sum(mine * theirs)) * len(mine) / (len(mine) - 1)
    return covariance


def _weigh(known: Array, scatter: float) -> Array:
    variances = known + scatter
    if variances.max() <= 0.0:
        return np.ones_like(variances)
    # A row without a variance (its sampler is not random) weighs as much as the best known of the others.
    least = variances[variances > 0.0].min()
    weights: Array = 1.0 / np.maximum(variances, least)
    return weights


def _line_coefficients(x: Array, weights: Array) -> tuple[Array, Array]:
    """Return the coefficients float64[n] with which slope and intercept depend on y."""
    share = weights / weights.sum()
    middle = float(share @ x)
    slope = share * (x - middle) / float(share @ (x - middle) ** 2)
    return slope, share - middle * slope


def _find_scatter(x: Array, y: Array, known: Array) -> float:
    """Return the variance about the line, beyond ``known``, that gives the weighted residuals their expected size."""

    def squared_residuals(weights: Array) -> Array:
        slope, intercept = _line_coefficients(x, weights)
        return (y - float(intercept @ y) - float(slope @ y) * x) ** 2

    def excess(scatter: float) -> float:
        weights = _weigh(known, scatter)
        return float(weights @ squared_residuals(weights)) - (x.size - 2)

    largest = float(np.sum(squared_residuals(np.ones_like(x))))
    if largest <= 1e-24 or (known.max() > 0.0 and excess(0.0) <= 0.0):
        return 0.0
    low, high = 0.0, 4.0 * largest
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > 0.0 else (low, middle)
    return high
