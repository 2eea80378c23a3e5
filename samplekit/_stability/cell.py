"""One cell of a sweep: a scene, a sampler and a count, measured."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._integrate.loop import integrate, unit_square
from samplekit._stability.extended import ExtendedSums

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._bases.reference import Reference
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene

    Array = NDArray[np.float64]

ROUNDOFF = 2.0**-53
MOST_DIGITS = 16.0


@dataclass(frozen=True)
class Measured:
    """What was seen of a scene over the unit square as one pixel.

    Attributes
    ----------
    exact, reference_error
        The reference, and the bound of its error.
    estimate
        The mean of the estimates.
    error
        ``estimate - exact``.
    spread
        Standard deviation of one estimate, from the realisations; NaN for a sampler that is not random, and of one.
    standard_error
        Of ``estimate``: ``spread`` over the square root of the number of realisations.
    rms_error
        Root mean square over the realisations of estimate less exact.
    sampling_error
        As ``spread``, of the run in extended precision: what is left of the error where nothing is rounded.
    arithmetic_error
        The largest difference over the realisations between the estimate and that of the run in extended precision.
    digits_lost
        Decimal digits that summation lost, of those that one rounding of the mean magnitude leaves, in the worst
        realisation: 0 is one rounding.
    magnitude
        Mean of the magnitudes of all values.
    deviation
        Standard deviation of the values.
    hits
        The effective number of samples that differ from the commonest value: with d the distance from the median,
        (sum d)² / sum d² (Kish 1965, "Survey Sampling"). Of a set in bright light: the number of samples inside.
    invalid, samples
        Values that are not finite, and all, over all realisations.
    """

    exact: float
    reference_error: float
    estimate: float
    error: float
    spread: float
    standard_error: float
    rms_error: float
    sampling_error: float
    arithmetic_error: float
    digits_lost: float
    magnitude: float
    deviation: float
    hits: float
    invalid: int
    samples: int

    @property
    def allowance(self) -> float:
        """Error that is put down to rounding: of the reference, of the values and of their sum."""
        return self.reference_error + 32.0 * ROUNDOFF * max(abs(self.exact), self.magnitude)

    @property
    def standard_errors(self) -> float:
        """The error beyond the allowance in standard errors; NaN where there is none."""
        beyond = max(0.0, abs(self.error) - self.allowance)
        if not self.standard_error > 0.0:
            return 0.0 if beyond == 0.0 else math.nan
        return math.copysign(beyond / self.standard_error, self.error)

    @property
    def digits_right(self) -> float:
        """Decimal digits of one estimate that are right, from 0 to 16."""
        scale = abs(self.exact) or self.magnitude
        return _digits(self.rms_error, scale)


def _digits(error: float, scale: float) -> float:
    if not math.isfinite(error):
        return 0.0
    if error == 0.0:
        return MOST_DIGITS
    return min(max(-math.log10(error / scale), 0.0), MOST_DIGITS) if scale > 0.0 and error < scale else 0.0


def _digits_lost(errors: Array, magnitudes: Array) -> float:
    """Decimal digits of the largest of the errors in roundings of the magnitudes, at least 0."""
    seen = (errors != 0.0) & (magnitudes > 0.0)
    roundings = np.abs(errors[seen]) / (magnitudes[seen] * ROUNDOFF)
    return max(0.0, math.log10(float(roundings.max()))) if roundings.size else 0.0


class _Moments:
    """Deviation and hits of all values, block after block, about the median of the first block."""

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
        # Squares of 1e200 overflow: everything is in units of a power of two that is at least the largest so far.
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
) -> Measured:
    """Estimate a scene ``realizations`` times over, and once more in extended precision from the same points.

    Raises
    ------
    UsageError
        The sampler does not make such sets.
    """
    from samplekit._integrate.plan import check_points

    check_points(scene, sampler, count)
    sampler.prepare(count, scene.dims)
    trials = Realizations.of_trials(0, realizations, seed, scene.blocks)
    extended, magnitudes, moments = ExtendedSums(realizations), ExtendedSums(realizations), _Moments()

    def observe(tile: Array, boxes: Array) -> None:
        values = scene.values(tile, boxes)
        moments.add(values)
        magnitudes.add((np.abs(values),))
        extended.add(scene.parts(tile, boxes))

    # All realisations in one tile: the moments are about the median of the first block of all of them.
    (estimates,) = integrate(
        scene, sampler, (count,), trials, unit_square(realizations), tick=tick, observe=observe, tile_bytes=sys.maxsize
    )
    with np.errstate(all="ignore"):
        apart = extended.apart(estimates, count)
        exact = float(reference.image[0, 0])
        errors = estimates - exact
        unrounded = -extended.apart(np.full(realizations, exact), count)
        random = sampler.spec.randomized and realizations > 1
        spread, sampling_error = (_spread(each) if random else math.nan for each in (errors, unrounded))
    finite = bool(np.isfinite(estimates).all())
    return Measured(
        exact=exact,
        reference_error=reference.error,
        estimate=_mean(estimates) if finite else math.nan,
        error=_mean(errors) if finite else math.nan,
        spread=spread if finite else math.nan,
        standard_error=spread / math.sqrt(realizations) if finite else math.nan,
        rms_error=_root_mean_square(errors) if finite else math.nan,
        sampling_error=sampling_error if finite else math.nan,
        digits_lost=_digits_lost(apart, magnitudes.mean(count)) if finite else math.nan,
        arithmetic_error=float(np.abs(apart).max()) if finite else math.nan,
        magnitude=_mean(magnitudes.mean(count)),
        deviation=moments.deviation,
        hits=moments.hits,
        invalid=moments.invalid,
        samples=count * realizations,
    )


def _mean(values: Array) -> float:
    """The mean, rounded twice; values near the largest float do not overflow their sum."""
    shrink = 0.5 ** values.size.bit_length() if float(np.abs(values).max()) > 2.0**900 else 1.0
    return math.fsum((values * shrink).tolist()) / values.size / shrink


def _root_mean_square(values: Array) -> float:
    largest = float(np.abs(values).max())
    return math.sqrt(_mean(np.square(values / largest))) * largest if largest > 0.0 else 0.0


def _spread(values: Array) -> float:
    """Standard deviation about the mean, unbiased in its square."""
    return _root_mean_square(values - _mean(values)) * math.sqrt(values.size / (values.size - 1))
