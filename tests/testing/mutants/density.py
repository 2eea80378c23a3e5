"""Mutants whose density is wrong, of one dimension or of several together, a little or at some counts only."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from mutants.mutant import ALMOST_ONE, Mutant, per_key

if TYPE_CHECKING:
    from mutants.mutant import Array
    from samplekit import Realizations


def coin(x: Array) -> Array:
    """Return independent numbers in [0, 1), made of the late digits of coordinates."""
    found: Array = x * 2.0**21 % 1.0
    return found


class ThirdIsTheSum(Mutant):
    """Makes dimension 2 the sum of dimensions 0 and 1: all pairs are independent."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            out[:, 2] = (out[:, 0] + out[:, 1]) % 1.0


class ThirdIsTheShiftedSum(Mutant):
    """The same with a random shift for each pixel: one point alone is uniform."""

    base, caught_by = "random", "across-dimensions"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            out[:, 2] = (out[:, 0] + out[:, 1] + per_key(realizations)) % 1.0


class FourthIsTheSum(Mutant):
    """Makes dimension 3 the sum of the three before, and a shift: all triples are independent."""

    base, caught_by = "sobol+owen", "across-dimensions"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 3:
            out[:, 3] = (out[:, :3].sum(axis=1) + per_key(realizations)) % 1.0


class FirstDigitIsXor(Mutant):
    """Makes the first digit of dimension 2 the sum of those of dimensions 0 and 1."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            out[:, 2] = (((out[:, 0] < 0.5) ^ (out[:, 1] < 0.5)) + out[:, 2]) / 2.0


class OddOctants(Mutant):
    """Lets octants of odd parity hold 3 % more than their share: no pair of dimensions shows it."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            even = (out[:, :3] < 0.5).sum(axis=1) % 2 == 0
            out[:, 2] = np.where(even & (coin(out[:, 1]) < 0.03), (out[:, 2] + 0.5) % 1.0, out[:, 2])


class LowerHalf(Mutant):
    """Has a density of 1.03 in the lower half, and 0.97 in the upper one."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        moved = (out[:, 0] >= 0.5) & (coin(out[:, 0]) < 0.03)
        out[:, 0] = np.where(moved, out[:, 0] - 0.5, out[:, 0])


class LowerHalfOfTheLast(Mutant):
    """Has that density in dimension 5 alone."""

    base, caught_by = "owen-sobol", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 5:
            moved = (out[:, 5] >= 0.5) & (coin(out[:, 5]) < 0.03)
            out[:, 5] = np.where(moved, out[:, 5] - 0.5, out[:, 5])


class OneOctave(Mutant):
    """Has a density of 0.97 in [1/32, 1/16)."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        inside = (out[:, 0] >= 1 / 32) & (out[:, 0] < 1 / 16) & (coin(out[:, 0]) < 0.03)
        out[:, 0] = np.where(inside, out[:, 0] + 0.5, out[:, 0])


class OneCell(Mutant):
    """Has a density of 0.97 in a cell of 1/8 x 1/8."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 1:
            inside = (out[:, :2] * 8 // 1 == 3.0).all(axis=1) & (coin(out[:, 0]) < 0.03)
            out[:, 0] = np.where(inside, out[:, 0] + 0.5, out[:, 0])


class OneCount(Mutant):
    """Has a density of 1.03 in the lower half of sets of 64 points."""

    base, caught_by = "random", "joint-uniformity"
    declares = {"progressive": None}  # noqa: RUF012

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count == 64:
            moved = (out[:, 0] >= 0.5) & (coin(out[:, 0]) < 0.03)
            out[:, 0] = np.where(moved, out[:, 0] - 0.5, out[:, 0])


class LargeSets(Mutant):
    """Has a density of 1.03 in the lower half of sets of more than 8192 points."""

    base, caught_by = "latin-hypercube", "joint-uniformity"
    declares = {"promises": ()}  # noqa: RUF012

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count > 8192:
            moved = (out[:, 0] >= 0.5) & (coin(out[:, 1]) < 0.03)
            out[:, 0] = np.where(moved, out[:, 0] - 0.5, out[:, 0])


class WavyDensity(Mutant):
    """Has a density of 1 + 0.03 cos 2 pi (x0 + x1 - x2)."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 2:
            low = np.cos(2 * np.pi * (out[:, 0] + out[:, 1] - out[:, 2])) < 0.0
            out[:, 2] = np.where(low & (coin(out[:, 1]) < 0.03), (out[:, 2] + 0.5) % 1.0, out[:, 2])


class OneSetInAHundred(Mutant):
    """Has a constant first coordinate in one set of a hundred, off the centre."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[per_key(realizations)[:, 0] < 0.01, 0] = 0.7


class TwelfthIsASum(Mutant):
    """Makes dimension 12 the sum of dimensions 3 and 10."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 12:
            out[:, 12] = (out[:, 3] + out[:, 10]) % 1.0


class FifthIsTheSum(Mutant):
    """Makes dimension 4 the sum of the four before: all quadruples are independent."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] > 4:
            out[:, 4] = out[:, :4].sum(axis=1) % 1.0


class UpperHalfOfTheSeventh(Mutant):
    """Moves 5 % of the points of the upper half of dimension 7 down."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        for column in out[:, 7:8].swapaxes(0, 1):
            column[(column >= 0.5) & (coin(column) < 0.05)] -= 0.5


class SevenDimensions(Mutant):
    """Moves a tenth of the points of the upper halves down where seven dimensions are asked for."""

    base, caught_by = "random", "joint-uniformity"
    declares: ClassVar = {"extensible_dims": False}

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if out.shape[1] == 7:
            out[(out >= 0.5) & (coin(out) < 0.1)] -= 0.5


class UpperHalfFrom40000(Mutant):
    """Moves a tenth of the points of the upper halves down in sets of 40 000 points and more."""

    base, caught_by = "random", "joint-uniformity"
    declares: ClassVar = {"progressive": None}

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count >= 40_000:
            out[(out >= 0.5) & (coin(out) < 0.1)] -= 0.5


class SixteenDigits(Mutant):
    """Leaves all digits past the sixteenth zero."""

    base, caught_by = "sobol+owen", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        out[:] = np.floor(out * 2.0**16) * 2.0**-16


class PlaceOnTheDiagonal(Mutant):
    """Jitters both coordinates of two by the same number, in sets of 64 points and more."""

    base, caught_by = "jittered", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        side = math.isqrt(count)
        if out.shape[1] == 2 and side * side == count >= 64:
            cell = np.floor(out[:, 1] * side)
            place = np.minimum(out[:, 0] * side % 1.0, ALMOST_ONE)
            out[:, 1] = np.minimum((cell + place) / side, np.nextafter((cell + 1) / side, 0.0))


class CentresFrom2000(Mutant):
    """Takes the centres of the intervals in sets of 2000 points and more."""

    base, caught_by = "latin-hypercube", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if count >= 2000:
            out[:] = (np.floor(out * count) + 0.5) / count


class BlocksRepeat(Mutant):
    """Gives the second pair of dimensions the numbers of the first where a scene tells its blocks of dimensions."""

    base, caught_by = "random", "joint-uniformity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if realizations.blocks[:2] == (2, 2):
            out[:, 2:4] = out[:, :2]
