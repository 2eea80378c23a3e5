"""The Gaussian: the smooth integrand, on which samplers reach their best rates of convergence.

Pilleboue, Singh, Coeurjolly, Kazhdan, Ostromoukhov 2015, "Variance analysis for Monte Carlo integration", SIGGRAPH: the
best case, where the disk is the worst.

The exact mean over a box is the product of two means of exp(-u^2), with u in units of sigma sqrt(2).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit._builtin.scenes.sample_bounds import square_bounds
from samplekit.kernels import BLOCK, dd_add, dd_multiply, exp_of_minus, fma, helper, kernel, lane_sum, two_difference
from samplekit.quadrature import NODES, WEIGHTS

Array = NDArray[np.float64]

_SQRT_HALF = 0.7071067811865476
_SQRT_HALF_LOW = -4.833646656726457e-17
_HALF_SQRT_PI = 0.886226925452758

_LARGEST_SCALE = 1e200  # limit of 1 / (sigma sqrt(2)): beyond it the mean over any pixel underflows
_LARGEST_SAMPLED_SCALE = 1e100  # keeps squares finite: beyond it a sample's value is 0, or 1 at the centre itself
_FAR = 40.0  # exp(-40^2) underflows, whatever factor of the means multiplies it

_ALWAYS_0 = 746.0  # exponents from 745.14 on underflow to 0
_ALWAYS_1 = 2.0**-55  # exponents up to 2^-54 round to 1


class Gaussian(Scene):
    """exp(-|x - c|^2 / (2 sigma^2)), not periodic.

    Parameters
    ----------
    sigma
        Standard deviation, at least 1e-150.
    cx, cy
        Centre, from -1e50 to 1e50.
    """

    value_range = (0.0, 1.0)

    def __init__(self, sigma: float = 0.1, cx: float = 0.4523, cy: float = 0.5317) -> None:
        self.sigma, self.cx, self.cy = float(sigma), float(cx), float(cy)
        self._sampled_scale = _inverse(self.sigma, _LARGEST_SAMPLED_SCALE)[0]

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the Gaussian over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self._sampled_scale, self.cx, self.cy, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 5e-15 relative, 0 where it underflows."""
        scale = _inverse(self.sigma, _LARGEST_SCALE)
        return np.multiply.outer(gaussian_means(y_edges, self.cy, *scale), gaussian_means(x_edges, self.cx, *scale))

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 0 or 1 where every sample of the pixel rounds to that, NaN elsewhere: float64[h, w].

        Rounding keeps order: the kernel's coordinates of samples lie between those of the edges, computed alike.
        """
        near_x, far_x = _squares(x_edges, self.cx, self._sampled_scale)
        near_y, far_y = _squares(y_edges, self.cy, self._sampled_scale)
        least, most = near_y[:, None] + near_x, far_y[:, None] + far_x
        return np.where(least > _ALWAYS_0, 0.0, np.where(most < _ALWAYS_1, 1.0, np.nan))


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64, float64, float64[::1])")
def _sums(tile: Array, boxes: Array, scale: float, cx: float, cy: float, out: Array) -> None:
    pixels, _, count = tile.shape
    values = np.empty(BLOCK)
    for pixel in range(pixels):
        left, width = (boxes[0, pixel] - cx) * scale, boxes[1, pixel] * scale
        top, height = (boxes[2, pixel] - cy) * scale, boxes[3, pixel] * scale
        for i in range(count):
            x = fma(tile[pixel, 0, i], width, left)
            y = fma(tile[pixel, 1, i], height, top)
            values[i] = exp_of_minus(fma(x, x, y * y))
        out[pixel] = lane_sum(values, count)


def _squares(edges: Array, centre: float, scale: float) -> tuple[Array, Array]:
    """Bound the squares of samples' scaled distances from the centre, as the kernel computes them: float64[m] each."""
    left = (edges[:-1] - centre) * scale
    return square_bounds(left, left + np.diff(edges) * scale)


