"""The variance of an estimate, measured: many independent estimates, and how far their variance can be trusted."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit import SamplekitError, estimate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import ConfiguredSampler, ConfiguredScene

Progress = Callable[[int, int], None]

TRIALS = 40_000
PRECISION = 0.008
"""Relative standard error of a variance of 40000 normal estimates, and a little more."""
_MOST = 32
ZERO = 1e-13
"""Relative to the root mean square of the integrand, deviations that rounding explains."""


@dataclass(frozen=True)
class Measurement:
    """Variance of the estimates with its standard error; their mean's difference from the integral, and mean square."""

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
    shifts: int = 1,
    threads: int | None = None,
    progress: Progress = lambda _, __: None,
) -> Measurement:
    """Estimate the integral ``trials`` times with ``count`` samples each; ``exact`` is the integral.

    ``trials`` None: 40000, and more where estimates have heavy tails, so that the variance is known within 0.8 %.
    ``shifts``: so many trials in a row are of one set, taken whole; a divisor of ``trials``.
    """
    wanted = TRIALS if trials is None else trials
    estimates = _estimates(scene, sampler, count, range(wanted), seed, threads, progress)
    found = summarize(estimates, exact, shifts)
    most = wanted if trials is not None else _MOST * wanted
    while found.standard_error > PRECISION * found.variance > 0.0 and estimates.size < most:
        aim = 1.1 * estimates.size * (found.standard_error / (PRECISION * found.variance)) ** 2
        more = shifts * math.ceil(min(aim, most) / shifts)
        rest = _estimates(scene, sampler, count, range(estimates.size, more), seed, threads, progress)
        estimates = np.concatenate([estimates, rest])
        found = summarize(estimates, exact, shifts)
    return found


def _estimates(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    numbers: range,
    seed: int,
    threads: int | None,
    progress: Progress,
) -> NDArray[np.float64]:
    estimates = estimate(
        scene,
        sampler,
        count,
        realizations=len(numbers),
        first=numbers.start,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    if not np.isfinite(estimates).all():
        raise SamplekitError(f"{scene.text} with {sampler.text} gave estimates that are not finite")
    return estimates


def summarize(estimates: NDArray[np.float64], exact: float, shifts: int = 1) -> Measurement:
    """Variance and its standard error, which holds for any distribution: that of a mean of squared deviations.

    Where ``shifts`` estimates in a row are of one set, they depend on each other, and its mean counts once.
    """
    trials = estimates.size
    mean = float(estimates.mean())
    squares = (estimates - mean) ** 2
    variance = float(squares.sum() / (trials - 1)) if trials > 1 else math.nan
    of_sets = squares.reshape(-1, shifts).mean(axis=1)
    error = float(of_sets.std(ddof=1)) / math.sqrt(of_sets.size) if of_sets.size > 1 else math.nan
    return Measurement(trials, variance, error, mean - exact, float(((estimates - exact) ** 2).mean()))
