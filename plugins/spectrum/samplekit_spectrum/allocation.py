"""How many realisations each part of the frequencies gets, so that the predicted variance is known as well as wanted.

Neyman 1934, "On the two different aspects of the representative method": for a sum over independent strata, numbers
proportional to a stratum's standard deviation over the square root of its cost reach a standard error at least cost.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.transform import seconds

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.moments import Moments
    from samplekit_spectrum.regions import Region
    from samplekit_spectrum.sets import Source

Spectra = Callable[["Stratum", int], "list[Moments]"]
"""Gives the moments of a stratum's regions over so many realisations more."""

PRECISION = 0.0045
"""Relative standard error at which there are enough: with a measurement's 0.8 % the interval of the ratio is narrower
than 5 %."""
PILOT = 32
_MOST = 2**18
_GROWTH = 16
_SET_POINT, _SET_POINT_OF_WHOLE = 30e-9, 1e-4
"""Seconds that a point takes to make; where a sampler makes whole sets, and so reuses them by default."""


@dataclass(eq=False)
class Stratum:
    """Regions whose spectra are taken of the same sets.

    Attributes
    ----------
    number
        Number of the stratum. No two strata have a set in common.
    regions, moments
        The regions, and what is known of each.
    """

    number: int
    regions: list[Region]
    moments: list[Moments] = field(default_factory=list)

    @property
    def realizations(self) -> int:
        """How many sets the moments are of."""
        return self.moments[0].realizations if self.moments else 0

    @property
    def totals(self) -> NDArray[np.float64]:
        """For each set the sum of |f|^2 |S|^2 over the regions."""
        return np.asarray(np.sum([moments.totals for moments in self.moments], axis=0), np.float64)

    def cost(self, source: Source) -> float:
        """About the seconds that a set takes."""
        point = _SET_POINT_OF_WHOLE if source.sampler.spec.fresh_options else _SET_POINT
        return sum(seconds(region.cube, source.count) for region in self.regions) + source.count * point

    def extend(self, spectra: Spectra, more: int) -> None:
        """Add realisations."""
        found = spectra(self, more)
        if not self.moments:
            self.moments = found
            return
        for moments, others in zip(self.moments, found, strict=True):
            moments.merge(others)


def mean_and_error(strata: list[Stratum]) -> tuple[float, float]:
    """The sum over all strata and its standard error; 0 of sets that are always the same."""
    totals = [stratum.totals for stratum in strata]
    variance = sum(float(total.var(ddof=1)) / total.size for total in totals if total.size > 1)
    return float(sum(total.mean() for total in totals)), math.sqrt(variance)


def refine(strata: list[Stratum], spectra: Spectra, source: Source, realizations: int | None, zero: float) -> None:
    """Add realisations until there are enough, or ``realizations`` in each stratum; a sum of ``zero`` is rounding."""
    while True:
        if realizations is not None:
            wanted = [realizations] * len(strata)
        else:
            mean, error = mean_and_error(strata)
            if error <= PRECISION * mean or mean <= zero:
                return
            wanted = _allocated(strata, source, PRECISION * mean)
        lacking = [(stratum, number - stratum.realizations) for stratum, number in zip(strata, wanted, strict=True)]
        if all(more <= 0 for _, more in lacking):
            return
        for stratum, more in lacking:
            if more > 0:
                stratum.extend(spectra, more)


def _allocated(strata: list[Stratum], source: Source, error: float) -> list[int]:
    """How many in each stratum reach a standard error, as far as their spread is known by now."""
    spreads = [float(stratum.totals.std(ddof=1)) for stratum in strata]
    roots = [math.sqrt(stratum.cost(source)) for stratum in strata]
    scale = 1.1 * sum(spread * root for spread, root in zip(spreads, roots, strict=True)) / error**2
    aims = [scale * spread / root for spread, root in zip(spreads, roots, strict=True)]
    return [
        min(2 * math.ceil(min(aim, _GROWTH * stratum.realizations) / 2), _MOST)
        for aim, stratum in zip(aims, strata, strict=True)
    ]
