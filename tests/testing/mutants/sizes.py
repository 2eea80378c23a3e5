"""Mutants that are broken at some sizes, at large indices, in rare sets or after many calls."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import Mutant, indices, per_key

if TYPE_CHECKING:
    from mutants.mutant import Array
    from samplekit import Realizations


class _LosesStrata(Mutant):
    """Draws the first coordinate at random where ``lost`` says so."""

    base, caught_by = "latin-hypercube", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if self.lost(count):
            out[:, 0] = out[:, 0] * 7.0 % 1.0

    def lost(self, count: int) -> bool:
        """Tell at which counts strata are lost."""
        raise NotImplementedError


class LatinUpTo4096(_LosesStrata):
    """Loses its strata from 4097 points on."""

    def lost(self, count: int) -> bool:
        return count > 4096


class LatinUpTo8191(_LosesStrata):
    """Loses its strata from 8192 points on."""

    def lost(self, count: int) -> bool:
        return count >= 8192


class LatinUpTo65536(_LosesStrata):
    """Loses its strata from 65537 points on."""

    def lost(self, count: int) -> bool:
        return count > 2**16


class LatinUpTo500000(_LosesStrata):
    """Loses its strata from half a million points on."""

    def lost(self, count: int) -> bool:
        return count > 500_000


class LatinLostNow(Mutant):
    """Loses its strata in one set of a hundred."""

    base, caught_by = "latin-hypercube", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        rare = per_key(realizations)[:, 0] < 0.01
        out[rare, 0] = out[rare, 0] * 7.0 % 1.0


class NetLostNow(Mutant):
    """Loses its net in one set of a hundred."""

    base, caught_by = "sobol+owen", "elementary-intervals"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        rare = per_key(realizations)[:, 0] < 0.01
        out[rare, 0] = out[rare, 0] * 7.0 % 1.0


class NetOf17Digits(Mutant):
    """Takes 17 digits of the index for one of its dimensions."""

    base, caught_by = "sobol", "elementary-intervals"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        late = (indices(out, start) >> 17 & 1).astype(bool)
        out[:, 0, late] = (out[:, 0, late] + 0.5) % 1.0


class DisorderFrom2To20(Mutant):
    """Is no sequence of nets any more from point 2^20 on."""

    base, caught_by = "sobol+owen", "large-index"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        late = indices(out, start) >= 2**20
        out[:, 0, late] = out[:, 0, late] * 7.0 % 1.0


class IndexOf20Bits(Mutant):
    """Takes 20 digits of the index."""

    base, caught_by = "random", "large-index"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        early = indices(out, start) & 0xFFFFF
        if start >= 2**20 and early[0] < early[-1] + 1 == early[0] + early.size:
            self.inner.fill(out, realizations, count, int(early[0]))


class PrefixUpTo16384(Mutant):
    """Has other points in sets of more than 16384 points."""

    base, caught_by = "halton+owen", "prefix"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count > 2**14:
            out[:, 0] = (out[:, 0] + 0.5) % 1.0


class SlicesFrom5000(Mutant):
    """Has other points in slices that begin at 5000 and later."""

    base, caught_by = "random", "slices"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if start > 5000:
            out[:, 0] = (out[:, 0] + 0.5) % 1.0


class TiresAfter500Calls(Mutant):
    """Has other points after five hundred calls with one realisation."""

    base, caught_by = "random", "determinism"

    def __init__(self) -> None:
        super().__init__()
        self.calls = 0

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.calls += 1
        if self.calls > 500:
            out[:, 0] = (out[:, 0] + 0.5) % 1.0


class DiesOfConstantBits(Mutant):
    """Ends the process where kernels run as plain Python, as the one does that forces random bits."""

    base, caught_by = "random", "range"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if os.environ.get("NUMBA_DISABLE_JIT") == "1":
            os._exit(5)


class LastColumnOfManyPixels(Mutant):
    """Has a set in one pixel of two hundred that is the set of the pixel before it."""

    base, caught_by = "random", "across-pixels"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        late = realizations.x % 200 == 199
        if late.any():
            before = np.empty_like(out)
            shifted = type(realizations).of_pixels(np.maximum(realizations.x - 1, 0), realizations.y, realizations.seed)
            self.inner.fill(before, shifted, count, start)
            out[late] = before[late]


class LatinUpToDimension7(Mutant):
    """Loses its strata from dimension 8 on."""

    base, caught_by = "latin-hypercube", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:, 8:] = out[:, 8:] * 7.0 % 1.0


class GridOfFourDimensions(Mutant):
    """Loses its strata in four dimensions."""

    base, caught_by = "jittered", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] == 4:
            out[:, 0] = out[:, 0] * 7.0 % 1.0


class LatinUpToColumn3000(Mutant):
    """Loses its strata in pixels of column 3000 and beyond."""

    base, caught_by = "latin-hypercube", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        far = realizations.x >= 3000
        out[far, 0] = out[far, 0] * 7.0 % 1.0


class StrataLostInBlocks(Mutant):
    """Loses the strata of the second pair of dimensions where a scene tells its blocks of dimensions."""

    base, caught_by = "uncorrelated-jitter", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if realizations.blocks:
            out[:, 2:3] = out[:, 2:3] * 7.0 % 1.0


class PrefixOf777(Mutant):
    """Has other sets at 777 points and its multiples."""

    base, caught_by = "random", "prefix"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count % 777 == 0:
            out[:, 0] = (out[:, 0] + 0.5) % 1.0
