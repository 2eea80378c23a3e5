"""Mutants that write values they must not, or not where they must."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import Mutant, per_key
from samplekit import Sampler

if TYPE_CHECKING:
    from mutants.mutant import Array
    from samplekit import Realizations


class RareOnes(Mutant):
    """Returns 1.0 about once in a hundred thousand draws."""

    base, caught_by = "random", "range"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[out > 1.0 - 1e-5] = 1.0


class NaiveJitter(Mutant):
    """Jitters with (i + r) / n, which rounds to 1.0 when r is near 1: not once in ten billion random draws."""

    base, caught_by = "latin-hypercube", "range"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count, start)
        r = per_key(realizations, out.shape[1])[:, :, None]
        out[:] = (np.floor(out * count) + r) / count


class NaiveDraw(Mutant):
    """The same through the slow door, with NumPy's generator."""

    base, caught_by = "latin-hypercube", "range"
    fill = Sampler.fill

    def draw(self, count: int, dims: int, rng: np.random.Generator) -> Array:
        """Jitters a random permutation of the intervals."""
        cells = np.stack([rng.permutation(count) for _ in range(dims)], axis=1)
        drawn: Array = (cells + rng.random((count, dims))) / count
        return drawn


class RareNegatives(Mutant):
    """Returns small negative numbers in rare draws, as a shift without a wrap does."""

    base, caught_by = "random", "range"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[out < 1e-5] *= -1.0


class LeavesOneUnwritten(Mutant):
    """Leaves the last value of sets of seven points unwritten."""

    base, caught_by = "random", "shape"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count == 7 and start + out.shape[2] == count:
            out[:, -1, -1] = np.nan


class WritesPastTheEnd(Mutant):
    """Writes one set more than there is room for."""

    base, caught_by = "random", "shape"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        owner = out.base
        # Only where the memory behind it is known to be there.
        if isinstance(owner, np.ndarray) and owner.ndim == 3 and owner.shape[0] > out.shape[0] + 1:
            np.lib.stride_tricks.as_strided(out, (out.shape[0] + 1, *out.shape[1:]), out.strides)[-1] = 0.5
