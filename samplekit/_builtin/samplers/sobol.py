"""Sobol's sequence with the direction numbers of Joe and Kuo 2008, in the natural order of the index."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

import numpy as np

from samplekit._builtin.samplers.digital_sequence import DigitalSequence
from samplekit.kernels import BITS

if TYPE_CHECKING:
    from numpy.typing import NDArray


@cache
def direction_numbers(dims: int) -> NDArray[np.uint32]:
    """Return the columns of the generator matrices, uint32[dims, 32] (Joe and Kuo 2008, recurrence (2))."""
    with resources.files("samplekit._builtin.samplers").joinpath("data/joe_kuo.npz").open("rb") as file:
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


class Sobol(DigitalSequence):
    """Sobol's sequence in up to 4096 dimensions."""

    def columns(self, dims: int) -> NDArray[np.uint32]:
        """Return the direction numbers of the first ``dims`` dimensions: see :class:`DigitalSequence`."""
        return direction_numbers(dims)
