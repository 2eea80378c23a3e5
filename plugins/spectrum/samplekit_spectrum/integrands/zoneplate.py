"""The zone plate: Fresnel integrals, since a frequency only moves the chirp along its axis."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

_LEAST_K, _LARGEST_K = 1.0, 1e6
_LARGEST_ARGUMENT = 3e4
"""Beyond it scipy takes the Fresnel integrals as 1/2."""


def zoneplate(name: str, options: Mapping[str, Any]) -> Integrand | None:
    """1/2 + 1/2 cos(k |x - c|^2): f(m) = 1/4 (A(mx) B(my) + conj(A(-mx) B(-my))) for m other than 0.

    None for chirps too slow or too fast for the formula.
    """
    k, cx, cy = float(options["k"]), float(options["cx"]), float(options["cy"])
    if not (_LEAST_K <= k <= _LARGEST_K and max(abs(cx), abs(cy)) <= 10.0):
        return None
    # An end of the chirp is at (x - c - pi m / k) sqrt(2 k / pi).
    reach = int((_LARGEST_ARGUMENT / math.sqrt(2.0 * k / math.pi) - 11.0) * k / math.pi)

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        ahead = _chirp(mx, cx, k) * _chirp(my, cy, k)
        behind = _chirp(-np.asarray(mx), cx, k) * _chirp(-np.asarray(my), cy, k)
        return np.abs(0.25 * (ahead + np.conj(behind))) ** 2

    zero = np.zeros(1)
    first = float((_chirp(zero, cx, k) * _chirp(zero, cy, k)).real[0])
    second = float((_chirp(zero, cx, 2.0 * k) * _chirp(zero, cy, 2.0 * k)).real[0])
    # The square of the cosine is 1/2 + 1/2 cos of twice the angle.
    return Integrand(name, 0.5 + 0.5 * first, 0.375 + 0.5 * first + 0.125 * second, power, reach=reach)


def _chirp(m: NDArray[Any], centre: float, k: float) -> NDArray[np.complex128]:
    """The integral over [0, 1] of exp(i k (x - c)^2 - 2 pi i m x), its square completed (NIST DLMF 7.2.7)."""
    from scipy.special import fresnel

    m = np.asarray(m, np.float64)
    scale = math.sqrt(2.0 * k / math.pi)
    middle = centre + math.pi * m / k
    ends = []
    for x in (0.0, 1.0):
        sine, cosine = fresnel((x - middle) * scale)
        ends.append(cosine + 1j * sine)
    turns = np.fmod(m * centre, 1.0) + np.fmod(0.5 * math.pi * m * m / k, 1.0)
    return np.asarray(np.exp(-2j * np.pi * turns) * (ends[1] - ends[0]) / scale, np.complex128)
