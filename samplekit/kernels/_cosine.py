"""The cosine of an angle in turns as a polynomial that compilers vectorise: libm's takes six to eight times as long.

The angle is reduced to |t| <= 1/2 without error, so that the accuracy is the same in every turn. On that interval
cos(2 pi t) = 1 + c1 z + ... + c10 z^10 with z = t^2. The coefficients were fitted one after the other in mpmath at 70
digits, each by least squares at 80 Chebyshev points of z in [0, 1/4] with those before it already rounded to float64
(the idea of fpminimax: Brisebarre and Chevillard 2007, "Efficient polynomial L-infinity approximations", ARITH 18):
``benchmarks/coefficients.py`` makes them again. The rounded polynomial is within 3.8e-17 of the cosine. With the
rounding of its evaluation the largest error found is 6.2e-16, over 4e7 random angles and an even grid; the largest of
those was measured again with mpmath.
"""

from __future__ import annotations

import numpy as np

from samplekit.kernels._compile import fma, helper

_C1 = -19.739208802178695
_C2 = 64.93939402266396
_C3 = -85.45681720640431
_C4 = 60.24464136226881
_C5 = -26.426256599757675
_C6 = 7.903534197648212
_C7 = -1.7143742361330825
_C8 = 0.2819258131119026
_C9 = -0.036140200239387854
_C10 = 0.0033613591661678065


@helper
def cosine_of_turns(t: float) -> float:
    """Return cos(2 pi t), within 6.2e-16.

    Parameters
    ----------
    t
        Angle in turns; a whole number of turns gives exactly 1. Beyond 2^52 every float64 is one.
    """
    turn = t - np.rint(t)
    z = turn * turn
    p = fma(_C10, z, _C9)
    p = fma(p, z, _C8)
    p = fma(p, z, _C7)
    p = fma(p, z, _C6)
    p = fma(p, z, _C5)
    p = fma(p, z, _C4)
    p = fma(p, z, _C3)
    p = fma(p, z, _C2)
    p = fma(p, z, _C1)
    return fma(p, z, 1.0)
