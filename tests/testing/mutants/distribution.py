"""Mutants that are biased, noisier than they say, or depend on other pixels and dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import ALMOST_ONE, Mutant, indices, per_key
from samplekit import Realizations

if TYPE_CHECKING:
    from mutants.mutant import Array


class HalfTheDomain(Mutant):
    """Has the right mean, but visits half of the domain only."""

    base, caught_by = "random", "uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:, 0] = 0.25 + out[:, 0] / 2.0


class BlindSpot(Mutant):
    """Never visits a disk of radius 0.06."""

    base, caught_by = "random", "uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 1:
            inside = (out[:, 0] - 0.7) ** 2 + (out[:, 1] - 0.3) ** 2 < 0.06**2
            out[:, 0] = np.where(inside, out[:, 0] - 0.2, out[:, 0])


class SmallBias(Mutant):
    """Has a bias of 1e-3."""

    base, caught_by = "random", "unbiasedness"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:, 0] *= 1.0 - 2e-3


class LeftInTheCell(Mutant):
    """Leaves out the digits past the 12th: every point lies at the left of its cell, a bias of 2^-13."""

    base, caught_by = "sobol+owen", "unbiasedness"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:] = np.floor(out * 4096.0) / 4096.0


class TwinPoints(Mutant):
    """Draws every second point a hair from the one before: half as many samples as it says."""

    base, caught_by = "random", "variance"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        index = indices(out, start)
        whole = np.empty((*out.shape[:2], count + 1))
        self.inner.fill(whole, realizations, count + 1, 0)
        out[:] = np.minimum(whole[:, :, index // 2] + (index % 2) * 1e-9, ALMOST_ONE)


class LumpedStrata(Mutant):
    """Jitters all cells by one random vector in common, in a grid turned about: unbiased, but aliasing."""

    base, caught_by = "random", "variance"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        shift = per_key(realizations, out.shape[1])[:, :, None]
        out[:] = (np.floor(out * 8.0) / 8.0 + shift) % 1.0


class SamePixels(Mutant):
    """Gives all pixels one set, though it is declared randomised."""

    base, caught_by = "random", "across-pixels"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        zero = np.zeros_like(realizations.x)
        self.inner.fill(out, Realizations.of_pixels(zero, zero, realizations.seed), count, start)


class PeriodOf256(Mutant):
    """Repeats every 256 pixels, as a production library does."""

    base, caught_by = "sobol+owen", "across-pixels"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        x, y = realizations.x & 255, realizations.y & 255
        self.inner.fill(out, Realizations.of_pixels(x, y, realizations.seed), count, start)


class NeighboursShare(Mutant):
    """Lets pairs of pixels share one of their dimensions."""

    base, caught_by = "random", "across-pixels"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        shared = np.empty_like(out)
        pairs = Realizations.of_pixels(realizations.x // 2 + (1 << 20), realizations.y // 2, realizations.seed)
        self.inner.fill(shared, pairs, count, start)
        out[:, 0] = shared[:, 0]


class PaddedAlike(Mutant):
    """Pads dimension 2 with dimension 0, jittered anew in sixteenths."""

    base, caught_by = "latin-hypercube", "across-dimensions"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            out[:, 2] = np.floor(out[:, 0] * 16.0) / 16.0 + out[:, 1] / 16.0


class MirroredDimensions(Mutant):
    """Makes dimension 1 a copy of dimension 0 or its mirror image, by the toss of a coin in every pixel."""

    base, caught_by = "random", "across-dimensions"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 1:
            heads = per_key(realizations) < 0.5
            out[:, 1] = np.where(heads, out[:, 0], ALMOST_ONE - out[:, 0])


class _SharesAScreen(Mutant):
    """Z-Sobol, whose blocks of pixels share one sequence, with that broken."""

    base, caught_by = "z-sobol", "across-pixels"


class SharesNothing(_SharesAScreen):
    """Says that blocks of pixels share one sequence, but gives every pixel a net of its own."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        x, y = ((each * 16) & 0xFFFFFFFF for each in (realizations.x, realizations.y))
        apart = Realizations.of_pixels(x, y, realizations.seed)
        self.inner.fill(out, apart, count, start)


class HandsOutInDisorder(_SharesAScreen):
    """Hands the parts of a block's sequence to its pixels in disorder: together they are a net, neighbours are not."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        place = (realizations.x & 15) + 16 * (realizations.y & 15)
        moved = place * 91 % 256 ^ 0x5A
        x, y = (realizations.x & ~15) | (moved & 15), (realizations.y & ~15) | (moved >> 4)
        self.inner.fill(out, Realizations.of_pixels(x, y, realizations.seed), count, start)


class OneSequenceForTheScreen(_SharesAScreen):
    """Gives all blocks of the screen one sequence, with digits of one dimension flipped anew in each."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        first = Realizations.of_pixels(realizations.x & 15, realizations.y & 15, realizations.seed)
        self.inner.fill(out, first, count, start)
        block = Realizations.of_pixels(realizations.x >> 4, realizations.y >> 4, realizations.seed)
        words = (out[:, 0] * 2.0**53).astype(np.uint64) ^ (block.random_words(1) >> np.uint64(11))
        out[:, 0] = words * 2.0**-53
