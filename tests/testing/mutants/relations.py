"""Mutants in which seeds, pixels, dimensions, counts and indices are related to each other."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import ALMOST_ONE, Mutant, indices
from samplekit import Realizations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from mutants.mutant import Array

_MOST = 2**32


class _Related(Mutant):
    """Gives the points of another pixel and seed, which ``moved`` chooses."""

    base, caught_by = "random", "relations"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.ask(out, *self.moved(realizations.x, realizations.y, realizations.seed, count, out.shape[1]), count, start)

    def moved(
        self, x: NDArray[np.int64], y: NDArray[np.int64], seed: int, count: int, dims: int
    ) -> tuple[NDArray[np.int64], NDArray[np.int64], int]:
        """Choose the pixel and the seed."""
        raise NotImplementedError

    def ask(self, out: Array, x: NDArray[np.int64], y: NDArray[np.int64], seed: int, count: int, start: int) -> None:
        """Write the base's points of some pixels and a seed."""
        self.inner.fill(out, Realizations.of_pixels(x % _MOST, y % _MOST, seed % 2**64), count, start)


class SeedPlusX(_Related):
    """Moves the image by a pixel from seed to seed."""

    def moved(self, x, y, seed, count, dims):
        return x + seed % _MOST, y, 0


class SeedTimesRowPlusX(_Related):
    """Numbers the pixels of images of 1000 columns from seed to seed."""

    def moved(self, x, y, seed, count, dims):
        return x + seed % _MOST * 1000, y, 0


class SeedXorY(_Related):
    """Adds the seed to the row, digit by digit."""

    base = "sobol+owen"

    def moved(self, x, y, seed, count, dims):
        return x, y ^ (seed % _MOST), 0


class ScreenPlusSeed(_Related):
    """Moves blocks that share a sequence from seed to seed."""

    base = "z-sobol"

    def moved(self, x, y, seed, count, dims):
        return x + 64 * (seed % _MOST), y, 0


class MirroredPixels(_Related):
    """Gives pixels (x, y) and (y, x) one set."""

    def moved(self, x, y, seed, count, dims):
        return np.minimum(x, y), np.maximum(x, y), seed


class ProductOfXAndY(_Related):
    """Takes x y as the key of a pixel, with one added so that no axis is lost."""

    def moved(self, x, y, seed, count, dims):
        return (x + 1) * (y + 1), np.zeros_like(y), seed


class SumOfXAndY(_Related):
    """Takes x + y as the key of a pixel."""

    base = "jittered"

    def moved(self, x, y, seed, count, dims):
        return x + y, np.zeros_like(y), seed


class XorOfXAndY(_Related):
    """Takes x ^ y as the key of a pixel."""

    base = "r2"

    def moved(self, x, y, seed, count, dims):
        return x ^ y, np.zeros_like(y), seed


class TilesOf2To20(_Related):
    """Takes 20 digits of a coordinate."""

    def moved(self, x, y, seed, count, dims):
        return x & 0xFFFFF, y & 0xFFFFF, seed


class SeedOf60Bits(_Related):
    """Ignores the first four digits of the seed."""

    def moved(self, x, y, seed, count, dims):
        return x, y, seed & (2**60 - 1)


class SeedPlusCount(_Related):
    """Adds the count to the seed."""

    def moved(self, x, y, seed, count, dims):
        return x, y, seed + count


class SeedPlusDims(_Related):
    """Adds the number of dimensions to the seed."""

    declares = {"extensible_dims": False}  # noqa: RUF012

    def moved(self, x, y, seed, count, dims):
        return x, y, seed + dims


class SeedPlusDimension(_Related):
    """Begins one dimension later from seed to seed."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        late = realizations.seed % 8
        more = np.empty((out.shape[0], out.shape[1] + late, out.shape[2]))
        self.ask(more, realizations.x, realizations.y, 0, count, start)
        out[:] = more[:, late:]


class PixelPlusDimension(_Related):
    """Begins one dimension later from pixel to pixel."""

    base = "owen-sobol"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        one = np.empty((out.shape[0], 1, out.shape[2]))
        for dimension in range(out.shape[1]):
            self.ask(one, realizations.x + dimension, realizations.y, realizations.seed, count, start)
            out[:, dimension] = one[:, 0]


class PixelPlusIndex(_Related):
    """Begins one point later from pixel to pixel, as one sequence for all pixels does."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        one = np.empty((out.shape[0], out.shape[1], 1))
        for place, index in enumerate(indices(out, start).tolist()):
            self.ask(one, realizations.x + index, realizations.y, realizations.seed, 1, 0)
            out[:, :, place] = one[:, :, 0]


class _OfTheSeedBefore(_Related):
    """Makes the points of an odd seed from those of the seed before it."""

    def moved(self, x, y, seed, count, dims):
        return x, y, seed & ~1


