"""Choose how many realisations each part of the frequencies gets, so that the predicted variance is precise enough.

Neyman 1934, "On the two different aspects of the representative method": a sum over independent strata reaches a
standard error at the least cost if the numbers of realisations are proportional to a stratum's standard deviation over
the square root of its cost.
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
    from samplekit_spectrum.point_sets import Source
    from samplekit_spectrum.regions import Region

Expectations = Callable[..., "list[Moments]"]
""":func:`samplekit_spectrum.expectation.expectations` with a source, a number of threads and progress."""

PRECISION = 0.0045
"""Relative standard error that is aimed at: with 0.8 % of the measurement, the interval of the ratio is below 5 %."""
PILOT = 32
"""Number of realisations from which the spread of each stratum is first estimated."""
_MOST = 2**18
_GROWTH = 16
"""Largest number of realisations of a stratum, and largest factor by which it grows at once."""
_SET_POINT, _SET_POINT_OF_WHOLE = 30e-9, 1e-4
"""Seconds to make a point; and those of a sampler that makes whole sets, and so reuses them by default."""
_FIRST, _APART = 2**31, 2**26
"""Number of the first realisation of stratum 0, which no measurement uses, and the distance to the next stratum's."""


@dataclass(eq=False)
class Stratum:
    """Regions whose spectra are computed from the same sets.

    Attributes
    ----------
    number
        Number of the stratum. No two strata have a set in common.
    regions, moments
        The regions, and the moments of each; none at first.
    """

    number: int
    regions: list[Region]
    moments: list[Moments] = field(default_factory=list)

    @property
    def realizations(self) -> int:
        """Number of sets in the moments."""
        return self.moments[0].realizations if self.moments else 0

    @property
    def totals(self) -> NDArray[np.float64]:
        """The sum of |f|^2 |S|^2 over the regions, for each set."""
        return np.asarray(np.sum([moments.totals for moments in self.moments], axis=0))

    def cost(self, source: Source) -> float:
        """Estimate the seconds that a set takes."""
        point = _SET_POINT_OF_WHOLE if source.sampler.spec.fresh_options else _SET_POINT
        transforms = sum(min(seconds(region.frequencies, source.count)) for region in self.regions)
        return transforms + source.count * point

    def extend_to(self, number: int, expectations: Expectations) -> bool:
        """Add realisations until there are as many as ``number``; return whether any were lacking."""
        more = number - self.realizations
        if more <= 0:
            return False
        found = expectations(self.regions, more, first=_FIRST + _APART * self.number + self.realizations)
        if self.moments:
            for moments, others in zip(self.moments, found, strict=True):
                moments.merge(others)
        else:
            self.moments = found
        return True


def mean_and_error(strata: list[Stratum]) -> tuple[float, float]:
    """Return the sum over all strata and its standard error, which is 0 if all sets have the same power."""
    totals = [stratum.totals for stratum in strata]
    variance = sum(float(total.var(ddof=1)) / total.size for total in totals if total.size > 1)
    return float(sum(total.mean() for total in totals)), math.sqrt(variance)


def refine(strata: list[Stratum], source: Source, expectations: Expectations, zero: float) -> None:
    """Add realisations until the sum is precise enough; a sum up to ``zero`` is only rounding."""
    while True:
        mean, error = mean_and_error(strata)
        if error <= PRECISION * mean or mean <= zero:
            return
        wanted = _allocated(strata, source, PRECISION * mean)
        extended = [stratum.extend_to(number, expectations) for stratum, number in zip(strata, wanted, strict=True)]
        if not any(extended):
            return


def _allocated(strata: list[Stratum], source: Source, error: float) -> list[int]:
    """Return the numbers of realisations that reach a standard error, given the spreads that are known so far."""
    spreads = [float(stratum.totals.std(ddof=1)) for stratum in strata]
    roots = [math.sqrt(stratum.cost(source)) for stratum in strata]
    scale = 1.1 * sum(spread * root for spread, root in zip(spreads, roots, strict=True)) / error**2
    numbers = []
    for stratum, spread, root in zip(strata, spreads, roots, strict=True):
        aim = min(scale * spread / root, _GROWTH * stratum.realizations)
        numbers.append(min(2 * math.ceil(aim / 2), _MOST))
    return numbers
