"""Mutants whose density is wrong, of one dimension or of several together, a little or at some counts only."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import Mutant, per_key

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
