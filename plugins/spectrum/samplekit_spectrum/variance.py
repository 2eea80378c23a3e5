"""The variance of an estimate from the spectra of the sampler and of the integrand.

For sets of which every toroidal shift is as likely, and an integrand f repeated in all directions (Parseval on the
torus; Pilleboue et al. 2015 in its exact form, without isotropy):

    Var = sum over integer m, not 0, of |f(m)|^2 E|S(m)|^2.

What lies beyond the largest frequency is known as far as f goes: its energy there is the whole energy less what was
summed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
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
    from samplekit import ConfiguredSampler
    from samplekit_spectrum.integrands.integrand import Integrand
    from samplekit_spectrum.moments import Moments
    from samplekit_spectrum.regions import Region
    from samplekit_spectrum.sets import Source

Progress = Callable[[int, int], None]

_NEGLIGIBLE = 1e-3
_FIRST, _APART = 2**31, 2**26
"""Number of the first realisation whose spectrum is taken, none that is measured with; and of the next stratum's."""


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
        Sets in the expected spectrum, at the frequencies that have most; 1 where all have the same power.
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
    """Return whether all sets have the same |S|: the sampler is deterministic, apart from a shift."""
    if not sampler.spec.randomized:
        return True
    return (
        sampler.text.endswith("+shift") and not samplekit.sampler(sampler.text.removesuffix("+shift")).spec.randomized
    )


def predicted_variance(
    source: Source,
    integrand: Integrand,
    *,
    realizations: int | None,
    max_frequency: int | None,
    threads: int | None,
    progress: Progress,
) -> Predicted:
    """Sum the product of both spectra, with as many realisations as it takes.

    Parameters
    ----------
    source, integrand
        The sets, and what is integrated.
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

    def spectra(stratum: Stratum, number: int) -> list[Moments]:
        views = [region.view for region in stratum.regions]
        first = _FIRST + _APART * stratum.number + stratum.realizations
        return expectations(source, views, number, first=first, threads=threads, progress=progress)

    def begun(chosen: list[Region]) -> list[Stratum]:
        # Both axes have a shell in common: they cost little beside the sets.
        shells = [list(shell) for _, shell in groupby(chosen, lambda region: (region.cube.dims, region.inner))]
        strata = [Stratum(number, shell) for number, shell in enumerate(shells)]
        for stratum in strata:
            stratum.extend(spectra, 1 if fixed else PILOT if realizations is None else min(PILOT, realizations))
        return strata

    strata = begun(chosen)
    if not fixed:
        if max_frequency is None:
            trimmed = _trimmed(integrand, strata)
            strata = strata if trimmed == chosen else begun(trimmed)
        refine(strata, spectra, source, realizations, integrand.energy * ZERO**2)
    return _summed(source, integrand, strata, fixed=fixed)


def _trimmed(integrand: Integrand, strata: list[Stratum]) -> list[Region]:
    """The regions up to where what lies beyond adds less than a thousandth: smooth integrands need few frequencies.

    Nothing is left out nearer to DC, be it ever so dark: the energy that is missing is taken to be as bright as what is
    farthest out.
    """
    total = sum(float(stratum.totals.mean()) for stratum in strata)
    pairs = [pair for stratum in strata for pair in zip(stratum.regions, stratum.moments, strict=True)]
    needed = {region.view.axes: _needed(pairs, region.view.axes, _NEGLIGIBLE * total) for region, _ in pairs}
    kept = []
    for region, _ in pairs:
        axes, inner = region.view.axes, region.inner
        reach = min(needed[axes], region.cube.reach)
        if reach == region.cube.reach:
            kept.append(region)
        elif reach > inner:
            kept.append(square(integrand, inner, reach) if len(axes) == 2 else axis(integrand, axes[0], inner, reach))
    return kept or [region for region, _ in pairs]


def _needed(pairs: list[tuple[Region, Moments]], axes: tuple[int, ...], negligible: float) -> int:
    """A power of 2 beyond which the regions on some axes add no more than ``negligible``; 0 if they never do."""
    by_size = np.zeros(1 + max(region.cube.reach for region, _ in pairs if region.view.axes == axes))
    for region, moments in pairs:
        if region.view.axes == axes:
            size = np.abs(region.cube.vectors(0, region.cube.half)).max(axis=1)
            by_size += np.bincount(size, region.weights * moments.mean, by_size.size)
    if by_size.sum() <= negligible:
        return 0
    beyond = by_size.sum() - np.cumsum(by_size)
    return int(2 ** math.ceil(math.log2(max(int(np.argmax(beyond <= negligible)), 8))))


def _summed(source: Source, integrand: Integrand, strata: list[Stratum], *, fixed: bool) -> Predicted:
    mean, error = mean_and_error(strata)
    pairs = [pair for stratum in strata for pair in zip(stratum.regions, stratum.moments, strict=True)]
    missing = max(integrand.variance - sum(region.energy for region, _ in pairs), 0.0)
    # Rounding of the energies is no tail.
    missing = missing if missing > 1e-12 * integrand.energy else 0.0
    level, largest, bound = _beyond(source, pairs, fixed=fixed)
    squares = [region.cube.reach for region, _ in pairs if region.cube.dims == 2]
    axes = [region.cube.reach for region, _ in pairs if region.cube.dims == 1]
    tail = missing * level
    return Predicted(
        mean + tail, error, tail, missing * largest, bound, max(squares, default=0),
        max(axes, default=max(squares, default=0)), max(stratum.realizations for stratum in strata),
    )  # fmt: skip


def _beyond(source: Source, pairs: list[tuple[Region, Moments]], *, fixed: bool) -> tuple[float, float, str]:
    """The power beyond what was summed: about, and at most, and how that is known."""
    white = 1.0 / source.count
    if _at_most_white(source.sampler):
        return white, white, "proven"
    arms = any(region.cube.dims == 1 for region, _ in pairs)
    # Of shells the last alone has frequencies like those beyond.
    last = {region.view.axes: (region, moments) for region, moments in pairs}.values()
    outer = [outer_power(region, moments.mean, off_axes=arms) for region, moments in last]
    # The square comes first: beyond it is most of what is missing.
    level = next((power for power, _ in outer if math.isfinite(power)), white)
    # The power of a net or lattice returns to 1.
    return (level, 1.0, "proven") if fixed else (level, max(power for _, power in outer), "observed")


def _at_most_white(sampler: ConfiguredSampler) -> bool:
    """Return whether N E|S(m)|^2 <= 1 everywhere is known: for independent points, and for one in each grid cell."""
    plain = sampler.text.removesuffix("+shift")
    return sampler.plugin.name == "samplekit" and plain in ("random", "jittered")
