"""The variance that spectra predict, beside the measured one.

The prediction is exact for homogenised samplers only: without the shift the frequencies' amplitudes depend on each
other, and replacing E|S|^2 by the variance of S does not mend that. So the homogenised sampler is what is measured.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import samplekit
from samplekit import ConfiguredSampler, ConfiguredScene, check_seed
from samplekit_spectrum.homogenized import homogenized, is_homogeneous
from samplekit_spectrum.integrands import integrand_of
from samplekit_spectrum.measurement import TRIALS, ZERO, Measurement, measure
from samplekit_spectrum.request import check_integer
from samplekit_spectrum.sets import Source
from samplekit_spectrum.variance import Predicted, predicted_variance

if TYPE_CHECKING:
    from samplekit_spectrum.integrands.integrand import Integrand

Progress = Callable[[str, int, int], None]

CONFIDENCE = 0.99
_QUANTILE = 2.5758293035489004
_SHIFTS = 64
"""Shifts of each set that takes long to make in a measurement, at most."""


@dataclass(frozen=True)
class Comparison:
    """Prediction and measurement for one count.

    Attributes
    ----------
    count, predicted, measured
        The homogenised sampler's.
    native
        Measured without the shift; None where the shift changes nothing.
    ratio, ratio_low, ratio_high
        Measured over predicted with its interval of 99 %; NaN where both are zero.
    verdict
        ``"agrees"``, ``"agrees within the tail's bound"``, ``"differs"``, or ``"exact"`` (both are zero).
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
    progress: Progress = lambda _, __, ___: None,
) -> Comparison:
    """Predict the variance of a homogenised sampler's estimate of a scene over the unit square, and measure it.

    Parameters
    ----------
    sampler, scene, count
        As on the command line, or what :func:`samplekit.sampler` and :func:`samplekit.scene` returned; samples.
    trials
        Estimates that the measured variance is of; None: as many as make its standard error 0.8 %.
    realizations
        Sets in the expected spectrum; None: as many as make the prediction's standard error 0.45 %.
    max_frequency
        Largest frequency of the square; None: 16 sqrt N, at least 128, at most 512, or 1024 for sets that all have
        the same power.
    native
        Measure without the shift as well.
    seed, threads, progress
        From 0 to 2^64 - 1; by default one for each processor; called with what is done, and the numbers done and to do.

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
        threads=threads, progress=lambda done, total: progress("spectra", done, total),
    )  # fmt: skip
    # Each set under many shifts where it takes long to make, and then fewer sets natively.
    shifts = _shifts(trials or TRIALS) if chosen.spec.fresh_options else 1

    def measured(source: ConfiguredSampler, what: str, trials: int | None, shifts: int) -> Measurement:
        return measure(
            integrand_scene, source, int(count), integrand.mean,
            trials=trials, shifts=shifts, seed=seed, threads=threads,
            progress=lambda done, total: progress(what, done, total),
        )  # fmt: skip

    shifted = measured(homogenized(chosen, shifts), "measuring", trials, shifts)
    plain = None
    if native and not is_homogeneous(chosen):
        fewer = trials if shifts == 1 else shifted.trials // shifts
        plain = measured(chosen, "measuring without the shift", fewer, 1)
    return _compared(int(count), integrand, predicted, shifted, plain)


def check_settings(trials: int | None, realizations: int | None, max_frequency: int | None, seed: int) -> None:
    """Raise unless these are settings of :func:`predict`.

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
    """A divisor of the number of trials that leaves at least as many sets as there are shifts of each."""
    return max(shifts for shifts in range(1, _SHIFTS + 1) if trials % shifts == 0 and shifts**2 <= max(trials, 1))


def _compared(
    count: int, integrand: Integrand, predicted: Predicted, measured: Measurement, native: Measurement | None
) -> Comparison:
    zero = integrand.energy * ZERO**2
    if predicted.variance <= zero + 1e-3 * zero and measured.variance <= max(zero, 1e-24 * integrand.energy):
        return Comparison(count, predicted, measured, native, math.nan, math.nan, math.nan, "exact")
    if predicted.variance <= zero or measured.variance <= zero:
        ratio = measured.variance / predicted.variance if predicted.variance > 0.0 else math.inf
        low = high = ratio
    else:
        ratio = measured.variance / predicted.variance
        relative = math.hypot(
            measured.standard_error / measured.variance, predicted.standard_error / predicted.variance
        )
        low, high = ratio * math.exp(-_QUANTILE * relative), ratio * math.exp(_QUANTILE * relative)
    least = predicted.variance - predicted.tail
    most = least + predicted.tail_bound
    if low <= 1.0 <= high:
        verdict = "agrees"
    elif low * predicted.variance <= most and high * predicted.variance >= least:
        verdict = "agrees within the tail's bound"
    else:
        verdict = "differs"
    return Comparison(count, predicted, measured, native, ratio, low, high, verdict)
