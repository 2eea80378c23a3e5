"""Mutants whose points depend on how they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from mutants.mutant import ALMOST_ONE, Mutant, indices
from samplekit import AnyCount, PowersOf, Products, Realizations

if TYPE_CHECKING:
    from mutants.mutant import Array


class HiddenState(Mutant):
    """Gives other points each time that it is asked."""

    base, caught_by = "jittered", "determinism"

    def __init__(self) -> None:
        super().__init__()
        self.calls = 0

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.calls += 1
        out[0, 0, 0] = np.nextafter(out[0, 0, 0], float(self.calls % 2))


class DependsOnTheBatch(Mutant):
    """Lets the place of a realisation in its batch decide, as samplers do that know tiles."""

    base, caught_by = "random", "determinism"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[1:] = np.minimum(out[1:] + 2.0**-30, ALMOST_ONE)


class DependsOnTheProcess(Mutant):
    """Seeds itself with Python's hash of a text, which is another one in every process."""

    base, caught_by = "random", "determinism"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:] = (out + (hash("samplekit") % 1024) / 1024.0) % 1.0


class IgnoresTheSeed(Mutant):
    """Gives the same points for every seed, though it is declared randomised."""

    base, caught_by = "random", "seed"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, Realizations.of_pixels(realizations.x, realizations.y, 0), count, start)


class TruncatesTheSeed(Mutant):
    """Takes 32 bits of the seed."""

    base, caught_by = "random", "seed"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        seed = realizations.seed & 0xFFFFFFFF
        self.inner.fill(out, Realizations.of_pixels(realizations.x, realizations.y, seed), count, start)


class DeclaredNotRandom(Mutant):
    """Is random, but declared not to be."""

    base, caught_by = "random", "seed"
    declares: ClassVar = {"randomized": False, "unbiased": False}


class PrefixBrokenAtPowersOfTwo(Mutant):
    """Has another last point where the count is a power of two, as three Halton variants of a library do."""

    base, caught_by = "halton+owen", "prefix"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count > 1 and count.bit_count() == 1 and start + out.shape[2] == count:
            out[:, 0, -1] = (out[:, 0, -1] + 0.5) % 1.0


class ProgressiveHammersley(Mutant):
    """Is declared progressive, though index / count moves all points when the count does."""

    base, caught_by = "hammersley", "prefix"
    declares: ClassVar = {"progressive": PowersOf(2)}


class SlicesOffByOne(Mutant):
    """Starts slices one point late."""

    base, caught_by = "sobol+xor", "slices"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count + 1, start + (start > 0))


class WrapsDimensions(Mutant):
    """Starts again with dimension 0 after the seventh, in silence."""

    base, caught_by = "random", "limits"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:, 8:] = out[:, np.arange(8, out.shape[1]) % 8]


class RoundsTheCount(Mutant):
    """Makes a grid of the largest product below the count, and the rest of its points again, in silence."""

    base, caught_by = "jittered", "limits"
    declares: ClassVar = {"counts": AnyCount(), "promises": ()}

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        made = Products().nearest(count, out.shape[1])[0]
        whole = np.empty((*out.shape[:2], made))
        self.inner.fill(whole, realizations, made, 0)
        out[:] = whole[:, :, indices(out, start) % made]


class LastPointTwice(Mutant):
    """Gives the last point but one again in place of the last."""

    base, caught_by = "random", "limits"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count > 1 and start + out.shape[2] == count:
            before = np.empty((*out.shape[:2], 1))
            self.inner.fill(before, realizations, count, count - 2)
            out[:, :, -1] = before[:, :, 0]


class IndexOf32Bits(Mutant):
    """Takes 32 bits of the index, though it is declared to have 63."""

    base, caught_by = "random", "large-index"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count, start & 0xFFFFFFFF)


class PixelsOf16Bits(Mutant):
    """Takes 16 bits of a pixel's coordinates."""

    base, caught_by = "random", "pixel-extremes"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        x, y = realizations.x & 0xFFFF, realizations.y & 0xFFFF
        self.inner.fill(out, Realizations.of_pixels(x, y, realizations.seed), count, start)
