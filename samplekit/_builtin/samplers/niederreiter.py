"""Niederreiter's sequence in base 2.

Niederreiter 1988, "Low-discrepancy and low-dispersion sequences", J. Number Theory 30; Bratley, Fox, Niederreiter 1992,
"Implementation and tests of low-discrepancy sequences", ACM TOMACS 2. Dimension d belongs to the d-th irreducible
polynomial p over the field of two elements. Let e be the degree of p, and 0 <= u < e. Digit Q e + u + 1 of a point is
the sum of the digits of the index times the coefficients of the Laurent series of x^u / p^(Q + 1). The quality t is the
sum of e - 1 over the dimensions.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit._builtin.samplers.digital_sequence import DigitalSequence
from samplekit.kernels import BITS

if TYPE_CHECKING:
    from numpy.typing import NDArray


def _product(a: int, b: int) -> int:
    """Return the product of two polynomials, with the coefficient of x^k in bit k."""
    result = 0
    while b:
        if b & 1:
            result ^= a
        a <<= 1
        b >>= 1
    return result


def _divide(a: int, b: int) -> tuple[int, int]:
    """Return the quotient and the remainder of two polynomials."""
    quotient = 0
    degree = b.bit_length()
    while a.bit_length() >= degree:
        shift = a.bit_length() - degree
        quotient |= 1 << shift
        a ^= b << shift
    return quotient, a


@cache
def irreducible_polynomials(count: int) -> tuple[int, ...]:
    """Return the first ``count`` irreducible polynomials, ordered as numbers: x, x + 1, x^2 + x + 1, ..."""
    found: list[int] = []
    candidate = 2
    while len(found) < count:
        degree = candidate.bit_length() - 1
        smaller = (p for p in found if 2 * (p.bit_length() - 1) <= degree)
        if all(_divide(candidate, p)[1] for p in smaller):
            found.append(candidate)
        candidate += 1
    return tuple(found)


@cache
def _columns(polynomial: int) -> NDArray[np.uint32]:
    """Return the columns of the generator matrix of a polynomial, uint32[32]."""
    degree = polynomial.bit_length() - 1
    matrix = np.zeros((BITS, BITS), np.uint64)
    power = 1
    for digit in range(BITS):
        if digit % degree == 0:
            power = _product(power, polynomial)
        # Bit 31 - r of x^(u + 32) / p^(Q + 1) is the coefficient of x^(-r - 1) in the series of x^u / p^(Q + 1).
        series, _ = _divide(1 << (BITS + digit % degree), power)
        matrix[digit] = [series >> (BITS - 1 - r) & 1 for r in range(BITS)]
    weights = np.uint64(1) << np.arange(BITS - 1, -1, -1, dtype=np.uint64)
    columns: NDArray[np.uint32] = (matrix * weights[:, None]).sum(axis=0).astype(np.uint32)
    return columns


class Niederreiter(DigitalSequence):
    """Niederreiter's sequence in the natural order of the index."""

    def columns(self, dims: int) -> NDArray[np.uint32]:
        """Return the columns for the first ``dims`` irreducible polynomials: see :class:`DigitalSequence`."""
        return np.array([_columns(polynomial) for polynomial in irreducible_polynomials(dims)])
