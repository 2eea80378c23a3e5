"""Capacity-constrained Voronoi tessellations: all sites own equally many background points, and lie at their centroids.

Balzer, Schlömer, Deussen 2009, "Capacity-constrained point distributions: a variant of Lloyd's method". Three things
differ from the paper:

- The background is jittered: with random points N P has a floor of 1 / capacity at low frequencies.
- The first assignment divides the background along lines that favour no direction, so that no lattice remains.
- The background is refined in steps: sites settle with a few points each; then every point is replaced by one in each
  quarter of its stratum, and the sites settle again. Capacities stay equal, and most of the way is gone with few
  points.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations
from samplekit_bluenoise.bank import WholeSets
from samplekit_bluenoise.strata import scatter, split
from samplekit_bluenoise.swaps import settle
from samplekit_bluenoise.territories import cut_open, divide
from samplekit_bluenoise.torus import finish

Array = NDArray[np.float64]

_COARSEST = 8
"""Smallest number of background points per site at which sites are left to settle."""
_MOST_SWEEPS = 200
"""1024 sites with 256 points each settled in 38 to 110 sweeps, over 60 sets."""


def capacity_steps(capacity: int) -> tuple[int, int]:
    """Return the capacity to begin with, and the number of refinements, by four each, that lead to ``capacity``."""
    splits = 0
    while capacity % 4 == 0 and capacity // 4 >= _COARSEST:
        capacity //= 4
        splits += 1
    return capacity, splits


class CapacityConstrained(WholeSets):
    """Sites that own ``capacity`` background points each.

    Parameters
    ----------
    capacity
        Background points per site; 0: 256, or 1024 below 64 sites.
    bank
        Number of sets in the bank; 0 makes every realisation afresh.
    """

    def __init__(self, capacity: int, bank: int) -> None:
        super().__init__(f"ccvt capacity={capacity}", bank)
        self._capacity = capacity

    def make(self, sets: Array, realizations: Realizations) -> None:
        """Write whole sets; see :meth:`WholeSets.make`."""
        count = sets.shape[2]
        # The cells of few sites are large against the set, and so are the errors of a coarse background.
        capacity = self._capacity or (256 if count >= 64 else 1024)
        coarse, splits = capacity_steps(capacity)
        words = realizations.random_words(4 + splits)
        for r in range(len(realizations)):
            points = np.empty((2, count * coarse))
            scatter(points, words[r, 0])
            cut_open(points, words[r, 1])
            divide(points, count, words[r, 2])
            points -= np.floor(points)
            # A site may start at any of its own points.
            sites = np.ascontiguousarray(points[:, ::coarse])
            settle(sites, points, _MOST_SWEEPS)
            for k in range(splits):
                finer = np.empty((2, 4 * points.shape[1]))
                split(finer, points, k, words[r, 4 + k])
                points = finer
                settle(sites, points, _MOST_SWEEPS)
            finish(sets[r], sites, words[r, 3])