class MirroredSeeds(_OfTheSeedBefore):
    """Mirrors the points of every second seed."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        super().fill(out, realizations, count, start)
        if realizations.seed & 1:
            out[:] = np.minimum(1.0 - out, ALMOST_ONE)


class SwappedSeeds(_OfTheSeedBefore):
    """Exchanges the first two dimensions in every second seed."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        super().fill(out, realizations, count, start)
        if realizations.seed & 1 and out.shape[1] > 1:
            out[:, :2] = out[:, 1::-1].copy()


class ShiftedSeeds(_OfTheSeedBefore):
    """Moves the points of every second seed by a constant."""

    base = "jittered+shift"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        super().fill(out, realizations, count, start)
        out[:] = (out + 0.381966 * (realizations.seed & 1)) % 1.0


class ReversedSeeds(_OfTheSeedBefore):
    """Gives the points of every second seed in another order."""

    base = "latin-hypercube"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        whole = np.empty((*out.shape[:2], count))
        super().fill(whole, realizations, count, 0)
        out[:] = (whole[:, :, ::-1] if realizations.seed & 1 else whole)[:, :, start : start + out.shape[2]]


class RowsAndColumns(_Related):
    """Adds a random number of the column to one of the row."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        zero, other = np.zeros_like(realizations.x), np.empty_like(out)
        self.ask(out, realizations.x + 7, zero, realizations.seed, count, start)
        self.ask(other, zero, realizations.y + 7, realizations.seed, count, start)
        out[:] = (out + other) % 1.0


class SumOfSeeds(_Related):
    """Adds the points of the two seeds before in every third one."""

    base = "sobol+owen"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        seed = realizations.seed
        third = seed % 3 == 2
        self.ask(out, realizations.x, realizations.y, seed - third, count, start)
        if third:
            other = np.empty_like(out)
            self.ask(other, realizations.x, realizations.y, seed - 2, count, start)
            out[:] = (out + other) % 1.0


class OffsetByDims(_Related):
    """Moves all points by a tenth for each dimension that is asked for."""

    caught_by = "dimension-prefix"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count, start)
        out[:] = (out + 0.1 * out.shape[1]) % 1.0


class ReversedFromNineDims(_Related):
    """Reverses the dimensions where more than eight are asked for."""

    base, caught_by = "sobol+owen", "dimension-prefix"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count, start)
        if out.shape[1] > 8:
            out[:] = out[:, ::-1].copy()


class PairsKnowEachOther(_Related):
    """Exchanges the first two dimensions of large sets where there is a third."""

    base, caught_by = "owen-sobol", "dimension-prefix"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, realizations, count, start)
        if count > 1000 and out.shape[1] == 3:
            out[:, :2] = out[:, 1::-1].copy()


class RowsOf3840(_Related):
    """Numbers pixels as in an image of 3840 columns: wider images repeat."""

    caught_by = "across-pixels"

    def moved(self, x, y, seed, count, dims):
        return (x + 3840 * y) % _MOST, 0 * y, seed


class SeedOf53Bits(_Related):
    """Rounds the seed to a float64."""

    caught_by = "seed"

    def moved(self, x, y, seed, count, dims):
        return x, y, int(float(seed))


class SeedModuloAMillion(_Related):
    """Takes the seed modulo 1 000 003."""

    caught_by = "seed"

    def moved(self, x, y, seed, count, dims):
        return x, y, seed % 1_000_003 + 5 * 2**40


class KeyOf32Bits(Mutant):
    """Uses 32 bits of the key, as generators do that take a seed of 32 bits."""

    base, caught_by = "random", "across-pixels"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.inner.fill(out, replace(realizations, keys=realizations.keys & np.uint64(2**32 - 1)), count, start)


class XoredSeeds(_OfTheSeedBefore):
    """Adds a constant to the digits of the seed before, without carry."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        super().fill(out, realizations, count, start)
        if realizations.seed & 1:
            out[:] = ((out * 2.0**53).astype(np.uint64) ^ np.uint64(0xA5A5A5A5A5A5A)) * 2.0**-53


class EightDimensionsAPoint(Mutant):
    """Counts numbers: dimension 8 of a point is dimension 0 of the next."""

    base, caught_by = "random", "relations"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        one = np.empty((len(realizations), 1, out.shape[1] + 8 * out.shape[2]))
        self.inner.fill(one, realizations, count, 8 * start)
        for dimension in range(out.shape[1]):
            out[:, dimension] = one[:, 0, dimension::8][:, : out.shape[2]]


class LateDimensionsWithoutSeed(Mutant):
    """Gives all seeds the same numbers from dimension 9 on."""

    base, caught_by = "random", "relations"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 9:
            same = np.empty_like(out)
            self.inner.fill(same, Realizations.of_pixels(realizations.x, realizations.y, 5), count, start)
            out[:, 9:] = same[:, 9:]