def _inverse(sigma: float, largest: float) -> tuple[float, float]:
    """Return 1 / (sigma sqrt(2)) as a double-double, at most ``largest``."""
    if sigma * largest < _SQRT_HALF:
        return largest, 0.0
    scale = _SQRT_HALF / sigma
    return scale, (fma(-scale, sigma, _SQRT_HALF) + _SQRT_HALF_LOW) / sigma


def gaussian_means(edges: Array, centre: float, scale: float, scale_low: float = 0.0) -> Array:
    """Average exp(-(scale (x - centre))^2) between neighbouring edges: float64[m] for float64[m + 1].

    Where the function varies little, by Gauss and Legendre's rule. Elsewhere by error functions (NIST DLMF 7.2.1 to
    7.2.3): scaled ones on a flank, where those of both ends would cancel. ``scale`` is a double-double.
    """
    edges = np.ascontiguousarray(edges)
    means = np.empty(edges.size - 1)
    _smooth_means(edges, centre, scale, scale_low, means)
    rough = np.flatnonzero(np.isnan(means))
    if rough.size:
        from scipy.special import erf, erfcx

        ends = np.empty(edges.size)
        heights = np.empty(edges.size)
        _heights(edges, centre, scale, scale_low, ends, heights)
        widths = (edges[rough + 1] - edges[rough]) * scale
        left, right = ends[rough], ends[rough + 1]
        near = np.maximum(np.maximum(left, -right), 0.0)
        far = np.maximum(np.abs(left), np.abs(right))
        height = np.where(left > 0, heights[rough], heights[rough + 1])
        flank = height * (erfcx(near) - np.exp(-(far - near) * (far + near)) * erfcx(far))
        across = (left <= 0) & (right >= 0)
        means[rough] = _HALF_SQRT_PI * np.where(across, erf(right) + erf(-left), flank) / widths
    return means


@helper
def _offset(edge: float, centre: float, scale: float, scale_low: float) -> tuple[float, float]:
    """Return (edge - centre) * scale as a double-double: at 30 sigma exp(-a^2) multiplies errors of a by 900."""
    offset, low = two_difference(edge, centre)
    return dd_multiply(offset, low, scale, scale_low)


@helper
def _gaussian(offset: float, low: float) -> float:
    """Return exp(-(offset + low)^2)."""
    square, square_low = dd_multiply(offset, low, offset, low)
    return math.exp(-square) * (1.0 - square_low)


@kernel("void(float64[::1], float64, float64, float64, float64[::1], float64[::1])")
def _heights(edges: Array, centre: float, scale: float, scale_low: float, ends: Array, heights: Array) -> None:
    for i in range(edges.size):
        offset, low = _offset(edges[i], centre, scale, scale_low)
        ends[i] = min(max(offset, -_FAR), _FAR)
        heights[i] = _gaussian(offset, low) if abs(offset) < _FAR else 0.0


@kernel("void(float64[::1], float64, float64, float64, float64[::1])")
def _smooth_means(edges: Array, centre: float, scale: float, scale_low: float, means: Array) -> None:
    """Average by 24 nodes where exp(-u^2) varies little; write 0 where it underflows, NaN elsewhere.

    At the distance d from the middle c of an interval u^2 = c^2 + 2 c d + d^2. The second term changes its sign with d,
    so the nodes c + d and c - d are summed as pairs.
    """
    for i in range(means.size):
        left, left_low = _offset(edges[i], centre, scale, scale_low)
        right, right_low = _offset(edges[i + 1], centre, scale, scale_low)
        middle, low = dd_add(0.5 * left, 0.5 * left_low, 0.5 * right, 0.5 * right_low)
        width = (edges[i + 1] - edges[i]) * scale
        if left > _FAR or right < -_FAR:
            means[i] = 0.0
        elif width > 1.0 or 2.0 * abs(middle) * width > 6.0:
            means[i] = np.nan
        else:
            mean = 0.0
            for node in range(NODES.size):
                d = 0.5 * width * NODES[node]
                mean += WEIGHTS[node] * math.exp(-d * d) * math.cosh(2.0 * middle * d)
            means[i] = _gaussian(middle, low) * mean
