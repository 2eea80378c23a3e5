"""Jittered blocks of dimensions: a random place in each cell of every block's grid, the blocks combined at random.

Cook, Porter, Carpenter 1984, "Distributed ray tracing". Block 0 keeps its order, which is as random as any while all
others are permuted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

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

if TYPE_CHECKING:
    from numpy.typing import NDArray

_U64 = np.uint64
_ORDER = _U64(0xA54FF53A5F1D36F1)


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], int64[::1], int64[::1], int64, int64)")
def fill_jittered_blocks(
    out: NDArray[np.float64],
    keys: NDArray[np.uint64],
    block: NDArray[np.int64],
    sides: NDArray[np.int64],
    strides: NDArray[np.int64],
    count: int,
    start: int,
) -> None:
    """Write points start, start + 1, ...: one of ``count`` in each cell of every block's grid.

    ``block``, ``sides``, ``strides`` int64[D]: the first dimension of a dimension's block, its cells, and the cells of
    the axes of the block before it.
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
