"""Which frequencies a spectrum is taken at: a cube of multiples of a step, or a list.

A spectrum of real strengths is symmetric, S(-m) = conj S(m), so that of a cube only a half is kept: flattened in C
order with the axes (..., y, x), index 0 is DC and the mirror image of the half's entry i lies i places before DC.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Cube:
    """All frequencies ``step * m`` with integer m, |m|_inf <= ``reach``, in ``dims`` dimensions.

    Attributes
    ----------
    dims, reach
        Dimensions, 1 to 3; the largest |m|_inf.
    step
        Distance of neighbouring frequencies. At 1 the spectrum is the one that variance depends on.
    """

    dims: int
    reach: int
    step: float = 1.0

    @property
    def side(self) -> int:
        """Number of frequencies along an axis."""
        return 2 * self.reach + 1

    @property
    def row(self) -> int:
        """Number of frequencies for each one of the first axis."""
        return int(self.side ** (self.dims - 1))

    @property
    def half(self) -> int:
        """Number of frequencies that are kept, DC among them."""
        return (self.side * self.row + 1) // 2

    @property
    def first(self) -> int:
        """Place of DC within the middle one of the first axis."""
        return (self.row - 1) // 2

    def squared_radii(self, start: int, stop: int) -> NDArray[np.int64]:
        """|m|^2 of the half's entries start to stop, int64."""
        index = np.arange(start + self.first, stop + self.first, dtype=np.int64)
        total = np.zeros(index.size, np.int64)
        for axis in range(self.dims):
            index, component = np.divmod(index, self.side) if axis < self.dims - 1 else (index, index)
            offset = component - self.reach if axis < self.dims - 1 else component
            total += offset * offset
        return total

    def vectors(self, start: int, stop: int) -> NDArray[np.int64]:
        """M of the half's entries start to stop, x first: int64[stop - start, dims]."""
        index = np.arange(start + self.first, stop + self.first, dtype=np.int64)
        components = []
        for _ in range(self.dims - 1):
            index, component = np.divmod(index, self.side)
            components.append(component - self.reach)
        return np.stack([*components, index], axis=1)

    def rings(self) -> NDArray[np.int32]:
        """The ring of each entry of the half: k for k - 1/2 <= |m| < k + 1/2; 0 for DC and beyond the reach.

        A ring beyond the reach would be cut by the cube: it is left out.
        """
        rings = np.empty(self.half, np.int32)
        block = 1 << 20
        for start in range(0, self.half, block):
            stop = min(start + block, self.half)
            ring = np.floor(np.sqrt(self.squared_radii(start, stop).astype(np.float64)) + 0.5)
            rings[start:stop] = np.where(ring <= self.reach, ring, 0.0)
        return rings

    def full(self, half: NDArray[np.float64]) -> NDArray[np.float64]:
        """The whole cube [..., y, x] of a quantity that m and -m share, from its half."""
        return np.concatenate([half[:0:-1], half]).reshape((self.side,) * self.dims)


@dataclass(frozen=True, eq=False)
class Listed:
    """Any frequencies: float64[K, dims], of magnitude up to 2^40."""

    vectors: NDArray[np.float64]

    @property
    def dims(self) -> int:
        """Dimensions of a frequency."""
        return int(self.vectors.shape[1])

    @property
    def half(self) -> int:
        """Number of frequencies."""
        return int(self.vectors.shape[0])

    def rings(self) -> NDArray[np.int32]:
        """None of them is on a ring."""
        return np.zeros(self.half, np.int32)


Frequencies = Cube | Listed
