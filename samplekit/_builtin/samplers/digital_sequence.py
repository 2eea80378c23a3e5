"""Digital sequences in base 2, scrambled or not: a table of 1024 points, and one exclusive or for each later point.

The digits of a point are linear in the digits of its index (Niederreiter 1987): where i and j have no bit in common,
the coordinates of point i + j are those of point i exclusive-ored with those of point j.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
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

Array = NDArray[np.float64]
Fill = Callable[[Array, Realizations, int, int], None]

_U32 = np.uint32
_U64 = np.uint64
_TABLE = 1024
"""Largest number of points of a table: a few tables fit into the fastest cache."""


@helper
def _reversed_table(columns: NDArray[np.uint32], points: int) -> NDArray[np.uint32]:
    """Return the first points of each dimension, with digit 1 in bit 0: uint32[D, size].

    The size is a power of two, at least ``points`` or 1024. ``columns`` uint32[D, 32] as :func:`net_coordinates` takes
    them.
    """
    dims = columns.shape[0]
    size = 1
    while size < min(points, _TABLE):
        size *= 2
    table = np.empty((dims, size), np.uint32)
    for d in range(dims):
        net_coordinates(table[d], columns[d], 0)
        for i in range(size):
            table[d, i] = reverse_bits32(table[d, i])
    return table


@helper
def write_scrambled(
    row: Array, digits: NDArray[np.uint32], origin: np.uint32, beyond: np.uint32, key: np.uint64
) -> None:
    """Write coordinates under Owen's scrambling.

    Their first 32 digits are ``digits`` exclusive-ored with ``origin``, those after them are ``beyond``. Of each the
    first digit is in bit 0.
    """
    addend = owen_addend(key)
    factor = owen_factor(key)
    tail = tail_value(_U64(reverse_bits32(beyond) >> _U32(11)) ^ owen_tail(key))
    for i in range(row.size):
        row[i] = np.float64(scramble_reversed(_U32(digits[i] ^ origin), addend, factor)) * TWO_M32 + tail


@kernel("void(float64[:,:,::1], uint64[::1], uint32[:,::1], int64, boolean)")
def _fill(out: Array, keys: NDArray[np.uint64], columns: NDArray[np.uint32], start: int, scrambled: bool) -> None:
    """Write the points start, start + 1, ...: of every realisation if ``scrambled``, else of the first."""
    realizations, dims, points = out.shape
    table = _reversed_table(columns, points)
    size = table.shape[1]
    origin = np.empty(1, np.uint32)
    first = 0
    while first < points:
        offset = (start + first) % size
        run = min(size - offset, points - first)
        for d in range(dims):
            net_coordinates(origin, columns[d], start + first - offset)
            reversed_origin = reverse_bits32(origin[0])
            coordinates = table[d, offset : offset + run]
            if scrambled:
                for r in range(realizations):
                    row = out[r, d, first : first + run]
                    write_scrambled(row, coordinates, reversed_origin, _U32(0), owen_key(keys[r], d))
            else:
                row = out[0, d, first : first + run]
                for i in range(run):
                    row[i] = np.float64(reverse_bits32(_U32(coordinates[i] ^ reversed_origin))) * TWO_M32
        first += run


class DigitalSequence(Sampler):
    """Base of the digital sequences in base 2, which differ in their generator matrices."""

    def columns(self, dims: int) -> NDArray[np.uint32]:
        """Return the columns of the generator matrices, uint32[dims, 32]: column j for bit j, digit 1 its top bit."""
        raise NotImplementedError(f"{type(self).__name__} defines no columns")

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, realizations.keys, self.columns(out.shape[1]), start, False)
        out[1:] = out[0]

    def fused(self, randomizer: str) -> Fill | None:
        """Return the fill that applies Owen's scrambling to the integer coordinates."""
        return self._fill_owen if randomizer == "owen" else None

    def _fill_owen(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        _fill(out, realizations.keys, self.columns(out.shape[1]), start, True)
