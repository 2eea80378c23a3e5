"""The spectrum of the disk: a Bessel function of the frequency's length."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray


def disk(name: str, options: Mapping[str, Any]) -> Integrand | None:
    """|f(m)| = r J1(2 pi r |m|) / |m|, for a disk within the unit square (Bracewell 2000, "The Fourier transform").

    Returns None for a disk that the square cuts.
    """
    radius, cx, cy = float(options["radius"]), float(options["cx"]), float(options["cy"])
    if not (radius <= min(cx, 1.0 - cx) and radius <= min(cy, 1.0 - cy)):
        return None

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        from scipy.special import j1

        squared = mx.astype(np.float64) ** 2 + my.astype(np.float64) ** 2
        return (radius * j1(2.0 * np.pi * radius * np.sqrt(squared))) ** 2 / squared

    area = math.pi * radius**2
    return Integrand(name, area, area, power)
