"""Poisson-disk sampling: random points that keep their distance, by dart throwing or by sample elimination."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from samplekit import MinimumDistance, Realizations, SamplerSpec, UsageError
from samplekit_bluenoise import DEFAULT_RADIUS
from samplekit_bluenoise.bank import WholeSets
from samplekit_bluenoise.darts import MOST_ATTEMPTS, throw_darts
from samplekit_bluenoise.elimination import eliminate
from samplekit_bluenoise.torus import packing_distance

Array = NDArray[np.float64]

_MARGIN = 1e-9
"""Relative margin of darts over the promised distance, since other ways to compute distances round differently."""


class PoissonDisk(WholeSets):
    """Random points that keep a distance on the torus.

    Parameters
    ----------
    radius
        Smallest distance of darts, as a fraction of the densest packing's.
    method
        ``darts``, or ``elimination``, which takes no radius and reaches about 0.7.
    bank
        Number of sets in the bank; 0 makes every realisation afresh.

    Raises
    ------
    UsageError
        A radius is given for elimination.
    """

    def __init__(self, radius: float, method: str, bank: int) -> None:
        if method == "elimination" and radius != DEFAULT_RADIUS:
            raise UsageError("poisson-disk: radius is for method=darts; elimination takes none, and reaches about 0.7")
        super().__init__(f"poisson-disk method={method} radius={radius!r}", bank)
        self._radius = radius
        self._method = method

    def make(self, sets: Array, realizations: Realizations) -> None:
        """Write whole sets; see :meth:`WholeSets.make`.

        Raises
        ------
        UsageError
            Darts found no room for all points.
        """
        if self._method == "elimination":
            eliminate(sets, realizations.keys)
            return
        count = sets.shape[2]
        distance = self._radius * packing_distance(count) * (1.0 + _MARGIN)
        made = throw_darts(sets, realizations.keys, distance)
        if made < len(realizations):
            raise UsageError(
                f"poisson-disk:radius={self._radius}: random disks left no room for {count} points in {MOST_ATTEMPTS} "
                "attempts: expected a smaller radius, or method=elimination"
            )

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare the distance that darts promise; elimination promises none."""
        promises = (MinimumDistance(self._radius),) if self._method == "darts" and self._radius > 0.0 else ()
        return replace(spec, promises=promises)
