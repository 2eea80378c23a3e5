"""The power |x|^-a, unbounded at the left edge of the picture, with an infinite variance for a >= 1/2.

The square of |x|^-a has a finite integral for a < 1/2 only. From there on the variance of an estimate is infinite, the
error of random points falls as N^-(1 - a) instead of N^-1/2, and a standard error means nothing. Owen 2006, "Halton
sequences avoid the origin", SIAM Review 48, analyses such integrands.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit.kernels import BLOCK, fma, kernel, lane_sum

Array = NDArray[np.float64]


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64[::1])")
def _sums(tile: Array, boxes: Array, a: float, out: Array) -> None:
    values = np.empty(BLOCK)
    for pixel in range(tile.shape[0]):
        left, width = boxes[0, pixel], boxes[1, pixel]
        for i in range(tile.shape[2]):
            values[i] = abs(fma(tile[pixel, 0, i], width, left)) ** -a
        out[pixel] = lane_sum(values, tile.shape[2])


def _integral_from_zero(x: Array, a: float) -> Array:
    """Integrate over [0, x]."""
    integral: Array = x ** (1.0 - a) / (1.0 - a)
    return integral


def _mean_between(near: Array, far: Array, a: float) -> Array:
    """Average over [near, far], 0 < near < far: far^b (1 - (near / far)^b) / (b (far - near)) with b = 1 - a."""
    b = 1.0 - a
    ratio = (far - near) / near
    logarithm = np.where(np.isfinite(ratio), np.log1p(ratio), np.log(far) - np.log(near))
    mean: Array = far**b * -np.expm1(-b * logarithm) / (b * (far - near))
    return mean


class Power(Scene):
    """|x|^-a; infinite at x = 0.

    Parameters
    ----------
    a
        The exponent, 0 to 0.99. The variance is finite for a < 0.5, and that of squared errors for a < 0.25.
    """

    def __init__(self, a: float = 0.25) -> None:
        self.a = float(a)
        self.finite_variance = self.a < 0.5
        self.finite_kurtosis = self.a < 0.25

    def notes(self) -> list[str]:
        """Return a warning if the variance is infinite."""
        if self.finite_variance:
            return []
        what = f"the variance of |x|^-{self.a:g} is infinite (it is finite for a < 0.5)"
        return [f"{what}: errors fall slower than N^-1/2, and a standard error means nothing"]

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the power over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.a, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 4e-15 relative, wherever the edges lie."""
        x = np.asarray(x_edges, np.float64)
        left, right = x[:-1], x[1:]
        near, far = np.minimum(abs(left), abs(right)), np.maximum(abs(left), abs(right))
        with np.errstate(all="ignore"):
            means = _mean_between(near, far, self.a)
            across = (_integral_from_zero(abs(left), self.a) + _integral_from_zero(abs(right), self.a)) / (right - left)
        means = np.where((left <= 0.0) & (right >= 0.0), across, means)
        return np.broadcast_to(means, (y_edges.size - 1, means.size)).copy()

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 where a = 0, else NaN: float64[h, w]."""
        return np.full((y_edges.size - 1, x_edges.size - 1), 1.0 if self.a == 0.0 else np.nan)
