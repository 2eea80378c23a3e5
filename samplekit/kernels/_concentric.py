"""The concentric map from the unit square to the unit disk: equal areas, and neighbours stay neighbours.

Shirley and Chiu 1997, "A low distortion map between disk and square", Journal of Graphics Tools 2(3). Squares around
the middle become circles: with the longer offset a and the shorter one b the point has radius a and angle pi/4 b/a from
the longer one's axis. Sine and cosine of pi/4 t are polynomials in t^2 on [-1, 1], fitted as those of
:mod:`samplekit.kernels._cosine` (``benchmarks/coefficients.py``), within 6e-17: without branches the map vectorises.
"""

from __future__ import annotations

from samplekit.kernels._compile import fma, helper

_COSINE = (
    1.0,
    -0.30842513753403916,
    0.015854344243752184,
    -0.0003259918865200662,
    3.5908592407849206e-06,
    -2.460955587619866e-08,
    1.1366971022815318e-10,
)
_SINE = (
    0.7853981633974483,
    -0.08074551218827976,
    0.002490394570182618,
    -3.6576204137613535e-05,
    3.1336158709086883e-07,
    -1.7571217394581216e-09,
    6.8686480919622015e-12,
)


@helper
def disk_point(u: float, v: float) -> tuple[float, float]:
    """The point of the unit disk for (u, v) in [0, 1)^2: uniform there if (u, v) is here; within 3e-16.

    Its distance from the middle is at most 1 + 2^-51.
    """
    a = 2.0 * u - 1.0
    b = 2.0 * v - 1.0
    along_x = abs(a) > abs(b)
    radius = a if along_x else b
    other = b if along_x else a
    # Where the radius is 0 the other offset is 0 as well.
    t = other / (radius if radius != 0.0 else 1.0)
    z = t * t
    c = fma(_COSINE[6], z, _COSINE[5])
    c = fma(c, z, _COSINE[4])
    c = fma(c, z, _COSINE[3])
    c = fma(c, z, _COSINE[2])
    c = fma(c, z, _COSINE[1])
    c = fma(c, z, _COSINE[0]) * radius
    s = fma(_SINE[6], z, _SINE[5])
    s = fma(s, z, _SINE[4])
    s = fma(s, z, _SINE[3])
    s = fma(s, z, _SINE[2])
    s = fma(s, z, _SINE[1])
    s = fma(s, z, _SINE[0]) * t * radius
    return (c if along_x else s), (s if along_x else c)
