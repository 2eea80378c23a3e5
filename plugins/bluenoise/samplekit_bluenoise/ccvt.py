"""Capacity-constrained Voronoi tessellations: every site owns as many points of a background, and is their centroid.

Balzer, Schlömer, Deussen 2009, "Capacity-constrained point distributions: a variant of Lloyd's method". Three things
differ from the paper:

- the background is jittered, where random points leave a floor of 1 / capacity in N P at low frequencies;
- the first assignment is a division along lines that favour no direction, and leave no lattice behind;
- the background is refined in steps: sites settle with a few points each, every point is then replaced by one in each
  quarter of its stratum, and they settle again. Capacities stay equal, and the long way is gone with few points.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit_bluenoise.bank import WholeSets
from samplekit_bluenoise.strata import scatter, split
from samplekit_bluenoise.swaps import settle
from samplekit_bluenoise.territories import cut_open, divide
from samplekit_bluenoise.torus import finish

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_COARSEST = 8
"""The least points of a site that sites settle with."""
_MOST_SWEEPS = 200
"""At 1024 sites with 256 points each they settle in about 60."""


def steps_of_capacity(capacity: int) -> tuple[int, int]:
    """The capacity to begin with and the number of refinements, by four each, that lead to ``capacity``."""
    splits = 0
    while capacity % 4 == 0 and capacity // 4 >= _COARSEST:
        capacity //= 4
        splits += 1
    return capacity, splits


class CapacityConstrained(WholeSets):
    """Sites that own ``capacity`` background points each; 0 chooses by the count."""

    def __init__(self, capacity: int, bank: int) -> None:
        super().__init__(f"ccvt capacity={capacity}", bank)
        self._capacity = capacity

    def make(self, sets: NDArray[np.float64], realizations: Realizations) -> None:
        """Write whole sets; see :meth:`WholeSets.make`."""
        count = sets.shape[2]
        # Of few sites the cells are large against the set, and so is what a coarse background does to them.
        capacity = self._capacity or (256 if count >= 64 else 1024)
        coarse, splits = steps_of_capacity(capacity)
        words = realizations.random_words(4 + splits)
        for r in range(len(realizations)):
            points = np.empty((2, count * coarse))
            scatter(points, words[r, 0])
            cut_open(points, words[r, 1])
            divide(points, count, words[r, 2])
            points -= np.floor(points)
            # Any point of a site's own will do for a start.
            sites = np.ascontiguousarray(points[:, ::coarse])
            settle(sites, points, _MOST_SWEEPS)
            for k in range(splits):
                finer = np.empty((2, 4 * points.shape[1]))
                split(finer, points, k, words[r, 4 + k])
                points = finer
                settle(sites, points, _MOST_SWEEPS)
            finish(sets[r], sites, words[r, 3])
