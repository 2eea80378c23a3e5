"""The spectrum of the step: one side of a line in the unit square is a polygon, and f(m) is a sum over its edges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit.kernels import direction
from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

Corner = tuple[float, float]

_SQUARE: list[Corner] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def step(name: str, options: Mapping[str, Any]) -> Integrand:
    """1 where cos(angle) x + sin(angle) y < offset.

    Gauss's theorem for m exp(-2 pi i m.x): f(m) = i / (2 pi |m|^2) times the sum over the polygon's edges of
    (m.n) L sinc(m.t L) exp(-2 pi i m.c), with outward normal n, direction t, length L and middle c.
    """
    # The scene rounds its line in the same way.
    cosine, sine = direction(float(options["angle"]))
    edges = _edges(_cut(cosine, sine, float(options["offset"])))
    area = 0.5 * math.fsum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in edges)

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        x, y = mx.astype(np.float64), my.astype(np.float64)
        total = np.zeros(x.shape, np.complex128)
        for (x0, y0), (x1, y1) in edges:
            dx, dy = x1 - x0, y1 - y0
            # With y upwards, the corners run counterclockwise: the outward normal is (dy, -dx) / L.
            phase = np.fmod(x * (0.5 * (x0 + x1)), 1.0) + np.fmod(y * (0.5 * (y0 + y1)), 1.0)
            total += (x * dy - y * dx) * np.sinc(x * dx + y * dy) * np.exp(-2j * np.pi * phase)
        return np.abs(total) ** 2 / (2.0 * np.pi * (x * x + y * y)) ** 2

    return Integrand(name, area, area, power, axes_only=cosine == 0.0 or sine == 0.0)


def _edges(corners: list[Corner]) -> list[tuple[Corner, Corner]]:
    """Return the edges of a polygon, each as its two ends."""
    return list(zip(corners, corners[1:] + corners[:1], strict=True))


def _cut(cosine: float, sine: float, offset: float) -> list[Corner]:
    """Return the corners of the part of the unit square below the line (Sutherland, Hodgman 1974)."""
    kept: list[Corner] = []
    for (x0, y0), (x1, y1) in _edges(_SQUARE):
        before, after = cosine * x0 + sine * y0 - offset, cosine * x1 + sine * y1 - offset
        if before < 0.0:
            kept.append((x0, y0))
        if (before < 0.0) != (after < 0.0):
            share = before / (before - after)
            kept.append((x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
    return kept
