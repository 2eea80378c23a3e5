"""The variance of an estimate from the spectra of the sampler and of the integrand, beside the measured one.

For sets of which every toroidal shift is as likely, and an integrand f repeated in all directions (Parseval on the
torus; Pilleboue et al. 2015 in its exact form, without isotropy):

    Var = sum over integer m, not 0, of |f(m)|^2 E|S(m)|^2.

It is exact for homogenised samplers only: without the shift the frequencies' amplitudes depend on each other, and
replacing E|S|^2 by the variance of S does not mend that.

What lies beyond the largest frequency is known as far as f goes: its energy there is the whole energy less what was
summed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit.errors import UsageError
from samplekit.integration.configured import ConfiguredScene, configured_scene
from samplekit.sampling.configured import ConfiguredSampler, configured_sampler
from samplekit.sampling.realizations import check_seed
from samplekit_spectrum.dual_lattice import variance_on_grid
from samplekit_spectrum.expectation import Source, expectations
from samplekit_spectrum.homogenized import homogenized, is_homogeneous
from samplekit_spectrum.integrands import integrand_of
from samplekit_spectrum.measurement import ZERO, Measurement, measure
from samplekit_spectrum.regions import axis, outer_power, reaches, regions, square

if TYPE_CHECKING:
    from samplekit_spectrum.integrands.integrand import Integrand
    from samplekit_spectrum.moments import Moments
    from samplekit_spectrum.regions import Region

Progress = Callable[[str, int, int], None]

CONFIDENCE = 0.99
_QUANTILE = 2.5758293035489004
_PRECISION = 0.0045
"""Relative standard error at which the spectrum's realisations are enough: with the measurement's 0.8 % the interval of
the ratio is narrower than 5 %."""
_MOST_REALIZATIONS = 2**16
_PILOT = 8
_NEGLIGIBLE = 1e-3
_FIRST = 2**31
"""Number of the first realisation whose spectrum is taken: none that is measured with."""


@dataclass(frozen=True)
class Predicted:
    """The variance from the spectra.

    Attributes
    ----------
    variance, standard_error
        The sum with the tail's estimate, and its error from the number of realisations.
    tail, tail_bound
        What lies beyond the largest frequency, as estimated, and at most.
    bound
        How the bound is known: ``"proven"``, or ``"observed"`` (no power beyond is larger than the largest within
        reach), or ``"extrapolated"``.
    max_frequency, max_axis_frequency
        How far the square and the axes were summed.
    realizations
        Sets in the expected spectrum; 1 where all have the same power.
    """

    variance: float
    standard_error: float
    tail: float
    tail_bound: float
    bound: str
    max_frequency: int
    max_axis_frequency: int
    realizations: int


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
        Of the square; None: 4 sqrt N, at least 128, at most 512, or 1024 for sets that all have the same power.
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
    chosen = (configured_sampler(sampler) if isinstance(sampler, str) else sampler).fresh()
    integrand_scene = configured_scene(scene) if isinstance(scene, str) else scene
    integrand = integrand_of(integrand_scene)
    chosen.check(count, integrand_scene.dims)
    check_seed(seed)
    if trials is not None:
        _check(trials, "trials", 4, 2**31)
    if realizations is not None:
        _check(realizations, "realizations", 1, 2**31)
    if max_frequency is not None:
        _check(max_frequency, "max-frequency", 1, 2**13)
    predicted = _predicted(
        Source(chosen, int(count), 2, int(seed)), integrand, realizations, max_frequency, threads, progress
    )

    def measured(source: ConfiguredSampler, what: str) -> Measurement:
        return measure(
            integrand_scene, source, int(count), integrand.mean,
            trials=trials, seed=seed, threads=threads, progress=lambda done, total: progress(what, done, total),
        )  # fmt: skip

    shifted = measured(homogenized(chosen), "measuring")
    plain = measured(chosen, "measuring without the shift") if native and not is_homogeneous(chosen) else None
    return _compared(int(count), integrand, predicted, shifted, plain)


def has_fixed_power(sampler: ConfiguredSampler) -> bool:
    """Whether all its sets have the same |S|: it is not random, but for a shift."""
    if not sampler.spec.randomized:
        return True
    return (
        sampler.text.endswith("+shift") and not configured_sampler(sampler.text.removesuffix("+shift")).spec.randomized
    )


def _check(value: object, what: str, least: int, most: int) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise UsageError(f"{what} {value}: expected an integer from {least} to {most}")


def _predicted(
    source: Source,
    integrand: Integrand,
    realizations: int | None,
    max_frequency: int | None,
    threads: int | None,
    progress: Progress,
) -> Predicted:
    fixed = has_fixed_power(source.sampler)
    if source.sampler.spec.name == "regular" and source.sampler.plugin.name == "samplekit" and fixed:
        total, outer = variance_on_grid(integrand, source.count)
        return Predicted(total + outer, 0.0, outer, 2.0 * outer, "extrapolated", 0, 0, 1)
    reach, axis_reach = reaches(source.count, fixed=fixed)
    reach = max_frequency or reach
    chosen = regions(integrand, reach, axis_reach)
    if not chosen:
        return Predicted(0.0, 0.0, 0.0, 0.0, "proven", 0, 0, 1)

    def spectra(number: int, first: int) -> list[Moments]:
        views = [region.view for region in chosen]
        return expectations(
            source, views, number, first=_FIRST + first, threads=threads,
            progress=lambda done, total: progress("spectra", done, total),
        )  # fmt: skip

    found = spectra(1 if fixed else _PILOT, 0)
    if not fixed:
        if max_frequency is None:
            chosen = _trimmed(integrand, chosen, found)
            found = spectra(_PILOT, 0)
        found = _refined(spectra, found, realizations)
    return _summed(source, integrand, chosen, found, fixed=fixed)


def _trimmed(integrand: Integrand, chosen: list[Region], found: list[Moments]) -> list[Region]:
    """The regions without what adds less than a thousandth, so that smooth integrands need few frequencies."""
    total = sum(float(region.weights @ moments.mean) for region, moments in zip(chosen, found, strict=True))
    kept = []
    for region, moments in zip(chosen, found, strict=True):
        cube = region.cube
        terms = region.weights * moments.mean
        if float(terms.sum()) < _NEGLIGIBLE * total:
            continue
        size = np.abs(cube.vectors(0, cube.half)).max(axis=1)
        by_size = np.bincount(size, terms)
        beyond = by_size.sum() - np.cumsum(by_size)
        needed = int(np.argmax(beyond <= _NEGLIGIBLE * total))
        needed = 2 ** max(math.ceil(math.log2(max(needed, 1))), 3)
        if needed >= cube.reach:
            kept.append(region)
        elif cube.dims == 2:
            kept.append(square(integrand, needed))
        else:
            kept.append(axis(integrand, region.view.axes[0], region.inner, max(needed, region.inner + 1)))
    return kept or chosen


def _refined(
    spectra: Callable[[int, int], list[Moments]], found: list[Moments], realizations: int | None
) -> list[Moments]:
    """More realisations, doubling, until there are enough."""
    done = _PILOT
    while True:
        totals = _totals(found)
        mean, error = totals.mean(), totals.std(ddof=1) / math.sqrt(done)
        if realizations is not None:
            wanted = realizations
        elif error <= _PRECISION * mean or done >= _MOST_REALIZATIONS:
            wanted = done
        else:
            # Straight to what the spread asks for, once it is known well enough.
            aim = done * (error / (_PRECISION * mean)) ** 2 * 1.1
            wanted = min(2 * math.ceil(min(aim, 16.0 * done) / 2), _MOST_REALIZATIONS)
        if wanted <= done:
            return found
        more = spectra(wanted - done, done)
        for total, moments in zip(found, more, strict=True):
            total.merge(moments)
        done = wanted


def _totals(found: list[Moments]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.sum([moments.totals for moments in found], axis=0)  # type: ignore[no-any-return]


def _summed(
    source: Source, integrand: Integrand, chosen: list[Region], found: list[Moments], *, fixed: bool
) -> Predicted:
    totals = _totals(found)
    number = totals.size
    error = float(totals.std(ddof=1) / math.sqrt(number)) if number > 1 else 0.0
    missing = max(integrand.variance - sum(region.energy for region in chosen), 0.0)
    # Rounding of the energies is no tail.
    missing = missing if missing > 1e-12 * integrand.energy else 0.0
    level, largest = 1.0 / source.count, 1.0 / source.count
    bound = "proven"
    if not _at_most_white(source.sampler):
        arms = any(region.cube.dims == 1 for region in chosen)
        outer = [
            outer_power(region, moments.mean, off_axes=arms) for region, moments in zip(chosen, found, strict=True)
        ]
        # The square comes first: beyond it is most of what is missing.
        level = next((power for power, _ in outer if math.isfinite(power)), level)
        # The power of a net or lattice returns to 1.
        largest, bound = (1.0, "proven") if fixed else (max(power for _, power in outer), "observed")
    squares = [region.cube.reach for region in chosen if region.cube.dims == 2]
    axes = [region.cube.reach for region in chosen if region.cube.dims == 1]
    tail = missing * level
    return Predicted(
        float(totals.mean()) + tail, error, tail, missing * largest, bound, max(squares, default=0),
        max(axes, default=max(squares, default=0)), number,
    )  # fmt: skip


def _at_most_white(sampler: ConfiguredSampler) -> bool:
    """Whether N E|S(m)|^2 <= 1 is known at every frequency: independent points, and one in each cell of a grid."""
    plain = sampler.text.removesuffix("+shift")
    return sampler.plugin.name == "samplekit" and plain in ("random", "jittered")


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
