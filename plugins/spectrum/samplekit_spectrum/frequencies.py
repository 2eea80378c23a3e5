"""The frequencies at which a spectrum is computed: a cube of multiples of a step, or a list.

The spectrum of real strengths is symmetric, S(-m) = conj S(m), so only one half of a cube is kept. If the cube is
flattened in C order with the axes (..., y, x), the half begins at DC, and entry i of the half is the mirror image of
the element that lies i places before DC.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_BLOCK = 2**20


@dataclass(frozen=True)
class Cube:
    """All frequencies ``step * m`` with integer m, |m|_inf <= ``reach``, in ``dims`` dimensions.

    Attributes
    ----------
    dims, reach
        Number of dimensions, 1 to 3; the largest |m|_inf.
    step
        Distance of neighbouring frequencies. At 1 the spectrum is the one that determines the variance.
    """

    dims: int
    reach: int
    step: float = 1.0

    @property
    def side(self) -> int:
        """Number of frequencies along an axis."""
        return 2 * self.reach + 1

    @property
    def size(self) -> int:
        """Number of frequencies."""
        return int(self.side**self.dims)

    @property
    def row(self) -> int:
        """Number of frequencies that share one component along the first axis."""
        return self.size // self.side

    @property
    def half(self) -> int:
        """Number of frequencies that are kept, including DC."""
        return (self.size + 1) // 2

    def vectors(self, start: int, stop: int) -> NDArray[np.int64]:
        """Return m for the entries start to stop of the half: int64[stop - start, dims], x first."""
        components = np.unravel_index(np.arange(start, stop) + self.half - 1, (self.side,) * self.dims)
        return (np.stack(components[::-1]) - self.reach).T

    def values(self, start: int, stop: int) -> NDArray[np.float64]:
        """Return the frequencies step * m of the entries start to stop of the half: float64[stop - start, dims]."""
        return np.asarray(self.step * self.vectors(start, stop), np.float64)

    def rings(self) -> NDArray[np.int32]:
        """Return the ring of each entry of the half: k for k - 1/2 <= |m| < k + 1/2, and 0 for DC.

        The cube cuts the rings beyond the reach, so their entries are 0, too.
        """
        rings = np.empty(self.half, np.int32)
        for start in range(0, self.half, _BLOCK):
            vectors = self.vectors(start, min(start + _BLOCK, self.half)).astype(np.float64)
            ring = np.floor(np.sqrt((vectors * vectors).sum(axis=1)) + 0.5)
            rings[start : start + _BLOCK] = np.where(ring <= self.reach, ring, 0.0)
        return rings

    def full(self, half: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the whole cube [..., y, x] of a quantity that is the same at m and -m, from its half."""
        return np.concatenate([half[:0:-1], half]).reshape((self.side,) * self.dims)


@dataclass(frozen=True, eq=False)
class FrequencyList:
    """Arbitrary frequencies: float64[K, dims], of magnitude up to 2^40."""

    vectors: NDArray[np.float64]

    @property
    def dims(self) -> int:
        """Number of dimensions of a frequency."""
        return int(self.vectors.shape[1])

    @property
    def half(self) -> int:
        """Number of frequencies that are kept: all of them."""
        return int(self.vectors.shape[0])

    def values(self, start: int, stop: int) -> NDArray[np.float64]:
        """Return the frequencies start to stop: float64[stop - start, dims]."""
        return self.vectors[start:stop]

    def rings(self) -> NDArray[np.int32]:
        """Return zeros: listed frequencies lie on no ring."""
        return np.zeros(self.half, np.int32)

    def full(self, half: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return a copy: nothing is left out of ``half``."""
        return half.copy()


Frequencies = Cube | FrequencyList
