"""The spectrum of the zone plate: Fresnel integrals, since multiplying a chirp by a wave only moves the chirp."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

_LARGEST_ARGUMENT = 3e4
"""For larger arguments SciPy rounds the Fresnel integrals to 1/2."""


def zoneplate(name: str, options: Mapping[str, Any]) -> Integrand | None:
    """1/2 + 1/2 cos(k |x - c|^2): f(m) = 1/4 (A(mx) B(my) + conj(A(-mx) B(-my))) for m other than 0.

    Returns None for chirps that are too slow or too fast for the formula, or too far from the square.
    """
    k, cx, cy = float(options["k"]), float(options["cx"]), float(options["cy"])
    if not (1.0 <= k <= 1e6 and max(abs(cx), abs(cy)) <= 10.0):
        return None
    # The arguments of the Fresnel integrals are (x - c - pi m / k) sqrt(2 k / pi), with x 0 and 1.
    reach = int((_LARGEST_ARGUMENT / math.sqrt(2.0 * k / math.pi) - 11.0) * k / math.pi)

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        ahead = _chirp(mx, cx, k) * _chirp(my, cy, k)
        behind = _chirp(-mx, cx, k) * _chirp(-my, cy, k)
        return np.abs(0.25 * (ahead + np.conj(behind))) ** 2

    zero = np.zeros(1)
    first, second = (float((_chirp(zero, cx, speed) * _chirp(zero, cy, speed)).real[0]) for speed in (k, 2.0 * k))
    # cos(a)^2 = 1/2 + 1/2 cos(2 a).
    return Integrand(name, 0.5 + 0.5 * first, 0.375 + 0.5 * first + 0.125 * second, power, reach=reach)


def _chirp(m: NDArray[Any], centre: float, k: float) -> NDArray[np.complex128]:
    """The integral over [0, 1] of exp(i k (x - c)^2 - 2 pi i m x), its square completed (NIST DLMF 7.2.7)."""
    from scipy.special import fresnel

    m = m.astype(np.float64)
    scale = math.sqrt(2.0 * k / math.pi)
    middle = centre + math.pi * m / k
    ends = []
    for x in (0.0, 1.0):
        sine, cosine = fresnel((x - middle) * scale)
        ends.append(cosine + 1j * sine)
    turns = np.fmod(m * centre, 1.0) + np.fmod(0.5 * math.pi * m * m / k, 1.0)
    return np.asarray(np.exp(-2j * np.pi * turns) * (ends[1] - ends[0]) / scale, np.complex128)
