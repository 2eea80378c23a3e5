"""A digital sequence of a few dimensions, scrambled and repeated for any number of dimensions ("padding").

Each block of dimensions is the same sequence under an Owen scrambling of its own, visited in an order of its own: the
index, taken as a binary fraction, is Owen-scrambled as well (Burley 2020, "Practical hash-based Owen scrambling",
section 4). Such a shuffle takes every aligned block of 2^m indices to an aligned block of 2^m indices, so each prefix
of 2^m points, and each later aligned block, remains the net that the sequence has there.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper, kernel, reverse_bits32
from samplekit.kernels._digital_net import BITS
from samplekit.kernels._hashing import TWO_M32, dimension_key, mix64
from samplekit.kernels._owen import owen_addend, owen_factor, owen_key, owen_tail, scramble_reversed, tail_value

_U32 = np.uint32
_U64 = np.uint64
_SHUFFLE = _U64(0x629A292A367CD507)
_SCRAMBLE = _U64(0x9159015A3070DD17)
_GROUP = 11
"""Bits of the index that one table covers."""
GROUP_SIZE = 1 << _GROUP
"""Number of entries of a table: one for each value of 11 bits of the index."""


def group_tables(columns: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Return the digits that each group of 11 bits of the index adds, uint32[D, 3, 2048], with digit 1 in bit 0.

    ``columns`` uint32[D, 32]: as :func:`samplekit.kernels.net_coordinates` takes them.
    """
    mirrored = np.zeros_like(columns)
    for bit in range(BITS):
        mirrored |= ((columns >> _U32(bit)) & _U32(1)) << _U32(BITS - 1 - bit)
    tables = np.zeros((len(columns), 3, GROUP_SIZE), np.uint32)
    for group in range(3):
        for bit in range(min(_GROUP, BITS - group * _GROUP)):
            half = 1 << bit
            tables[:, group, half : 2 * half] = tables[:, group, :half] ^ mirrored[:, group * _GROUP + bit, None]
    return tables


@helper
def shuffle_key(key: np.uint64, dimension: int) -> np.uint64:
    """The key of the order in which the block of dimensions that begins with ``dimension`` is visited."""
    return mix64(dimension_key(key, dimension) ^ _SHUFFLE)


@helper
def shuffled_index(index: int, addend: np.uint32, factor: np.uint32) -> np.uint32:
    """The index, Owen-scrambled as a binary fraction of 32 digits."""
    return scramble_reversed(reverse_bits32(_U32(index)), addend, factor)


@kernel("void(float64[:,:,::1], uint64[::1], uint32[:,:,::1], int64, int64)")
def fill_padded(
    out: NDArray[np.float64],
    keys: NDArray[np.uint64],
    tables: NDArray[np.uint32],
    start: int,
    unshuffled: int,
) -> None:
    """Write the points start, start + 1, ...; the first ``unshuffled`` dimensions keep the order of the index.

    ``tables`` comes from :func:`group_tables`; its number of dimensions is that of a block.
    """
    realizations, dims, points = out.shape
    block = tables.shape[0]
    order = np.empty(GROUP_SIZE, np.uint32)
    gathered = np.empty(GROUP_SIZE, np.uint32)
    first = 0
    while first < points:
        offset = (start + first) % GROUP_SIZE
        run = min(GROUP_SIZE - offset, points - first)
        for r in range(realizations):
            # A key of its own: the randomizer ``owen`` scrambles these points once more, and the hashes must differ.
            own = mix64(keys[r] ^ _SCRAMBLE)
            upper = np.int64((start + first) >> _GROUP)
            for d in range(dims):
                s = d % block
                if s == 0 and d >= unshuffled:
                    key = shuffle_key(own, d)
                    addend = owen_addend(key)
                    factor = owen_factor(key)
                    for i in range(run):
                        order[i] = shuffled_index(start + first + i, addend, factor)
                    # A shuffle gives all indices of an aligned block the same upper bits.
                    upper = np.int64(order[0]) >> _GROUP
                beyond = _U32(tables[s, 1, upper & (GROUP_SIZE - 1)] ^ tables[s, 2, upper >> _GROUP])
                coordinates = tables[s, 0, offset : offset + run]
                if d >= unshuffled:
                    for i in range(run):
                        gathered[i] = tables[s, 0, order[i] & _U32(GROUP_SIZE - 1)]
                    coordinates = gathered[:run]
                key = owen_key(own, d)
                addend = owen_addend(key)
                factor = owen_factor(key)
                tail = tail_value(owen_tail(key))
                row = out[r, d, first : first + run]
                for i in range(run):
                    x = _U32(coordinates[i] ^ beyond)
                    row[i] = np.float64(scramble_reversed(x, addend, factor)) * TWO_M32 + tail
        first += run
