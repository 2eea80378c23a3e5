"""Measure the variance of an estimate: from many independent estimates, with the standard error of their variance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit import SamplekitError, estimate

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit import ConfiguredSampler, ConfiguredScene

TRIALS = 40_000
PRECISION = 0.008
"""Relative standard error at which a variance is known well enough: 40000 normal estimates give 0.7 %."""
_MOST = 32
"""Most estimates, as a multiple of ``TRIALS``."""
ZERO = 1e-13
"""Deviations up to this size, relative to the root mean square of the integrand, are caused by rounding."""


@dataclass(frozen=True)
class Measurement:
    """A measured variance.

    Attributes
    ----------
    trials
        Number of estimates.
    variance, standard_error
        The variance of the estimates, and its standard error.
    bias, mse
        The mean and the mean square of the estimates' differences from the integral.
    """

    trials: int
    variance: float
    standard_error: float
    bias: float
    mse: float


def measure(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    exact: float,
    *,
    trials: int | None,
    seed: int,
    shifts: int,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> Measurement:
    """Estimate the integral ``trials`` times with ``count`` samples each.

    Parameters
    ----------
    scene, sampler, count, seed, threads, progress
        Those of :func:`samplekit.estimate`.
    exact
        The integral.
    trials
        None: 40000, and more if estimates have heavy tails, for a relative standard error of the variance of 0.8 %.
    shifts
        Number of successive trials that use the same set, a divisor of ``trials``.

    Raises
    ------
    SamplekitError
        An estimate is not finite.
    """

    def estimates_of(first: int, stop: int) -> NDArray[np.float64]:
        estimates = estimate(
            scene, sampler, count, realizations=stop - first, first=first, seed=seed, threads=threads, progress=progress
        )
        if not np.isfinite(estimates).all():
            raise SamplekitError(f"{scene.text} with {sampler.text} gave estimates that are not finite")
        return estimates

    wanted = TRIALS if trials is None else trials
    most = _MOST * wanted if trials is None else wanted
    estimates = estimates_of(0, wanted)
    while True:
        found = summarize(estimates, exact, shifts)
        if not found.standard_error > PRECISION * found.variance > 0.0 or estimates.size >= most:
            return found
        aim = 1.1 * estimates.size * (found.standard_error / (PRECISION * found.variance)) ** 2
        more = shifts * math.ceil(min(aim, most) / shifts)
        estimates = np.concatenate([estimates, estimates_of(estimates.size, more)])


def summarize(estimates: NDArray[np.float64], exact: float, shifts: int = 1) -> Measurement:
    """Return the variance and its standard error, which is that of a mean of squared deviations.

    The standard error holds for any distribution of the estimates. If ``shifts`` successive estimates use one set, they
    depend on each other, so the mean of their squared deviations counts as one value.
    """
    trials = estimates.size
    mean = float(estimates.mean())
    squares = (estimates - mean) ** 2
    variance = float(squares.sum() / (trials - 1))
    set_means = squares.reshape(-1, shifts).mean(axis=1)
    error = float(set_means.std(ddof=1)) / math.sqrt(set_means.size)
    return Measurement(trials, variance, error, mean - exact, float(((estimates - exact) ** 2).mean()))
