"""The exponential of a negative number as a polynomial that compilers vectorise: four times as fast as libm's.

exp(-x) = 2^-n exp(r) with n the nearest whole number to x / ln 2 and |r| <= ln(2) / 2 (Cody and Waite 1980, "Software
Manual for the Elementary Functions", chapter 6); the fused multiply-add makes their two-part ln 2 exact enough.
exp(r) = 1 + r + c2 r^2 + ... + c11 r^11: the coefficients were fitted one after the other in mpmath at 70 digits, each
by least squares at 80 Chebyshev points with those before it already rounded to float64
(``benchmarks/coefficients.py``). The rounded polynomial is within 4.7e-18 relative; what remains is the rounding of its
evaluation.
"""

from __future__ import annotations

import numpy as np

from samplekit.kernels._compile import fma, helper

_C2 = 0.5000000000000013
_C3 = 0.16666666666666685
_C4 = 0.04166666666651157
_C5 = 0.008333333333315953
_C6 = 0.0013888888947865923
_C7 = 0.00019841269898664948
_C8 = 2.480148917255337e-05
_C9 = 2.7557232865118846e-06
_C10 = 2.7631526235149347e-07
_C11 = 2.5112658622693133e-08

_LOG2_E = 1.4426950408889634
_LN2 = 0.6931471805599453
_LN2_LOW = 2.3190468138462996e-17
_ROUND = 2.0**52
_BEYOND_UNDERFLOW = 760.0

_U64 = np.uint64
_ONE = _U64(1)
_LOW_BITS = _U64(0xFFF)
_BIAS = _U64(1023)
_MANTISSA = _U64(52)


@helper
def exp_of_minus(x: float) -> float:
    """Return exp(-x) for x >= 0, within 0.9 units in the last place: subnormal from 708.4, exactly 0 from 745.14."""
    x = min(x, _BEYOND_UNDERFLOW)
    # Added to 2^52 a number is rounded to a whole one, which then stands in the last bits of the mantissa.
    rounded = fma(x, _LOG2_E, _ROUND)
    whole = rounded - _ROUND
    r = fma(whole, _LN2_LOW, fma(whole, _LN2, -x))
    p = fma(_C11, r, _C10)
    p = fma(p, r, _C9)
    p = fma(p, r, _C8)
    p = fma(p, r, _C7)
    p = fma(p, r, _C6)
    p = fma(p, r, _C5)
    p = fma(p, r, _C4)
    p = fma(p, r, _C3)
    p = fma(p, r, _C2)
    p = fma(p, r, 1.0)
    p = fma(p, r, 1.0)
    # 2^-n as two powers of two that are both normal numbers, so that only the last product rounds to a subnormal.
    n = np.float64(rounded).view(np.uint64) & _LOW_BITS
    half = n >> _ONE
    first = (_BIAS - half) << _MANTISSA
    second = (_BIAS - (n - half)) << _MANTISSA
    return p * np.uint64(first).view(np.float64) * np.uint64(second).view(np.float64)
