"""Compare the variance that spectra predict with the measured one.

The prediction is exact for homogenised samplers only: without the shift, the amplitudes at different frequencies depend
on each other, and replacing E|S|^2 by the variance of S does not correct for that. So the homogenised sampler is
measured.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import samplekit
from samplekit import ConfiguredSampler, ConfiguredScene, check_seed
from samplekit_spectrum.homogenized import homogenized, is_homogeneous
from samplekit_spectrum.integrands import integrand_of
from samplekit_spectrum.measurement import TRIALS, ZERO, Measurement, measure
from samplekit_spectrum.point_sets import Source
from samplekit_spectrum.request import check_integer
from samplekit_spectrum.variance import Predicted, predicted_variance

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit_spectrum.integrands.integrand import Integrand

LEVEL = 0.99
"""Confidence level of the interval of the ratio."""
FEWEST = 16
"""Smallest number of independent sets, in the measured and in the expected variance, from which there is an interval.

The spread of fewer is a guess."""
COARSEST = 0.25
"""Largest relative standard error with which there is an interval: that of a variance to which 16 rare sets contribute.

If fewer do, sets of another kind are likely to be missing."""
_SHIFTS = 64
"""Largest number of shifts of a set in a measurement, if sets take long to make."""


@dataclass(frozen=True)
class Comparison:
    """The predicted and the measured variance for one number of samples.

    Attributes
    ----------
    count
        The number of samples.
    predicted, measured
        The variance of the homogenised sampler.
    native
        The measured variance without the shift; None if the shift changes nothing, or if it was not requested.
    ratio, ratio_low, ratio_high
        Measured over predicted variance, with its interval of 99 %; NaN if both are zero. The ends are NaN if there are
        too few trials or realisations.
    verdict
        ``"agrees"``, ``"agrees within the tail's bound"``, ``"differs"``, ``"exact"`` if both are zero, ``"too few
        trials"``, or ``"too few realizations"``: an interval needs 16 independent sets for each of both variances,
        and standard errors of at most a quarter of them.
    """

    count: int
    predicted: Predicted
    measured: Measurement
    native: Measurement | None
    ratio: float
    ratio_low: float
    ratio_high: float
    verdict: str


def predict(
    sampler: str | ConfiguredSampler,
    scene: str | ConfiguredScene,
    count: int,
    *,
    trials: int | None = None,
    realizations: int | None = None,
    max_frequency: int | None = None,
    native: bool = True,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[str, int, int], None] = lambda _, __, ___: None,
) -> Comparison:
    """Predict the variance of a homogenised sampler's estimate of a scene over the unit square, and measure it.

    Parameters
    ----------
    sampler, scene
        As on the command line, or what :func:`samplekit.sampler` and :func:`samplekit.scene` returned.
    count
        Number of samples of each estimate.
    trials
        Number of estimates in the measured variance; None: enough for a standard error of 0.8 %.
    realizations
        Number of sets in the expected spectrum; None: enough for a standard error of 0.45 %.
    max_frequency
        Largest frequency of the square; None: 16 sqrt N, at least 128 and at most 512; or 1024 for sets that all have
        the same power.
    native
        Whether to measure the sampler without the shift as well.
    seed
        From 0 to 2^64 - 1.
    threads
        Number of threads; None: one for each processor.
    progress
        Called with the name of the present step, and the numbers done and to do.

    Returns
    -------
    Comparison
        Both variances, their ratio with its interval, and the verdict.

    Raises
    ------
    UsageError
        The request cannot be carried out, such as for a scene with a lens.
    SamplekitError
        A plugin failed.

    Examples
    --------
    >>> from samplekit_spectrum import predict
    >>> predict("jittered", "disk", 16, trials=4000).verdict
    'agrees'
    """
    chosen = samplekit.sampler(sampler).fresh()
    integrand_scene = samplekit.scene(scene)
    integrand = integrand_of(integrand_scene)
    chosen.check(count, integrand_scene.dims)
    check_settings(trials, realizations, max_frequency, seed)
    predicted = predicted_variance(
        Source(chosen, int(count), 2, int(seed)), integrand, realizations=realizations, max_frequency=max_frequency,
        threads=threads, progress=partial(progress, "spectra"),
    )  # fmt: skip
    # A set that takes long to make is used under many shifts; without the shift, fewer trials have the same sets.
    shifts = _shifts(trials or TRIALS) if chosen.spec.fresh_options else 1

    def measured(source: ConfiguredSampler, what: str, trials: int | None, shifts: int) -> Measurement:
        return measure(
            integrand_scene, source, int(count), integrand.mean,
            trials=trials, shifts=shifts, seed=seed, threads=threads,
            progress=partial(progress, what),
        )  # fmt: skip

    shifted = measured(homogenized(chosen, shifts), "measuring", trials, shifts)
    plain = None
    if native and not is_homogeneous(chosen):
        fewer = trials if shifts == 1 else shifted.trials // shifts
        plain = measured(chosen, "measuring without the shift", fewer, 1)
    return _compared(int(count), integrand, predicted, shifted, plain, sets=shifted.trials // shifts)


def check_settings(trials: int | None, realizations: int | None, max_frequency: int | None, seed: int) -> None:
    """Check settings of :func:`predict`.

    Raises
    ------
    UsageError
        One is not an integer of its range.
    """
    check_seed(seed)
    if trials is not None:
        check_integer(trials, "trials", 2**31, least=4)
    if realizations is not None:
        check_integer(realizations, "realizations", 2**31)
    if max_frequency is not None:
        check_integer(max_frequency, "max-frequency", 2**13)


def _shifts(trials: int) -> int:
    """Return a divisor of the number of trials that leaves at least as many sets as there are shifts of each."""
    return max(shifts for shifts in range(1, _SHIFTS + 1) if trials % shifts == 0 and shifts**2 <= trials)


def _compared(
    count: int,
    integrand: Integrand,
    predicted: Predicted,
    measured: Measurement,
    native: Measurement | None,
    *,
    sets: int,
) -> Comparison:
    """Compare both variances; ``sets`` is the number of independent sets in the measured one."""
    zero = integrand.energy * ZERO**2
    ratio = measured.variance / predicted.variance if predicted.variance > 0.0 else math.inf
    least = predicted.variance - predicted.tail
    most = least + predicted.tail_bound
    low = high = math.nan
    if predicted.variance <= 1.001 * zero and measured.variance <= 100.0 * zero:
        ratio, verdict = math.nan, "exact"
    elif sets < FEWEST or measured.variance <= zero or measured.standard_error > COARSEST * measured.variance:
        verdict = "too few trials"
    elif predicted.standard_error != 0.0 and (
        predicted.realizations < FEWEST or predicted.standard_error > COARSEST * predicted.variance
    ):
        verdict = "too few realizations"
    else:
        reach = _reach(predicted, measured, sets) if min(predicted.variance, measured.variance) > zero else 0.0
        low, high = ratio * math.exp(-reach), ratio * math.exp(reach)
        if low <= 1.0 <= high:
            verdict = "agrees"
        elif low * predicted.variance <= most and high * predicted.variance >= least:
            verdict = "agrees within the tail's bound"
        else:
            verdict = "differs"
    return Comparison(count, predicted, measured, native, ratio, low, high, verdict)


def _reach(predicted: Predicted, measured: Measurement, sets: int) -> float:
    """Return half the width of the interval of the ratio's logarithm, by Welch's t."""
    from scipy.special import stdtrit

    parts = [
        ((measured.standard_error / measured.variance) ** 2, sets - 1),
        ((predicted.standard_error / predicted.variance) ** 2, max(predicted.realizations - 1, 1)),
    ]
    total = sum(square for square, _ in parts)
    if total == 0.0:
        return 0.0
    freedom = total**2 / sum(square**2 / own for square, own in parts)
    return float(stdtrit(freedom, 0.5 + 0.5 * LEVEL)) * math.sqrt(total)
