"""Regular and jittered sampling: one point in each cell of a grid with near-equal sides.

Jittered: Cook, Porter, Carpenter 1984, "Distributed ray tracing".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler, UsageError, grid_sides
from samplekit._builtin.samplers.jittered_blocks import fill_jittered_blocks
from samplekit.kernels import cell_along_axis, kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations


def _grid(count: int, dims: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The cells along each axis, and the cells of the axes before it: the first axis is the fastest."""
    sides = grid_sides(count, dims)
    if sides is None:
        raise UsageError(f"{count} points do not form a grid of near-equal sides in {dims} dimensions")
    return np.array(sides, np.int64), np.cumprod([1, *sides[:-1]], dtype=np.int64)


@kernel("void(float64[:,::1], int64[::1], int64[::1], int64)")
def _fill_regular(out: NDArray[np.float64], sides: NDArray[np.int64], strides: NDArray[np.int64], start: int) -> None:
    dims, points = out.shape
    for d in range(dims):
        side = np.float64(sides[d])
        width = 1.0 / side
        per_row = 1.0 / np.float64(strides[d])
        for i in range(points):
            out[d, i] = (cell_along_axis(np.float64(start + i), per_row, side, width) + 0.5) / side


class Regular(Sampler):
    """The centres of the cells of a grid, the same in every realisation."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        sides, strides = _grid(count, out.shape[1])
        _fill_regular(out[0], sides, strides, start)
        out[1:] = out[0]


class Jittered(Sampler):
    """A uniform random place in each cell of a grid."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        sides, strides = _grid(count, out.shape[1])
        one_block = np.zeros(out.shape[1], np.int64)
        fill_jittered_blocks(out, realizations.keys, one_block, sides, strides, count, start)
