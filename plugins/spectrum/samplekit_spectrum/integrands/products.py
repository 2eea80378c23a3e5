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

Axis = Callable[["NDArray[Any]"], "NDArray[np.float64]"]

_LEAST_SIGMA, _LARGEST_SIGMA = 1e-6, 1e6


def _product(along_x: Axis, along_y: Axis, scale: float = 1.0) -> Coefficients:
    return lambda mx, my: scale * along_x(np.asarray(mx)) * along_y(np.asarray(my))


def gaussian(name: str, options: Mapping[str, Any]) -> Integrand | None:
    """exp(-|x - c|^2 / 2 sigma^2) cut off at the edges of the unit square, which repeating it makes jumps.

    None for widths beyond 1e-6 to 1e6, where the formula would cancel.
    """
    sigma, cx, cy = float(options["sigma"]), float(options["cx"]), float(options["cy"])
    if not (_LEAST_SIGMA <= sigma <= _LARGEST_SIGMA and abs(cx) <= 1e3 and abs(cy) <= 1e3):
        return None
    mean = math.sqrt(float(_bell(np.zeros(1), cx, sigma)[0] * _bell(np.zeros(1), cy, sigma)[0]))
    # The square of a Gaussian is a Gaussian, sqrt 2 narrower.
    narrow = sigma / math.sqrt(2.0)
    energy = math.sqrt(float(_bell(np.zeros(1), cx, narrow)[0] * _bell(np.zeros(1), cy, narrow)[0]))
    return Integrand(name, mean, energy, _product(lambda m: _bell(m, cx, sigma), lambda m: _bell(m, cy, sigma)))


def _bell(m: NDArray[Any], centre: float, sigma: float) -> NDArray[np.float64]:
    """|integral over [0, 1] of exp(-(x - c)^2 / 2 sigma^2) exp(-2 pi i m x)|^2.

    With a = 1 / (sigma sqrt 2) and b = pi m / a the square is completed, and the integral is sqrt(pi) / 2a times
    exp(-b^2 - 2 pi i m c) (erf(a (1 - c) + i b) - erf(-a c + i b)). The error functions, whose imaginary argument makes
    them overflow, are Faddeeva's w with exp(-b^2) in it: exp(-b^2) erfc(u + i b) = exp(-u^2 - 2 i u b) w(i u - b),
    and the phases of both ends come out as 1, m being an integer (NIST DLMF 7.2.3, 7.7.2).
    """
    from scipy.special import wofz

    m = np.asarray(m, np.float64)
    a = 1.0 / (sigma * math.sqrt(2.0))
    b = np.pi * m / a
    ends = (-a * centre, a * (1.0 - centre))
    total = np.zeros(m.shape, np.complex128)
    for u, sign in zip(ends, (-1.0, 1.0), strict=True):
        # erf(u + i b) = s - s erfc(s u + i s b) with s the sign of u: w is bounded in the upper half plane.
        s = 1.0 if u >= 0.0 else -1.0
        total -= sign * s * math.exp(-u * u) * wofz(1j * s * u - s * b)
        # The constants s cancel where the centre is outside.
        if ends[0] < 0.0 <= ends[1]:
            total += sign * s * np.exp(-b * b - 2j * np.pi * np.fmod(m * centre, 1.0))
    return (np.pi / (4.0 * a * a)) * np.abs(total) ** 2


def bilinear(name: str, options: Mapping[str, Any]) -> Integrand:
    """Return x y: each factor has the coefficients i / (2 pi m), and 1/2 at 0."""
    return Integrand(name, 0.25, 1.0 / 9.0, _product(_ramp, _ramp))


def _ramp(m: NDArray[Any]) -> NDArray[np.float64]:
    with np.errstate(divide="ignore"):
        return np.where(m == 0, 0.25, 1.0 / (2.0 * np.pi * m.astype(np.float64)) ** 2)


def checker(name: str, options: Mapping[str, Any]) -> Integrand:
    """1/2 + 1/2 s(x) s(y), s the square wave of the cells."""
    cells = int(options["cells"])
    level = float(_square_wave(np.zeros(1), cells)[0])
    mean = 0.5 + 0.5 * level
    return Integrand(
        name, mean, mean, _product(lambda m: _square_wave(m, cells), lambda m: _square_wave(m, cells), 0.25)
    )


def _square_wave(m: NDArray[Any], cells: int) -> NDArray[np.float64]:
    """|s(m)|^2 of the wave that alternates between 1 and -1 in cells of one width, a geometric sum over them.

    An even number of cells leaves the frequencies cells / 2 (1 + 2 k): (cells / pi m)^2. An odd number has a cell left
    over: (tan(pi m / cells) / pi m)^2, and 1 / cells^2 at 0.
    """
    m = np.abs(np.asarray(m)).astype(np.int64)
    safe = np.maximum(m, 1).astype(np.float64)
    if cells % 2 == 0:
        return np.where(m % cells == cells // 2, (cells / (np.pi * safe)) ** 2, 0.0)
    rest = np.where(m % cells <= cells // 2, m % cells, m % cells - cells)
    return np.where(m == 0, 1.0 / cells**2, (np.tan(np.pi * rest / cells) / (np.pi * safe)) ** 2)
