"""Measure one cell of a sweep: estimates of a scene, and the same estimates in extended precision."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.hits import effective_hits
from samplekit._integrate.loop import integrate, unit_square
from samplekit._integrate.plan import check_points
from samplekit._stability.extended import accumulate, distances

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._bases.reference import Reference
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene

    Array = NDArray[np.float64]

ROUNDOFF = 2.0**-53
"""Largest relative error of one rounding to float64."""
_MOST_DIGITS = 16.0
_AT_ONCE = 32
"""Realisations that are measured together: memory does not grow with their number."""
_KEPT_BYTES = 2**24
"""Size of the array that is freed before the first block; its pages are never touched."""


@dataclass(frozen=True)
class Measurement:
    """Estimates of a scene over the unit square as one pixel. If one of them is not finite, all errors are NaN.

    Attributes
    ----------
    exact, reference_error
        The reference, and the bound of its error.
    estimate
        Mean of the estimates over the realisations.
    error
        ``estimate - exact``.
    spread
        Standard deviation of one estimate over the realisations; NaN if the sampler is not random or there is only one
        realisation.
    standard_error
        Standard error of ``estimate``: ``spread`` divided by the square root of the number of realisations.
    rms_error
        Root mean square of the errors of the estimates.
    sampling_error
        As ``spread``, for the run in extended precision: the error that is left if nothing is rounded.
    arithmetic_error
        Largest difference between an estimate and the same estimate in extended precision.
    digits_lost
        Decimal digits that summation lost in the worst realisation, beyond one rounding of the mean magnitude.
    magnitude
        Mean of the magnitudes of all values. On a pedestal it is that of both parts, which may cancel.
    deviation
        Standard deviation of the values.
    hits
        Effective number of samples that differ from the most common value: (sum d)² / sum d², where d is the distance
        from the median (Kish 1965, "Survey Sampling"). For the indicator of a set it is the number of samples inside.
    realizations
        Number of estimates.
    effective_realizations
        Effective number of realisations that carry the spread: see ``samplekit._integrate.hits``. NaN as ``spread``.
    invalid, samples
        Number of values that are not finite, and of all values, over all realisations.
    """

    exact: float
    reference_error: float
    magnitude: float
    deviation: float
    hits: float
    invalid: int
    samples: int
    realizations: int
    estimate: float = math.nan
    error: float = math.nan
    spread: float = math.nan
    standard_error: float = math.nan
    rms_error: float = math.nan
    sampling_error: float = math.nan
    arithmetic_error: float = math.nan
    digits_lost: float = math.nan
    effective_realizations: float = math.nan

    @property
    def allowance(self) -> float:
        """Error that rounding may cause: in the reference, in the values and in their sum."""
        return self.reference_error + 32.0 * ROUNDOFF * max(abs(self.exact), self.magnitude)

    @property
    def standard_errors(self) -> float:
        """The error beyond the allowance, in standard errors; NaN if there is no standard error."""
        beyond = max(0.0, abs(self.error) - self.allowance)
        if not self.standard_error > 0.0:
            return 0.0 if self.standard_error == beyond == 0.0 else math.nan
        return math.copysign(beyond / self.standard_error, self.error)

    @property
    def digits_right(self) -> float:
        """Correct decimal digits of one estimate, from 0 to 16."""
        scale = abs(self.exact) or self.magnitude
        if self.rms_error == 0.0:
            return _MOST_DIGITS
        if not (self.rms_error < scale and scale > 0.0):
            return 0.0
        return min(max(-math.log10(self.rms_error / scale), 0.0), _MOST_DIGITS)


def _digits_lost(errors: Array, magnitudes: Array) -> float:
    """Return the decimal digits of the largest error, in roundings of its magnitude; at least 0."""
    seen = (errors != 0.0) & (magnitudes > 0.0)
    # A denormal magnitude times a rounding would vanish.
    roundings = np.abs(errors[seen]) / ROUNDOFF / magnitudes[seen]
    return max(0.0, math.log10(float(roundings.max()))) if roundings.size else 0.0


class _Moments:
    """Deviation and hits of all values, summed block by block about the median of the first block."""

    def __init__(self) -> None:
        self.finite = self.invalid = 0
        self._centre = math.nan
        self._scale = 0.0
        self._sums = np.zeros(3)

    def add(self, values: Array) -> None:
        finite = values[np.isfinite(values)]
        self.invalid += values.size - finite.size
        self.finite += finite.size
        if finite.size == 0:
            return
        if math.isnan(self._centre):
            self._centre = float(np.partition(finite, finite.size // 2)[finite.size // 2])
        # Squares of 1e200 overflow: all sums are in units of a power of two, at least as large as the largest value.
        largest = float(np.abs(finite).max()) + abs(self._centre)
        if largest > self._scale:
            scale = 2.0 ** min(math.frexp(largest)[1], 1023)
            shrink = self._scale / scale
            self._sums *= [shrink, shrink, shrink * shrink]
            self._scale = scale
        if self._scale == 0.0:
            return
        away = finite / self._scale - self._centre / self._scale
        self._sums += [away.sum(), np.abs(away).sum(), np.square(away).sum()]

    @property
    def deviation(self) -> float:
        if not self.finite:
            return math.nan
        total, _, squares = self._sums / self.finite
        return math.sqrt(max(0.0, squares - total * total)) * self._scale

    @property
    def hits(self) -> float:
        _, total, squares = self._sums
        return float(total * total / squares) if squares > 0.0 else 0.0


def measure(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    *,
    realizations: int,
    seed: int,
    reference: Reference,
    tick: Callable[[int], None] = lambda _: None,
) -> Measurement:
    """Estimate a scene several times, and each time in extended precision from the same points.

    Parameters
    ----------
    scene, sampler, count
        The integrand, the sampler, and the number of samples of an estimate.
    realizations, seed
        Number of independent estimates, and their seed.
    reference
        The exact mean over the unit square, as an image of one pixel.
    tick
        Called now and then with the number of samples done since the last call.

    Raises
    ------
    UsageError
        The sampler cannot make such sets.
    """
    check_points(scene, sampler, count)
    sampler.prepare(count, scene.dims)
    totals, magnitude_totals, moments = np.zeros((realizations, 2)), np.zeros((realizations, 2)), _Moments()
    estimates = np.empty(realizations)
    # glibc returns freed memory to the system unless a larger array was freed before, of at most 32 MiB; each block's
    # arrays would then take fresh pages, which costs a seventh of the time.
    np.empty(_KEPT_BYTES, np.uint8)
    for first in range(0, realizations, _AT_ONCE):
        part = slice(first, min(first + _AT_ONCE, realizations))
        trials = sampler.trials(part.start, part.stop, seed, scene.blocks)

        def observe(tile: Array, boxes: Array, part: slice = part) -> None:
            values = scene.values(tile, boxes)
            moments.add(values)
            for term in scene.parts(tile, boxes):
                accumulate(np.ascontiguousarray(term), totals[part])
                accumulate(np.ascontiguousarray(np.abs(term)), magnitude_totals[part])

        # These realisations share one tile, so the moments are about the median of the first block of all of them.
        boxes, one_tile = unit_square(len(trials)), sys.maxsize
        (estimates[part],) = integrate(
            scene, sampler, (count,), trials, boxes, tick=tick, observe=observe, tile_bytes=one_tile
        )
    exact = float(reference.image[0, 0])
    magnitudes = magnitude_totals[:, 0] / count
    measured = Measurement(
        exact=exact,
        reference_error=reference.error,
        magnitude=_mean(magnitudes),
        deviation=moments.deviation,
        hits=moments.hits,
        invalid=moments.invalid,
        samples=count * realizations,
        realizations=realizations,
    )
    if not np.isfinite(estimates).all():
        return measured
    with np.errstate(all="ignore"):
        rounding = distances(estimates, totals, count)
        unrounded = -distances(np.full(realizations, exact), totals, count)
        errors = estimates - exact
        random = sampler.spec.randomized and realizations > 1
        spread, sampling_error = (_spread(each) if random else math.nan for each in (errors, unrounded))
    return replace(
        measured,
        effective_realizations=effective_hits(errors, measured.allowance) if random else math.nan,
        estimate=_mean(estimates),
        error=_mean(errors),
        spread=spread,
        standard_error=spread / math.sqrt(realizations),
        rms_error=_root_mean_square(errors),
        sampling_error=sampling_error,
        arithmetic_error=float(np.abs(rounding).max()),
        digits_lost=_digits_lost(rounding, magnitudes),
    )


def _mean(values: Array) -> float:
    """Return the mean, rounded twice. The sum of values near the largest float does not overflow."""
    shrink = 0.5 ** values.size.bit_length() if float(np.abs(values).max()) > 2.0**900 else 1.0
    return math.fsum((values * shrink).tolist()) / values.size / shrink


def _root_mean_square(values: Array) -> float:
    """Return the root mean square. Squares of very large or very small values do not overflow or vanish."""
    largest = float(np.abs(values).max())
    return math.sqrt(_mean(np.square(values / largest))) * largest if largest > 0.0 else 0.0


def _spread(values: Array) -> float:
    """Return the standard deviation about the mean; its square is unbiased."""
    return _root_mean_square(values - _mean(values)) * math.sqrt(values.size / (values.size - 1))
