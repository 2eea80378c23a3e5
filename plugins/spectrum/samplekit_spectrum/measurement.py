"""The variance of an estimate, measured: many independent estimates, and how far their variance can be trusted."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit.errors import SamplekitError
from samplekit.integration.estimator import UNIT_SQUARE, Estimator, Seconds
from samplekit.sampling.realizations import Realizations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.integration.configured import ConfiguredScene
    from samplekit.sampling.configured import ConfiguredSampler

Progress = Callable[[int, int], None]

_BLOCK = 256
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
    trials: int,
    seed: int,
    threads: int | None = None,
    progress: Progress = lambda _, __: None,
) -> Measurement:
    """Estimate the integral ``trials`` times with ``count`` samples each; ``exact`` is the integral."""
    sampler.check(count, scene.dims)
    sampler.prepare(count, scene.dims)
    estimates = np.empty(trials)
    starts = range(0, trials, _BLOCK)

    def block(start: int) -> int:
        stop = min(start + _BLOCK, trials)
        boxes = np.repeat(np.array(UNIT_SQUARE)[:, None], stop - start, axis=1)
        estimator = Estimator(scene, sampler, count)
        estimates[start:stop] = estimator.means(Realizations.of_trials(start, stop, seed), boxes, Seconds())
        return stop - start

    done = 0
    with ThreadPoolExecutor(min(threads or os.cpu_count() or 1, len(starts))) as pool:
        try:
            for finished in pool.map(block, starts):
                done += finished
                progress(done, trials)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    if not np.isfinite(estimates).all():
        raise SamplekitError(f"{scene.text} with {sampler.text} gave estimates that are not finite")
    return summarize(estimates, exact)


def summarize(estimates: NDArray[np.float64], exact: float) -> Measurement:
    """Variance and its standard error from the fourth moment, which holds for any distribution (Cramer 1946, 27.4)."""
    trials = estimates.size
    mean = float(estimates.mean())
    deviations = estimates - mean
    variance = float((deviations**2).sum() / (trials - 1)) if trials > 1 else float("nan")
    fourth = float((deviations**4).mean())
    error = math.sqrt(max(fourth - variance**2 * (trials - 3) / (trials - 1), 0.0) / trials) if trials > 3 else math.nan
    return Measurement(trials, variance, error, mean - exact, float(((estimates - exact) ** 2).mean()))
