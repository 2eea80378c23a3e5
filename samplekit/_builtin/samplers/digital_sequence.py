"""Digital sequences in base 2, scrambled or not: a table of 1024 points, and one exclusive or for each later point.

The coordinates of i + j are those of i exclusive-ored with those of j where i and j have no bit in common: the digits
of a point are linear in the digits of its index (Niederreiter 1987).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler
from samplekit.kernels import (
    TWO_M32,
    helper,
    kernel,
    net_coordinates,
    owen_addend,
    owen_factor,
    owen_key,
    owen_tail,
    reverse_bits32,
    scramble_reversed,
    tail_value,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit import Realizations

    Fill = Callable[[NDArray[np.float64], Realizations, int, int], None]

_U32 = np.uint32
TABLE = 1024
"""Points of the table, at most: a few of them fit into the fastest cache."""


@helper
def reversed_table(columns: NDArray[np.uint32], points: int) -> NDArray[np.uint32]:
    """The first points of each dimension, at least ``points`` or 1024 and a power of two, with digit 1 in bit 0.

    ``columns`` uint32[D, 32] as :func:`net_coordinates` takes them.
    """
    dims = columns.shape[0]
    size = 1
    while size < min(points, TABLE):
        size *= 2
    table = np.empty((dims, size), np.uint32)
    for d in range(dims):
        net_coordinates(table[d], columns[d], 0)
        for i in range(size):
            table[d, i] = reverse_bits32(table[d, i])
    return table


@helper
def reversed_coordinate(columns: NDArray[np.uint32], index: int) -> np.uint32:
    """One coordinate of one point, with digit 1 in bit 0; ``columns`` uint32[32]."""
    word = _U32(0)
    bit = 0
    while index > 0:
        if index & 1:
            word ^= columns[bit]
        index >>= 1
        bit += 1
    return reverse_bits32(word)


@kernel("void(float64[:,:,::1], uint32[:,::1], int64)")
def fill_sequence(out: NDArray[np.float64], columns: NDArray[np.uint32], start: int) -> None:
    """Write the points start, start + 1, ... into the first realisation."""
    _, dims, points = out.shape
    table = reversed_table(columns, points)
    size = table.shape[1]
    first = 0
    while first < points:
        offset = (start + first) % size
        run = min(size - offset, points - first)
        for d in range(dims):
            origin = reversed_coordinate(columns[d], start + first - offset)
            row = out[0, d, first : first + run]
            coordinates = table[d, offset : offset + run]
            for i in range(run):
                row[i] = np.float64(reverse_bits32(_U32(coordinates[i] ^ origin))) * TWO_M32
        first += run


@kernel("void(float64[:,:,::1], uint64[::1], uint32[:,::1], int64)")
def fill_scrambled_sequence(
    out: NDArray[np.float64], keys: NDArray[np.uint64], columns: NDArray[np.uint32], start: int
) -> None:
    """Write the points start, start + 1, ... of every realisation under Owen's scrambling."""
    realizations, dims, points = out.shape
    table = reversed_table(columns, points)
    size = table.shape[1]
    first = 0
    while first < points:
        offset = (start + first) % size
        run = min(size - offset, points - first)
        for d in range(dims):
            origin = reversed_coordinate(columns[d], start + first - offset)
            coordinates = table[d, offset : offset + run]
            for r in range(realizations):
                key = owen_key(keys[r], d)
                addend = owen_addend(key)
                factor = owen_factor(key)
                tail = tail_value(owen_tail(key))
                row = out[r, d, first : first + run]
                for i in range(run):
                    x = _U32(coordinates[i] ^ origin)
                    row[i] = np.float64(scramble_reversed(x, addend, factor)) * TWO_M32 + tail
        first += run


class DigitalSequence(Sampler):
    """Base of the digital sequences in base 2: they differ in the columns of their matrices."""

    def columns(self, dims: int) -> NDArray[np.uint32]:
        """Columns uint32[dims, 32] of the generator matrices: column j for bit j of the index, digit 1 its top bit."""
        raise NotImplementedError(f"{type(self).__name__} defines no columns")

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        fill_sequence(out, self.columns(out.shape[1]), start)
        out[1:] = out[0]

    def fused(self, randomizer: str) -> Fill | None:
        """Owen's scrambling on the integer coordinates."""
        return self._fill_owen if randomizer == "owen" else None

    def _fill_owen(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        fill_scrambled_sequence(out, realizations.keys, self.columns(out.shape[1]), start)
