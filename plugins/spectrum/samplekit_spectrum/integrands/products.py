"""Integrands that are products of a function of x and one of y: Gaussian, x y, checkerboard."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.integrands.integrand import Coefficients, Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

Factor = Callable[["NDArray[Any]"], "NDArray[np.float64]"]


def _product(along_x: Factor, along_y: Factor, scale: float = 1.0) -> Coefficients:
    return lambda mx, my: scale * along_x(mx) * along_y(my)


def gaussian(name: str, options: Mapping[str, Any]) -> Integrand | None:
    """exp(-|x - c|^2 / 2 sigma^2), cut off at the edges of the unit square: repeating it makes jumps there.

    Returns None for a sigma outside of 1e-6 to 1e6, and for a centre beyond 1000, where the formula would cancel.
    """
    sigma, cx, cy = float(options["sigma"]), float(options["cx"]), float(options["cy"])
    if not (1e-6 <= sigma <= 1e6 and abs(cx) <= 1e3 and abs(cy) <= 1e3):
        return None
    zero = np.zeros(1)
    # The square of a Gaussian is a Gaussian with sigma / sqrt 2.
    mean, energy = (
        math.sqrt(float(_bell(zero, cx, width)[0] * _bell(zero, cy, width)[0]))
        for width in (sigma, sigma / math.sqrt(2.0))
    )
    return Integrand(name, mean, energy, _product(lambda m: _bell(m, cx, sigma), lambda m: _bell(m, cy, sigma)))


def _bell(m: NDArray[Any], centre: float, sigma: float) -> NDArray[np.float64]:
    """|integral over [0, 1] of exp(-(x - c)^2 / 2 sigma^2) exp(-2 pi i m x)|^2.

    With a = 1 / (sigma sqrt 2) and b = pi m / a the square is completed, and the integral is sqrt(pi) / 2a times
    exp(-b^2 - 2 pi i m c) (erf(a (1 - c) + i b) - erf(-a c + i b)). The error functions overflow, so they are replaced
    by Faddeeva's w, which contains exp(-b^2): exp(-b^2) erfc(u + i b) = exp(-u^2 - 2 i u b) w(i u - b). The phases at
    both ends are 1, since m is an integer (NIST DLMF 7.2.3, 7.7.2).
    """
    from scipy.special import wofz

    m = m.astype(np.float64)
    a = 1.0 / (sigma * math.sqrt(2.0))
    b = np.pi * m / a
    ends = (-a * centre, a * (1.0 - centre))
    total = np.zeros(m.shape, np.complex128)
    for u, sign in zip(ends, (-1.0, 1.0), strict=True):
        # erf(u + i b) = s - s erfc(s u + i s b) with the sign s of u, since w is bounded in the upper half plane.
        s = 1.0 if u >= 0.0 else -1.0
        total -= sign * s * math.exp(-u * u) * wofz(1j * s * u - s * b)
        # The constants s cancel if the centre is outside of the square.
        if ends[0] < 0.0 <= ends[1]:
            total += sign * s * np.exp(-b * b - 2j * np.pi * np.fmod(m * centre, 1.0))
    return (np.pi / (4.0 * a * a)) * np.abs(total) ** 2


def bilinear(name: str, options: Mapping[str, Any]) -> Integrand:
    """X y, whose factors have the coefficients i / (2 pi m), and 1/2 at 0."""
    return Integrand(name, 0.25, 1.0 / 9.0, _product(_ramp, _ramp))


def _ramp(m: NDArray[Any]) -> NDArray[np.float64]:
    with np.errstate(divide="ignore"):
        return np.where(m == 0, 0.25, 1.0 / (2.0 * np.pi * m.astype(np.float64)) ** 2)


def checker(name: str, options: Mapping[str, Any]) -> Integrand:
    """1/2 + 1/2 s(x) s(y), where s is the square wave with as many cells."""
    cells = int(options["cells"])

    def wave(m: NDArray[Any]) -> NDArray[np.float64]:
        return _square_wave(m, cells)

    mean = 0.5 + 0.5 * float(wave(np.zeros(1))[0])
    return Integrand(name, mean, mean, _product(wave, wave, 0.25))


def _square_wave(m: NDArray[Any], cells: int) -> NDArray[np.float64]:
    """|s(m)|^2 of the wave that alternates between 1 and -1 in cells of equal width: a geometric sum over the cells.

    For an even number of cells it is (cells / pi m)^2 at the frequencies cells / 2 (1 + 2 k), and 0 elsewhere. For an
    odd number it is (tan(pi m / cells) / pi m)^2, and 1 / cells^2 at 0.
    """
    m = np.abs(m).astype(np.int64)
    safe = np.maximum(m, 1).astype(np.float64)
    if cells % 2 == 0:
        return np.where(m % cells == cells // 2, (cells / (np.pi * safe)) ** 2, 0.0)
    rest = np.where(m % cells <= cells // 2, m % cells, m % cells - cells)
    return np.where(m == 0, 1.0 / cells**2, (np.tan(np.pi * rest / cells) / (np.pi * safe)) ** 2)
