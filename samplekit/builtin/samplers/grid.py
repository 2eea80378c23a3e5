"""Regular and jittered sampling: one point in each cell of a grid with near-equal sides.

Jittered: Cook, Porter, Carpenter 1984, "Distributed ray tracing".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.counts import grid_sides
from samplekit.errors import UsageError
from samplekit.numerics.kernel import kernel
from samplekit.sampling.hashing import dimension_key, hash_index, second_key
from samplekit.sampling.sampler import Sampler
from samplekit.sampling.stratification import offset_bits, place_in_cell

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations

_U64 = np.uint64


def _sides(count: int, dims: int) -> NDArray[np.int64]:
    sides = grid_sides(count, dims)
    if sides is None:
        raise UsageError(f"{count} points do not form a grid of near-equal sides in {dims} dimensions")
    return np.array(sides, np.int64)


def _cells(sides: NDArray[np.int64], start: int, points: int) -> NDArray[np.float64]:
    """The cell float64[D, points] of each point along each axis, the first axis fastest."""
    index = np.arange(start, start + points, dtype=np.int64)
    cells = np.empty((sides.size, points))
    for axis, side in enumerate(sides):
        cells[axis] = index % side
        index //= side
    return cells


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], float64[:,::1], int64)")
def _fill_jittered(
    out: NDArray[np.float64], keys: NDArray[np.uint64], sides: NDArray[np.int64], cells: NDArray[np.float64], start: int
) -> None:
    realizations, dims, points = out.shape
    for r in range(realizations):
        for d in range(dims):
            key = dimension_key(keys[r], d)
            second = second_key(key)
            bits = offset_bits(sides[d])
            shift = _U64(64 - bits)
            step = 2.0 ** (-bits)
            width = 1.0 / sides[d]
            row = out[r, d]
            cell = cells[d]
            for i in range(points):
                row[i] = place_in_cell(cell[i], hash_index(key, second, _U64(start + i)), shift, step, width)


class Regular(Sampler):
    """The centres of the cells of a grid, the same in every realisation."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _, dims, points = out.shape
        sides = _sides(count, dims)
        out[:] = (_cells(sides, start, points) + 0.5) / sides[:, None]


class Jittered(Sampler):
    """A uniform random place in each cell of a grid."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _, dims, points = out.shape
        sides = _sides(count, dims)
        _fill_jittered(out, realizations.keys, sides, _cells(sides, start, points), start)
