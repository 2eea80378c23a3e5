"""Orthogonal array sampling: projected onto any t dimensions, there is one point in each cell of an s^t grid.

Jarosz, Enayet, Kensler, Kilpatrick, Christensen 2019, "Orthogonal array sampling for Monte Carlo rendering", with the
arrays of Bose 1938, "On the application of the properties of Galois fields to the problem of construction of
hyper-Graeco-Latin squares" (strength t = 2, N = s^2), and Bush 1952, "Orthogonal arrays of index unity" (t = 3,
N = s^3), s a prime. Both are one construction: the digits of the index in base s are the coefficients of a polynomial
of degree below t. Column j is its value at j modulo s, and column s its leading coefficient. Any t of the s + 1 columns
determine the polynomial, so among the s^t points each combination of t digits occurs once.

A column's digit, after a random permutation of the digits, is the stratum of a dimension. The offset within the stratum
follows one of the paper's three styles:

- ``jittered``: uniform;
- ``multi-jittered``: t - 1 other columns number the s^(t-1) points of a stratum, which go to its sub-strata in a random
  order of its own, so that every dimension is Latin;
- ``correlated``: in a random order that all strata share (Kensler 2013), so that the pairs (or triples) of dimensions 0
  and 1, 2 and 3, ... are correlated multi-jittered.

Points come in a random order.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import count as count_from

import numpy as np
from numpy.typing import NDArray

from samplekit import LatinStrata, OrthogonalArray, PrimePowers, Realizations, Sampler, SamplerSpec, UsageError
from samplekit._builtin.samplers.strata import (
    BLOCK,
    cell_steps,
    new_lines,
    new_places,
    ordered_places,
)
from samplekit.kernels import (
    dimension_key,
    hash_index,
    helper,
    kernel,
    mix64,
    permutation_bits,
    permute_in_lines,
    place_in_cell,
    second_key,
    shuffle,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_ORDER = _U64(0x1F83D9ABFB41BD6B)
_STRATA = _U64(0x5BE0CD19137E2179)
_LINES = _U64(0x3C6EF372FE94F82B)
_STYLES = ("jittered", "multi-jittered", "correlated")
_JITTERED, _, _CORRELATED = range(3)


@helper
def _column(out: Array, coefficients: Array, column: int, s: float) -> None:
    """Write the digits of a column: the polynomials at ``column`` modulo s, for column s their leading coefficients."""
    degree = coefficients.shape[0] - 1
    if column == s:
        for i in range(out.size):
            out[i] = coefficients[degree, i]
        return
    for i in range(out.size):
        out[i] = coefficients[0, i]
    power = 1.0
    for k in range(1, degree + 1):
        power = (power * column) % s
        for i in range(out.size):
            out[i] += power * coefficients[k, i]
    for i in range(out.size):
        # Below 2 s^2 + s < 2^34, so exact; the half keeps clear of the rounding.
        out[i] -= s * np.floor((out[i] + 0.5) * (1.0 / s))


@helper
def _write_coefficients(
    coefficients: Array, order: NDArray[np.int64], base: float, count: int, start: int, key: np.uint64
) -> None:
    """Write the digits in base s of the places that start, start + 1, ... have in a random order of all points."""
    strength, whole = coefficients.shape
    per_base, bits = 1.0 / base, permutation_bits(count)
    for begin in range(0, whole, BLOCK):
        n = min(BLOCK, whole - begin)
        ordered = ordered_places(order, n, count, start + begin, bits, key)
        for i in range(n):
            coefficients[0, begin + i] = np.float64(ordered[i])
        for k in range(strength):
            row = coefficients[k, begin : begin + n]
            above = coefficients[min(k + 1, strength - 1), begin : begin + n]
            for i in range(n):
                quotient = np.floor((row[i] + 0.5) * per_base)
                row[i] -= base * quotient
                if k + 1 < strength:
                    above[i] = quotient


@kernel("void(float64[:,:,::1], uint64[::1], int64, int64, int64, int64, int64)")
def _fill(out: Array, keys: NDArray[np.uint64], s: int, strength: int, style: int, count: int, start: int) -> None:
    realizations, dims, whole = out.shape
    points = min(whole, BLOCK)
    sublines = count // s
    order = new_places(points, count)
    coefficients, digits = np.empty((strength, whole)), np.empty((2, points))
    stratum, place, strata = np.empty(points, np.int64), np.empty(points, np.int64), np.empty(s, np.int64)
    shared = style == _CORRELATED
    line_keys, table = new_lines(s, sublines if shared else count)
    subline_bits = permutation_bits(sublines)
    per_line = 0 if shared else sublines
    shift, step, width = cell_steps(s if style == _JITTERED else count)
    base = np.float64(s)
    for r in range(realizations):
        _write_coefficients(coefficients, order, base, count, start, mix64(keys[r] ^ _ORDER))
        for d in range(dims):
            key = dimension_key(keys[r], d)
            second = second_key(key)
            shuffle(strata, s, mix64(key ^ _STRATA))
            if style != _JITTERED:
                line_key = mix64(key ^ _LINES)
                for line in range(1 if shared and table.size > 0 else s):
                    line_keys[line] = line_key if shared else mix64(line_key + _U64(line))
                    if table.size > 0:
                        shuffle(table[line * sublines :], sublines, line_keys[line])
            # The other columns of the dimension's group: the last group moves back where it would pass column s.
            group = min(d - d % strength, s + 1 - strength)
            for begin in range(0, whole, points):
                n = min(points, whole - begin)
                block = coefficients[:, begin : begin + n]
                row = out[r, d, begin : begin + n]
                _column(digits[0, :n], block, d, base)
                for i in range(n):
                    stratum[i] = np.int64(digits[0, i])
                if style == _JITTERED:
                    for i in range(n):
                        cell = np.float64(strata[stratum[i]])
                        random = hash_index(key, second, _U64(start + begin + i))
                        row[i] = place_in_cell(cell, random, shift, step, width)
                    continue
                place[:n] = 0
                for column in range(group, group + strength):
                    if column != d:
                        _column(digits[1, :n], block, column, base)
                        for i in range(n):
                            place[i] = place[i] * s + np.int64(digits[1, i])
                if table.size > 0:
                    for i in range(n):
                        place[i] = table[stratum[i] * per_line + place[i]]
                else:
                    permute_in_lines(place[:n], stratum[:n], sublines, subline_bits, line_keys)
                for i in range(n):
                    cell = np.float64(strata[stratum[i]] * sublines + place[i])
                    random = hash_index(key, second, _U64(start + begin + i))
                    row[i] = place_in_cell(cell, random, shift, step, width)


def _prime_root(count: int, strength: int) -> int:
    return int(float(count) ** (1.0 / strength) + 0.5)


class OrthogonalArraySampler(Sampler):
    """Points on the arrays of Bose and of Bush.

    Parameters
    ----------
    strength
        Number of dimensions that are stratified together, 2 or 3.
    offset
        How places within strata are chosen: ``jittered``, ``multi-jittered`` or ``correlated``.
    """

    def __init__(self, strength: int = 2, offset: str = "correlated") -> None:
        self.strength = strength
        self.counts = PrimePowers(strength)
        self.style = _STYLES.index(offset)

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare the counts and the promises of this strength and offset."""
        promises = (OrthogonalArray(self.strength), *(() if self.style == _JITTERED else (LatinStrata(),)))
        return replace(spec, counts=self.counts, promises=promises)

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """Raise unless the array has enough columns.

        Raises
        ------
        UsageError
            More than s + 1 dimensions: names the smallest array that has them.
        """
        s = _prime_root(count, self.strength)
        if dims > s + 1:
            enough = next(n**self.strength for n in count_from(dims - 1) if self.counts.allows(n**self.strength, dims))
            raise UsageError(
                f"orthogonal-array of {count} = {s}^{self.strength} points has at most {s + 1} dimensions, not {dims}:"
                f" for {dims} dimensions it takes at least {enough} points"
            )

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        s = _prime_root(count, self.strength)
        if not self.counts.allows(count, out.shape[1]) or out.shape[1] > s + 1:
            raise UsageError(f"there is no orthogonal array of {count} points in {out.shape[1]} dimensions")
        _fill(out, realizations.keys, s, self.strength, self.style, count, start)
