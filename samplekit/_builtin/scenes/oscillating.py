"""Genz's test integrands: six families in 1 to 12 dimensions, of any difficulty.

Genz 1984, "Testing multidimensional integration routines", in Tools, Methods and Languages for Scientific and
Engineering Computation. Each integrand is divided by its largest value, so that it never overflows. With the
coefficients a_i = difficulty (2 i - 1) / d², whose sum is the difficulty, and one place u for all dimensions:

    oscillatory     cos(2 pi u + sum a_i x_i)
    product-peak    product 1 / (1 + (a_i (x_i - u))²)
    corner-peak     (1 + sum a_i x_i)^-(d + 1)
    gaussian        exp(-sum (a_i (x_i - u))²)
    continuous      exp(-sum a_i |x_i - u|)
    discontinuous   exp(sum a_i (x_i - v_i)), v = (u, u, 1, ..., 1); 0 where x_1 > u or x_2 > u

The picture's x and y are x_1 and x_2. All others are dimensions of the purpose ``further``: like the bounces of a path
they are not part of a pixel, a lens or a time. In one dimension the picture does not depend on y.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit._builtin.declarations.scenes import GENZ_FAMILIES
from samplekit.kernels import BLOCK, cosine_of_turns, exp_of_minus, fma, kernel, lane_sum

Array = NDArray[np.float64]


@kernel("void(float64[:,:,::1], float64[:,::1], int64, float64[::1], float64, float64[::1])")
def _sums(tile: Array, boxes: Array, family: int, a: Array, u: float, out: Array) -> None:
    values, x = np.empty(BLOCK), np.empty(12)
    dims = a.size
    for pixel in range(tile.shape[0]):
        for i in range(tile.shape[2]):
            for k in range(dims):
                x[k] = tile[pixel, k, i]
                if k < 2:
                    x[k] = fma(x[k], boxes[2 * k + 1, pixel], boxes[2 * k, pixel])
            if family == 0:
                turns = u
                for k in range(dims):
                    turns = fma(a[k], x[k], turns)
                values[i] = cosine_of_turns(turns)
            elif family == 1:
                product = 1.0
                for k in range(dims):
                    away = a[k] * (x[k] - u)
                    product /= fma(away, away, 1.0)
                values[i] = product
            elif family == 2:
                total = 1.0
                for k in range(dims):
                    total = fma(a[k], x[k], total)
                values[i] = total ** -(dims + 1.0)
            else:
                exponent = 0.0
                beyond = False
                for k in range(dims):
                    if family == 3:
                        away = a[k] * (x[k] - u)
                        exponent = fma(away, away, exponent)
                    elif family == 4:
                        exponent = fma(a[k], abs(x[k] - u), exponent)
                    elif k < 2:
                        beyond |= x[k] > u
                        exponent = fma(a[k], u - x[k], exponent)
                    else:
                        exponent = fma(a[k], 1.0 - x[k], exponent)
                values[i] = 0.0 if beyond else exp_of_minus(exponent)
        out[pixel] = lane_sum(values, tile.shape[2])


class Oscillating(Scene):
    """One of Genz's integrands.

    The coefficients are rounded to float64 numbers, which define the integrand for samples and reference alike. Those
    of ``oscillatory`` are in turns, a_i / 2 pi.

    Parameters
    ----------
    family
        Name of the family.
    d
        Number of dimensions, 1 to 12.
    difficulty
        The sum of the coefficients, 1e-9 to 1e12.
    u
        Place of the peak, kink or step in every dimension, or the phase in turns: 0 to 1.
    """

    def __init__(self, family: str = "oscillatory", d: int = 2, difficulty: float = 10.0, u: float = 0.4523) -> None:
        self.family, self.u = family, float(u)
        self.coefficients = difficulty * (2.0 * np.arange(1, d + 1) - 1.0) / d**2
        if family == "oscillatory":
            self.coefficients /= 2.0 * math.pi

    def dimensions(self) -> dict[str, int]:
        """Return two dimensions for the pixel, the others as ``further``."""
        d = self.coefficients.size
        return {"pixel": 2, "further": d - 2} if d > 2 else {"pixel": 2}

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the integrand over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, GENZ_FAMILIES.index(self.family), self.coefficients, self.u, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel and all further dimensions: float64[h, w].

        It is within 2e-15 absolute for ``oscillatory``, for the others within 5e-14 relative where it is a normal
        number.
        """
        x, y = np.array(x_edges, np.float64), np.array(y_edges, np.float64)
        return self._means((x[:-1].copy(), x[1:].copy()), (y[:-1].copy(), y[1:].copy()))

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the mean over all further dimensions at the points x by y: float64[h, w], as exact as ``exact``."""
        x, y = np.array(x, np.float64), np.array(y, np.float64)
        return self._means((x, x), (y, y))

    def _means(self, x: tuple[Array, Array], y: tuple[Array, Array]) -> Array:
        from samplekit._builtin.scenes.genz_means import genz_means

        return genz_means(self.family, self.coefficients, self.u, x, y)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 0 for the pixels beyond the discontinuity, NaN elsewhere: float64[h, w]."""
        known = np.full((y_edges.size - 1, x_edges.size - 1), np.nan)
        if self.family == "discontinuous":
            known[:, x_edges[:-1] > self.u] = 0.0
            if self.coefficients.size > 1:
                known[y_edges[:-1] > self.u] = 0.0
        return known
