"""Error-free transformations and double-double numbers: references that keep their digits where float64 cancels.

A double-double is an unevaluated sum ``high + low`` with ``|low| <= ulp(high) / 2``: about 106 bits. Sums are exact
where nothing overflows; products also need a result above 2^-969, else their error term falls on the subnormal grid.

- Møller 1965, "Quasi double-precision in floating point addition", and Knuth 1969, "Seminumerical Algorithms", 4.2.2:
  the exact sum.
- Dekker 1971, "A floating-point technique for extending the available precision": the exact sum of ordered numbers,
  the exact product, double-double arithmetic.
- Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates": expansions.
- Ogita, Rump, Oishi 2005, "Accurate sum and dot product": the exact product with one fused multiply-add.
- Joldes, Muller, Popescu 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic":
  the algorithms for sum and product below, and their bounds in u = 2^-53.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import fma, helper


@helper
def two_sum(a: float, b: float) -> tuple[float, float]:
    """Return ``a + b`` rounded, and its error: together the exact sum, in any order of magnitude (Møller, Knuth)."""
    total = a + b
    b_part = total - a
    return total, (a - (total - b_part)) + (b - b_part)


@helper
def two_difference(a: float, b: float) -> tuple[float, float]:
    """Return ``a - b`` rounded, and its error: together the exact difference."""
    total = a - b
    b_part = total - a
    return total, (a - (total - b_part)) - (b + b_part)


@helper
def quick_two_sum(a: float, b: float) -> tuple[float, float]:
    """Return ``a + b`` rounded, and its error, exact where ``|a| >= |b|`` or ``a`` is 0 (Dekker)."""
    total = a + b
    return total, b - (total - a)


@helper
def two_product(a: float, b: float) -> tuple[float, float]:
    """Return ``a * b`` rounded, and its error: together the exact product (Dekker; Ogita et al., algorithm 3.5)."""
    product = a * b
    return product, fma(a, b, -product)


@helper
def dd_add(a: float, a_low: float, b: float, b_low: float) -> tuple[float, float]:
    """Add two double-doubles, within 3u² + 13u³ relative also where they cancel (Joldes et al., algorithm 6)."""
    high, high_error = two_sum(a, b)
    low, low_error = two_sum(a_low, b_low)
    high, low = quick_two_sum(high, high_error + low)
    return quick_two_sum(high, low_error + low)


@helper
def dd_scale(a: float, a_low: float, factor: float) -> tuple[float, float]:
    """Multiply a double-double by a float64, within 2u² relative (Joldes et al., algorithm 9)."""
    product, error = two_product(a, factor)
    return quick_two_sum(product, fma(a_low, factor, error))


@helper
def dd_multiply(a: float, a_low: float, b: float, b_low: float) -> tuple[float, float]:
    """Multiply two double-doubles, within 5u² relative (Joldes et al., algorithm 12)."""
    product, error = two_product(a, b)
    cross = fma(a_low, b, fma(a, b_low, a_low * b_low))
    return quick_two_sum(product, error + cross)


@helper
def expansion_sum(terms: NDArray[np.float64], count: int) -> float:
    """Sum the first ``count`` terms as if exactly, then round: within 2u relative however much they cancel.

    Grows an expansion of numbers that do not overlap, term after term (Shewchuk, figure 6), in the place of the terms:
    ``terms`` float64[>= count] is overwritten.
    """
    length = 0
    for k in range(count):
        carry = terms[k]
        kept = 0
        for i in range(length):
            carry, error = two_sum(carry, terms[i])
            if error != 0.0:
                terms[kept] = error
                kept += 1
        terms[kept] = carry
        length = kept + 1
    total = 0.0
    for i in range(length):
        total += terms[i]
    return total
