"""Lloyd's relaxation: in each step every point moves to the centroid of its Voronoi cell.

Lloyd 1982, "Least squares quantization in PCM"; McCool, Fiume 1992, "Hierarchical Poisson disk sampling
distributions", brought it to sampling. The initial points show for many steps, since an uneven density levels out only
as fast as heat spreads: random points keep their clumps for some N / 10 steps, and jittered points fall back onto the
square lattice of their strata. Poisson disks have neither clumps nor a lattice: after 10 steps from them N P has a ring
of 3.2 and a trough of 0.3 behind it (N = 256), the same in all directions. After hundreds of steps points crystallise
into hexagons and alias.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations
from samplekit_bluenoise import DEFAULT_RADIUS
from samplekit_bluenoise.bank import WholeSets
from samplekit_bluenoise.darts import throw_darts
from samplekit_bluenoise.strata import scatter
from samplekit_bluenoise.torus import finish, packing_distance
from samplekit_bluenoise.voronoi import relax

Array = NDArray[np.float64]


class Lloyd(WholeSets):
    """``steps`` of relaxation from Poisson-disk, jittered or random points.

    Parameters
    ----------
    steps
        Number of steps.
    initial
        The points before the first step: ``poisson-disk``, ``jittered`` or ``random``.
    bank
        Number of sets in the bank; 0 makes every realisation afresh.
    """

    def __init__(self, steps: int, initial: str, bank: int) -> None:
        super().__init__(f"lloyd steps={steps} initial={initial}", bank)
        self._steps = steps
        self._initial = initial

    def make(self, sets: Array, realizations: Realizations) -> None:
        """Write whole sets; see :meth:`WholeSets.make`."""
        count = sets.shape[2]
        if self._initial == "jittered":
            words = realizations.random_words(2)
            points = np.empty((2, count))
            for r in range(len(realizations)):
                scatter(points, words[r, 0])
                finish(sets[r], points, words[r, 1])
        else:
            # Random points are disks of radius 0.
            radius = DEFAULT_RADIUS if self._initial == "poisson-disk" else 0.0
            throw_darts(sets, realizations.keys, radius * packing_distance(count))
        relax(sets, self._steps)
