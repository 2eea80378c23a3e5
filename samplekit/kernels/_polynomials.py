"""Cosine, exponential and the concentric map as polynomials, which compilers vectorise, unlike the functions of libm.

The coefficients were fitted one after the other in mpmath at 70 digits, each by least squares at 80 Chebyshev points
with those before it already rounded to float64 (the idea of fpminimax: Brisebarre and Chevillard 2007, "Efficient
polynomial L-infinity approximations", ARITH 18): ``benchmarks/coefficients.py`` makes them again.

- cos(2 pi t) in z = t^2, |t| <= 1/2: within 3.8e-17.
- exp(r), |r| <= ln(2) / 2: within 4.7e-18 relative.
- cos(pi/4 t) and sin(pi/4 t) / t in z = t^2, |t| <= 1: within 6e-17.
"""

import numpy as np

from samplekit.kernels._compile import fma, helper

# Coefficients, that of the highest power first.
_COSINE_OF_TURNS = (
    0.0033613591661678065,
    -0.036140200239387854,
    0.2819258131119026,
    -1.7143742361330825,
    7.903534197648212,
    -26.426256599757675,
    60.24464136226881,
    -85.45681720640431,
    64.93939402266396,
    -19.739208802178695,
    1.0,
)
_EXPONENTIAL = (
    2.5112658622693133e-08,
    2.7631526235149347e-07,
    2.7557232865118846e-06,
    2.480148917255337e-05,
    0.00019841269898664948,
    0.0013888888947865923,
    0.008333333333315953,
    0.04166666666651157,
    0.16666666666666685,
    0.5000000000000013,
    1.0,
    1.0,
)
_COSINE = (
    1.1366971022815318e-10,
    -2.460955587619866e-08,
    3.5908592407849206e-06,
    -0.0003259918865200662,
    0.015854344243752184,
    -0.30842513753403916,
    1.0,
)
_SINE = (
    6.8686480919622015e-12,
    -1.7571217394581216e-09,
    3.1336158709086883e-07,
    -3.6576204137613535e-05,
    0.002490394570182618,
    -0.08074551218827976,
    0.7853981633974483,
)

_LOG2_E = 1.4426950408889634
_LN2 = 0.6931471805599453
_LN2_LOW = 2.3190468138462996e-17
_ROUND = 2.0**52
_BEYOND_UNDERFLOW = 760.0
_U64 = np.uint64


@helper
def _polynomial(coefficients: tuple[float, ...], x: float) -> float:
    """Return the polynomial of ``x`` by Horner's rule, with one rounding for each coefficient but the first."""
    value = coefficients[0]
    for coefficient in coefficients[1:]:
        value = fma(value, x, coefficient)
    return value


@helper
def cosine_of_turns(t: float) -> float:
    """Return cos(2 pi t), within 6.2e-16: the largest error over 4e7 random angles and an even grid, by mpmath.

    The angle is reduced to |t| <= 1/2 without error, so that the accuracy is the same in every turn.

    Parameters
    ----------
    t
        Angle in turns; a whole number of turns gives exactly 1. Beyond 2^52 every float64 is one.
    """
    turn = t - np.rint(t)
    return _polynomial(_COSINE_OF_TURNS, turn * turn)


@helper
def exp_of_minus(x: float) -> float:
    """Return exp(-x) for x >= 0, within 0.9 units in the last place: subnormal from 708.4, exactly 0 from 745.14.

    exp(-x) = 2^-n exp(r) with n the nearest whole number to x / ln 2 (Cody and Waite 1980, "Software Manual for the
    Elementary Functions", chapter 6); the fused multiply-add makes their two-part ln 2 exact enough.
    """
    x = min(x, _BEYOND_UNDERFLOW)
    # Added to 2^52 a number is rounded to a whole one, which then stands in the last bits of the mantissa.
    rounded = fma(x, _LOG2_E, _ROUND)
    whole = rounded - _ROUND
    p = _polynomial(_EXPONENTIAL, fma(whole, _LN2_LOW, fma(whole, _LN2, -x)))
    # 2^-n as two powers of two that are both normal numbers, so that only the last product rounds to a subnormal.
    n = np.float64(rounded).view(np.uint64) & _U64(0xFFF)
    half = n >> _U64(1)
    first = (_U64(1023) - half) << _U64(52)
    second = (_U64(1023) - (n - half)) << _U64(52)
    return p * _U64(first).view(np.float64) * _U64(second).view(np.float64)


@helper
def disk_point(u: float, v: float) -> tuple[float, float]:
    """The point of the unit disk for (u, v) in [0, 1)^2: uniform there if (u, v) is here; within 3e-16.

    Its distance from the middle is at most 1 + 2^-51. The map is that of Shirley and Chiu 1997, "A low distortion map
    between disk and square", Journal of Graphics Tools 2(3): areas are equal up to a factor, neighbours stay
    neighbours, and squares around the middle become circles. With the longer offset a and the shorter one b the point
    has radius a and angle pi/4 b/a from the longer one's axis.
    """
    a = 2.0 * u - 1.0
    b = 2.0 * v - 1.0
    along_x = abs(a) > abs(b)
    radius = a if along_x else b
    other = b if along_x else a
    # Where the radius is 0 the other offset is 0 as well.
    t = other / (radius if radius != 0.0 else 1.0)
    c = _polynomial(_COSINE, t * t) * radius
    s = _polynomial(_SINE, t * t) * t * radius
    return (c if along_x else s), (s if along_x else c)
