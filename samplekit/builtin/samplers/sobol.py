"""Sobol's sequence with the direction numbers of Joe and Kuo 2008, in the natural order of the index."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import kernel, reverse_bits32
from samplekit.sampling.digital_net import BITS, net_coordinates
from samplekit.sampling.hashing import TWO_M32
from samplekit.sampling.owen import owen_addend, owen_factor, owen_key, owen_tail, scramble_reversed, tail_value
from samplekit.sampling.sampler import Sampler

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations
    from samplekit.sampling.sampler import Fill

_U32 = np.uint32


@cache
def direction_numbers(dims: int) -> NDArray[np.uint32]:
    """Columns uint32[dims, 32] of the generator matrices (Joe and Kuo 2008, section 2: recurrence (2))."""
    with resources.files("samplekit.builtin.samplers").joinpath("data/joe_kuo.npz").open("rb") as file:
        archive = np.load(file, allow_pickle=False)
        polynomials, initial = archive["polynomials"][:dims], archive["initial"]
    columns = np.empty((dims, BITS), np.uint64)
    columns[0] = 1
    position = 1
    for dimension in range(1, dims):
        polynomial = int(polynomials[dimension])
        degree = polynomial.bit_length() - 1
        odd = [int(m) for m in initial[position : position + degree]]
        position += degree
        for k in range(degree, BITS):
            m = odd[k - degree] ^ (odd[k - degree] << degree)
            for i in range(1, degree):
                if polynomial >> (degree - i) & 1:
                    m ^= odd[k - i] << i
            odd.append(m)
        columns[dimension] = odd
    return (columns << np.arange(BITS - 1, -1, -1, dtype=np.uint64)).astype(np.uint32)


@kernel("void(float64[:,:,::1], uint32[:,::1], int64)")
def _fill(out: NDArray[np.float64], columns: NDArray[np.uint32], start: int) -> None:
    _, dims, points = out.shape
    coordinates = np.empty(points, np.uint32)
    for d in range(dims):
        net_coordinates(coordinates, columns[d], start)
        row = out[0, d]
        for i in range(points):
            row[i] = np.float64(coordinates[i]) * TWO_M32


@kernel("void(float64[:,:,::1], uint64[::1], uint32[:,::1], int64)")
def _fill_owen(out: NDArray[np.float64], keys: NDArray[np.uint64], columns: NDArray[np.uint32], start: int) -> None:
    realizations, dims, points = out.shape
    coordinates = np.empty((dims, points), np.uint32)
    for d in range(dims):
        net_coordinates(coordinates[d], columns[d], start)
        for i in range(points):
            coordinates[d, i] = reverse_bits32(coordinates[d, i])
    for r in range(realizations):
        for d in range(dims):
            key = owen_key(keys[r], d)
            addend = owen_addend(key)
            factor = owen_factor(key)
            tail = tail_value(owen_tail(key))
            row = out[r, d]
            coordinate = coordinates[d]
            for i in range(points):
                row[i] = np.float64(scramble_reversed(_U32(coordinate[i]), addend, factor)) * TWO_M32 + tail


class Sobol(Sampler):
    """Point i from the bits of i, in up to 4096 dimensions."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, direction_numbers(out.shape[1]), start)
        out[1:] = out[0]

    def fused(self, randomizer: str) -> Fill | None:
        """Owen's scrambling on the integer coordinates."""
        return self._fill_owen if randomizer == "owen" else None

    def _fill_owen(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        _fill_owen(out, realizations.keys, direction_numbers(out.shape[1]), start)
