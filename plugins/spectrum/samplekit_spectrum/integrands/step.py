"""The step: the unit square cut by a line is a polygon, whose coefficients are sums over its edges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit.kernels import direction
from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

_SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def step(name: str, options: Mapping[str, Any]) -> Integrand:
    """1 where cos(angle) x + sin(angle) y < offset.

    Gauss's theorem for m exp(-2 pi i m.x): f(m) = i / (2 pi |m|^2) times the sum over the polygon's edges of
    (m.n) L sinc(m.t L) exp(-2 pi i m.c), with outward normal n, direction t, length L and middle c.
    """
    # The line of the scene, rounded as the scene rounds it.
    cosine, sine = direction(float(options["angle"]))
    corners = _cut(cosine, sine, float(options["offset"]))
    area = 0.5 * math.fsum(
        x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1], strict=True)
    )
    straight = cosine == 0.0 or sine == 0.0

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        x, y = np.asarray(mx, np.float64), np.asarray(my, np.float64)
        total = np.zeros(np.broadcast(x, y).shape, np.complex128)
        for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1], strict=True):
            dx, dy = x1 - x0, y1 - y0
            # The corners run so that the inside is on the left in the mathematician's axes: the normal is (dy, -dx) /
            # L.
            phase = np.fmod(x * (0.5 * (x0 + x1)), 1.0) + np.fmod(y * (0.5 * (y0 + y1)), 1.0)
            total += (x * dy - y * dx) * np.sinc(x * dx + y * dy) * np.exp(-2j * np.pi * phase)
        return np.abs(total) ** 2 / (2.0 * np.pi * (x * x + y * y)) ** 2

    return Integrand(name, area, area, power, axes_only=straight)


def _cut(cosine: float, sine: float, offset: float) -> list[tuple[float, float]]:
    """The corners of the part of the unit square below the line (Sutherland, Hodgman 1974)."""
    kept: list[tuple[float, float]] = []
    for (x0, y0), (x1, y1) in zip(_SQUARE, _SQUARE[1:] + _SQUARE[:1], strict=True):
        before, after = cosine * x0 + sine * y0 - offset, cosine * x1 + sine * y1 - offset
        if before < 0.0:
            kept.append((x0, y0))
        if (before < 0.0) != (after < 0.0):
            share = before / (before - after)
            kept.append((x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
    return kept
