"""Mutants that break nets, strata and distances."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

import samplekit
from mutants.mutant import ALMOST_ONE, Mutant, indices
from samplekit import LatinStrata, MinimumDistance, Net, PowersOf

if TYPE_CHECKING:
    from mutants.mutant import Array
    from samplekit import Realizations


class WrongXorConstant(Mutant):
    """One constant of the generator matrices has a wrong bit."""

    base, caught_by = "sobol", "elementary-intervals"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 1:
            wrong = (indices(out, start) >> 3 & 1).astype(np.uint64) << np.uint64(29)
            words = (out[:, 1] * 2.0**32).astype(np.uint64) ^ wrong
            out[:, 1] = words.astype(float) * 2.0**-32


class RandomDeclaredANet(Mutant):
    """Random points that are declared a net."""

    base, caught_by = "random", "elementary-intervals"
    declares: ClassVar = {"promises": (Net(),), "largest_index": 2**32 - 1}


class SkipsTheFirstPoint(Mutant):
    """Drops the first point of Sobol's sequence, which is no net any more (Owen 2020)."""

    base, caught_by = "sobol+owen", "elementary-intervals"
    declares: ClassVar = {"largest_index": 2**31}

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count + 1, start + 1)


class RoundsToFloat32(Mutant):
    """Rounds scrambled points to float32, as a renderer does: a few pixels in a hundred are no net any more."""

    base, caught_by = "sobol+owen", "elementary-intervals"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:] = np.minimum(out.astype(np.float32).astype(float), ALMOST_ONE)


class AddsDigitsInFloatingPoint(Mutant):
    """Adds up the digits of a radical inverse in base 3 in floating point, and falls below boundaries."""

    base, caught_by = "halton", "elementary-intervals"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] < 2:
            return
        rest, value, weight = indices(out, start), np.zeros(out.shape[2]), 1.0
        while rest.any():
            weight /= 3.0
            value += rest % 3 * weight
            rest = rest // 3
        out[:, 1] = np.minimum(value, ALMOST_ONE)


class LaterBlocksBroken(Mutant):
    """Is a net in the first block of every length alone, though it is declared a sequence."""

    base, caught_by = "sobol", "elementary-intervals"
    declares: ClassVar = {"counts": PowersOf(2), "progressive": None}

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        # Later points of a set in another order: the set is the same.
        index = indices(out, start)
        late = index >= count // 4
        moved = np.where(late, count // 4 + (index - count // 4) * 5 % (3 * count // 4 or 1), index)
        whole = np.empty((len(realizations), out.shape[1], count))
        if count > 4 and (3 * count // 4) % 5:
            self.inner.fill(whole, realizations, count, 0)
            out[:] = whole[:, :, moved]


class EmptyCell(Mutant):
    """Leaves one cell of the grid empty and puts two points in another."""

    base, caught_by = "jittered", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count > 1 and start == 0:
            second = np.empty((len(realizations), out.shape[1], 1))
            self.inner.fill(second, realizations, count, 1)
            out[:, :, 0] = (second[:, :, 0] * 8192 // 1 + 0.5) / 8192


class CellsDrawnWithReplacement(Mutant):
    """Draws the intervals of a Latin hypercube with replacement."""

    base, caught_by = "random", "strata"
    declares: ClassVar = {"promises": (LatinStrata(),), "largest_index": 2**32 - 1}


class RowsShuffled(Mutant):
    """Shuffles one dimension of a multi-jittered set: Latin still, but the grid is lost."""

    base, caught_by = "multi-jittered", "strata"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        other = np.empty((len(realizations), 2, out.shape[2]))
        samplekit.sampler("latin-hypercube").fill(other, realizations, count, start)
        out[:, 1] = other[:, 1]


class TooClose(Mutant):
    """Promises a distance that jittered points do not keep."""

    base, caught_by = "jittered", "minimum-distance"
    declares: ClassVar = {"promises": (MinimumDistance(0.5),)}


class ForgetsTheTorus(Mutant):
    """Keeps its distance within the square, but not across its edges."""

    base, caught_by = "regular", "minimum-distance"
    declares: ClassVar = {"promises": (MinimumDistance(0.5),)}

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:] = np.clip((out - 0.5) * 1.4 + 0.5, 0.0, ALMOST_ONE) if count <= 3 else out
        out[:, 0] = np.where(out[:, 0] < 1.0 / count, 0.0, out[:, 0])
        out[:, 0] = np.where(out[:, 0] > out[:, 0].max(axis=1, keepdims=True) - 1e-9, ALMOST_ONE, out[:, 0])


class SaysTooLittle(Mutant):
    """Is Latin, and does not declare it: the hint is asked for, there is no failure."""

    base, caught_by = "latin-hypercube", "under-declaring"
    declares: ClassVar = {"promises": ()}
