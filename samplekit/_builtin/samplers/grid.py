"""Points in the cells of grids with near-equal sides: regular, jittered, and jittered in blocks of dimensions.

Cook, Porter, Carpenter 1984, "Distributed ray tracing": pixel, lens and time are stratified each on its own, for a grid
over all dimensions would need too many samples. Sample i takes cell i of the pixel, and cells of the lens and of the
time from random permutations, so that no part of the lens belongs to a part of the pixel.
"""

from __future__ import annotations

from itertools import accumulate
from operator import mul

import numpy as np
from numpy.typing import NDArray

from samplekit import Products, Realizations, Sampler, UsageError, grid_sides
from samplekit.kernels import (
    SHUFFLED,
    cell_along_axis,
    dimension_key,
    hash_index,
    kernel,
    mix64,
    offset_bits,
    permutation_bits,
    permute_range,
    place_in_cell,
    second_key,
    shuffle,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_ORDER = _U64(0xA54FF53A5F1D36F1)
_FARTHEST = 100_000
"""Number of counts that are tried below and above a count to find one that fits."""


def _lay_out(count: int, sizes: list[int]) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Lay out the grids of ``count`` cells of blocks with the given numbers of dimensions.

    Returns
    -------
    For each dimension, int64[D] each: the first dimension of its block, the number of cells along it, and the number of
    cells in the axes of the block before it. The first axis is the fastest.
    """
    block: list[int] = []
    sides: list[int] = []
    strides: list[int] = []
    for size in sizes:
        grid = grid_sides(count, size)
        if grid is None:
            raise UsageError(f"{count} points do not form a grid of near-equal sides in {size} dimensions")
        block += [len(block)] * size
        sides += grid
        strides += accumulate(grid[:-1], mul, initial=1)
    return np.array(block), np.array(sides), np.array(strides)


@kernel("void(float64[:,::1], int64[::1], int64[::1], int64)")
def _fill_regular(out: Array, sides: NDArray[np.int64], strides: NDArray[np.int64], start: int) -> None:
    dims, points = out.shape
    for d in range(dims):
        side = np.float64(sides[d])
        width = 1.0 / side
        per_row = 1.0 / np.float64(strides[d])
        for i in range(points):
            out[d, i] = (cell_along_axis(np.float64(start + i), per_row, side, width) + 0.5) / side


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], int64[::1], int64[::1], int64, int64)")
def _fill_jittered(
    out: Array,
    keys: NDArray[np.uint64],
    block: NDArray[np.int64],
    sides: NDArray[np.int64],
    strides: NDArray[np.int64],
    count: int,
    start: int,
) -> None:
    """Write points start, start + 1, ... of ``count``: one in each cell of every block's grid.

    ``block``, ``sides``, ``strides``: as :func:`_lay_out` returns them. The first block keeps its order, which is as
    random as any while the order of all others is permuted.
    """
    realizations, dims, points = out.shape
    place = np.empty(max(points, min(count, SHUFFLED)), np.int64)
    order = np.empty(points, np.float64)
    index_bits = permutation_bits(count)
    for r in range(realizations):
        for d in range(dims):
            key = dimension_key(keys[r], d)
            second = second_key(key)
            if block[d] == d:
                order_key = mix64(key ^ _ORDER)
                first = 0
                if d == 0:
                    for i in range(points):
                        place[i] = start + i
                elif count <= SHUFFLED:
                    shuffle(place, count, order_key)
                    first = start
                else:
                    permute_range(place[:points], start, count, index_bits, order_key)
                for i in range(points):
                    order[i] = np.float64(place[first + i])
            bits = offset_bits(sides[d])
            shift = _U64(64 - bits)
            step = 2.0 ** (-bits)
            side = np.float64(sides[d])
            width = 1.0 / side
            per_row = 1.0 / np.float64(strides[d])
            row = out[r, d]
            for i in range(points):
                cell = cell_along_axis(order[i], per_row, side, width)
                row[i] = place_in_cell(cell, hash_index(key, second, _U64(start + i)), shift, step, width)


class Regular(Sampler):
    """The centres of the cells of a grid, the same in every realisation."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _, sides, strides = _lay_out(count, [out.shape[1]])
        _fill_regular(out[0], sides, strides, start)
        out[1:] = out[0]


class Jittered(Sampler):
    """A uniform random place in each cell of a grid."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill_jittered(out, realizations.keys, *_lay_out(count, [out.shape[1]]), count, start)


def block_sizes(dims: int, blocks: tuple[int, ...]) -> list[int]:
    """Return the sizes of the blocks that ``dims`` dimensions form: those given, cut or continued by pairs to fit."""
    sizes: list[int] = []
    for size in (*blocks, *(2 for _ in range(dims))):
        left = dims - sum(sizes)
        if left > 0:
            sizes.append(min(size, left))
    return sizes


def _form_grids(count: int, sizes: set[int]) -> bool:
    return all(grid_sides(count, size) is not None for size in sizes)


class UncorrelatedJitter(Sampler):
    """Blocks of dimensions, each jittered on a grid of its own, combined in random order.

    The blocks are those that the scene declares, such as (2, 2, 1). Where nothing is known of them they are pairs of
    dimensions, and a last odd dimension alone. The points of the first block do not depend on the other blocks: in two
    dimensions this is the sampler ``jittered``.
    """

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """Raise unless the points form a grid in every block.

        Raises
        ------
        UsageError
            A block of three dimensions or more has no such grid: names the nearest counts for which all blocks have.
        """
        sizes = set(block_sizes(dims, blocks)) | {2}
        if _form_grids(count, sizes):
            return
        size = max(size for size in sizes if grid_sides(count, size) is None)
        below = next((n for n in range(count - 1, max(count - _FARTHEST, 0), -1) if _form_grids(n, sizes)), None)
        above = next((n for n in range(count + 1, count + _FARTHEST) if _form_grids(n, sizes)), None)
        nearest = " and ".join(str(n) for n in (below, above) if n is not None) or "far away"
        raise UsageError(
            f"uncorrelated-jitter makes {Products(size).describe()} for a block of {size} dimensions,"
            f" not {count}: the nearest for blocks of {', '.join(map(str, sorted(sizes)))} are {nearest}"
        )

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        sizes = block_sizes(out.shape[1], realizations.blocks)
        _fill_jittered(out, realizations.keys, *_lay_out(count, sizes), count, start)
