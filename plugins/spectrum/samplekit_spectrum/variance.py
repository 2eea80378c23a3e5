"""The variance of an estimate from the spectra of the sampler and of the integrand.

If all toroidal shifts of a set are equally likely, and the integrand f is repeated in all directions (Parseval on the
torus; Pilleboue et al. 2015 in its exact form, without isotropy):

    Var = sum over integer m, not 0, of |f(m)|^2 E|S(m)|^2.

Beyond the largest frequency, the energy of f is known: it is the whole energy minus the energy that was summed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit_spectrum.allocation import PILOT, Stratum, mean_and_error, refine
from samplekit_spectrum.dual_lattice import variance_on_grid
from samplekit_spectrum.expectation import expectations
from samplekit_spectrum.measurement import ZERO
from samplekit_spectrum.regions import axis, outer_power, reaches, regions, square

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit import ConfiguredSampler
    from samplekit_spectrum.integrands.integrand import Integrand
    from samplekit_spectrum.moments import Moments
    from samplekit_spectrum.point_sets import Source
    from samplekit_spectrum.regions import Region

    Summed = list[tuple[Region, Moments]]
    """The regions that are summed, nearest to DC first, with the moments of each."""

_NEGLIGIBLE = 1e-3
"""Share of the variance that may be added by the frequencies that are left out."""


@dataclass(frozen=True)
class Predicted:
    """The variance from the spectra.

    Attributes
    ----------
    variance, standard_error
        The sum, including the estimate of the tail; and its standard error, which is 0 if all sets have the same power,
        and NaN for a single realisation otherwise.
    tail, tail_bound
        The part of the variance beyond the largest frequency: an estimate, and an upper bound.
    bound
        How the bound is known: ``"proven"``; ``"observed"``, if it assumes that no power beyond the largest frequency
        exceeds the largest power that was seen; or ``"extrapolated"``.
    max_frequency, max_axis_frequency
        The largest frequencies of the square and of the axes.
    realizations
        Number of sets in the expected spectrum, at the frequencies with the most sets; 1 if all have the same power.
    """

    variance: float
    standard_error: float
    tail: float
    tail_bound: float
    bound: str
    max_frequency: int
    max_axis_frequency: int
    realizations: int


def has_fixed_power(sampler: ConfiguredSampler) -> bool:
    """Return whether all sets have the same |S|: the sampler without a random shift is deterministic."""
    if not sampler.spec.randomized:
        return True
    inner = sampler.text.removesuffix("+shift")
    return inner != sampler.text and not samplekit.sampler(inner).spec.randomized


def predicted_variance(
    source: Source,
    integrand: Integrand,
    *,
    realizations: int | None,
    max_frequency: int | None,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> Predicted:
    """Sum the product of both spectra.

    Parameters
    ----------
    source, integrand
        The sets, and the integrand.
    realizations, max_frequency, threads, progress
        As in :func:`samplekit_spectrum.prediction.predict`.
    """
    fixed = has_fixed_power(source.sampler)
    if source.sampler.spec.name == "regular" and source.sampler.plugin.name == "samplekit" and fixed:
        total, outer = variance_on_grid(integrand, source.count)
        return Predicted(total + outer, 0.0, outer, 2.0 * outer, "extrapolated", 0, 0, 1)
    reach, axis_reach = reaches(source.count, fixed=fixed)
    chosen = regions(integrand, max_frequency or reach, axis_reach, in_shells=not fixed)
    if not chosen:
        return Predicted(0.0, 0.0, 0.0, 0.0, "proven", 0, 0, 1)
    expected = partial(expectations, source, threads=threads, progress=progress)
    pilot = 1 if fixed else min(PILOT, realizations or PILOT)

    def pilot_strata(chosen: list[Region]) -> list[Stratum]:
        # Both axes share a stratum: their transforms cost little compared with making the sets.
        shells = groupby(chosen, lambda region: (region.frequencies.dims, region.inner))
        strata = [Stratum(number, list(shell)) for number, (_, shell) in enumerate(shells)]
        for stratum in strata:
            stratum.extend_to(pilot, expected)
        return strata

    strata = pilot_strata(chosen)
    if not fixed:
        if max_frequency is None:
            trimmed = _trimmed(integrand, strata)
            strata = strata if trimmed == chosen else pilot_strata(trimmed)
        if realizations is None:
            refine(strata, source, expected, integrand.energy * ZERO**2)
        else:
            for stratum in strata:
                stratum.extend_to(realizations, expected)
    return _with_tail(source, integrand, strata, fixed=fixed)


def _summed(strata: list[Stratum]) -> Summed:
    return [pair for stratum in strata for pair in zip(stratum.regions, stratum.moments, strict=True)]


def _trimmed(integrand: Integrand, strata: list[Stratum]) -> list[Region]:
    """Cut the regions where all frequencies beyond add less than a thousandth: smooth integrands need few frequencies.

    No frequency nearer to DC is left out, even if it has no power: the estimate of the tail assumes that the missing
    energy meets the power of the outermost frequencies.
    """
    summed = _summed(strata)
    negligible = _NEGLIGIBLE * sum(float(stratum.totals.mean()) for stratum in strata)
    needed = {region.axes: _needed(summed, region.axes, negligible) for region, _ in summed}
    kept = []
    for region, _ in summed:
        axes, inner, reach = region.axes, region.inner, needed[region.axes]
        if reach >= region.frequencies.reach:
            kept.append(region)
        elif reach > inner:
            kept.append(square(integrand, inner, reach) if len(axes) == 2 else axis(integrand, axes[0], inner, reach))
    return kept or [region for region, _ in summed]


def _needed(summed: Summed, axes: tuple[int, ...], negligible: float) -> int:
    """Return a power of 2 beyond which regions on ``axes`` add at most ``negligible``; 0 if all add no more."""
    chosen = [(region, moments) for region, moments in summed if region.axes == axes]
    by_size = np.zeros(1 + max(region.frequencies.reach for region, _ in chosen))
    for region, moments in chosen:
        size = np.abs(region.frequencies.vectors(0, region.frequencies.half)).max(axis=1)
        by_size += np.bincount(size, region.weights * moments.mean, by_size.size)
    if by_size.sum() <= negligible:
        return 0
    beyond = by_size.sum() - np.cumsum(by_size)
    return int(2 ** math.ceil(math.log2(max(int(np.argmax(beyond <= negligible)), 8))))


def _with_tail(source: Source, integrand: Integrand, strata: list[Stratum], *, fixed: bool) -> Predicted:
    """Add the tail to the sum over all strata."""
    summed = _summed(strata)
    mean, error = mean_and_error(strata)
    if not fixed and strata[0].realizations < 2:
        error = math.nan
    missing = max(integrand.variance - sum(region.energy for region, _ in summed), 0.0)
    # A tiny difference of the energies is rounding, not a tail.
    missing = missing if missing > 1e-12 * integrand.energy else 0.0
    level, largest, bound = _power_beyond(source, summed, fixed=fixed)
    cubes = [region.frequencies for region, _ in summed]
    reach = max((cube.reach for cube in cubes if cube.dims == 2), default=0)
    axis_reach = max((cube.reach for cube in cubes if cube.dims == 1), default=reach)
    tail = missing * level
    return Predicted(
        mean + tail, error, tail, missing * largest, bound, reach, axis_reach,
        max(stratum.realizations for stratum in strata),
    )  # fmt: skip


def _power_beyond(source: Source, summed: Summed, *, fixed: bool) -> tuple[float, float, str]:
    """Return an estimate and an upper bound of the power beyond the sum, and how the bound is known."""
    white = 1.0 / source.count
    plain = source.sampler.text.removesuffix("+shift")
    if source.sampler.plugin.name == "samplekit" and plain in ("random", "jittered"):
        # N E|S|^2 <= 1 everywhere, for independent points and for one point in each cell of a grid.
        return white, white, "proven"
    # The frequencies beyond are like those of the last shell of the square and of each axis.
    last = {region.axes: (region, moments) for region, moments in summed}.values()
    has_axes = any(len(region.axes) == 1 for region, _ in last)
    outer = [outer_power(region, moments.mean, off_axes=has_axes) for region, moments in last]
    # The square, which is the first, has most of the missing energy beyond it.
    level = next((power for power, _ in outer if math.isfinite(power)), white)
    # The power of a net or a lattice returns to 1.
    return (level, 1.0, "proven") if fixed else (level, max(power for _, power in outer), "observed")
