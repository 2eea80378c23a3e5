"""The spike: a small bright square on a dark ground, two numbers that may be 60 orders of magnitude apart.

Where no sample meets the square, all samples are equal: the estimate is the ground and its variance is 0, although it
has not converged.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit._builtin.scenes.sample_bounds import sample_bounds
from samplekit.kernels import BLOCK, kernel, lane_sum, two_difference

Array = NDArray[np.float64]


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64, float64, float64[::1])")
def _sums(tile: Array, boxes: Array, square: Array, peak: float, background: float, out: Array) -> None:
    values = np.empty(BLOCK)
    x0, x1, y0, y1 = square[0], square[1], square[2], square[3]
    for pixel in range(tile.shape[0]):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(tile.shape[2]):
            x = left + tile[pixel, 0, i] * width
            y = top + tile[pixel, 1, i] * height
            values[i] = peak if (x >= x0) & (x < x1) & (y >= y0) & (y < y1) else background
        out[pixel] = lane_sum(values, tile.shape[2])


@kernel("void(float64[::1], float64, float64, float64[:,::1])")
def _shares(edges: Array, start: float, end: float, shares: Array) -> None:
    """Write the share of each interval inside [start, end) and the share outside, both without cancellation."""
    for i in range(edges.size - 1):
        left, right = edges[i], edges[i + 1]
        width = right - left
        first, last = max(left, start), min(right, end)
        if last <= first:
            shares[0, i], shares[1, i] = 0.0, 1.0
            continue
        inside, low = two_difference(last, first)
        before, before_low = two_difference(first, left)
        after, after_low = two_difference(right, last)
        shares[0, i] = (inside + low) / width
        shares[1, i] = ((before + after) + (before_low + after_low)) / width


class Spike(Scene):
    """``peak`` in a square of the given area around (cx, cy), ``background`` elsewhere.

    The float64 numbers nearest to c - s/2 and c + s/2, with s = sqrt(area), are the square's sides, for samples and
    reference alike.

    Parameters
    ----------
    peak, background
        The two values, 0 to 1e290: the sum of 2^48 of them is finite.
    area
        Area of the square, 1e-30 to 1.
    cx, cy
        Centre of the square, from -1 to 2.
    """

    def __init__(
        self, peak: float = 1e30, background: float = 1e-30, area: float = 1e-4, cx: float = 0.4523, cy: float = 0.5317
    ) -> None:
        half = 0.5 * math.sqrt(area)
        self.square = np.array([cx - half, cx + half, cy - half, cy + half])
        self.peak, self.background = float(peak), float(background)
        self.value_range = (min(self.peak, self.background), max(self.peak, self.background))

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the value at each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.square, self.peak, self.background, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 2e-15 relative, wherever the edges lie."""
        x0, x1, y0, y1 = self.square
        across, down = np.empty((2, x_edges.size - 1)), np.empty((2, y_edges.size - 1))
        _shares(np.array(x_edges, np.float64), x0, x1, across)
        _shares(np.array(y_edges, np.float64), y0, y1, down)
        covered = np.multiply.outer(down[0], across[0])
        bare = down[1][:, None] + np.multiply.outer(down[0], across[1])
        means: Array = self.peak * covered + self.background * bare
        return means

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value where all samples of the pixel are inside or all outside, NaN elsewhere: float64[h, w]."""
        x0, x1, y0, y1 = self.square
        (left, right), (top, bottom) = sample_bounds(x_edges), sample_bounds(y_edges)
        inside = ((top >= y0) & (bottom < y1))[:, None] & ((left >= x0) & (right < x1))
        outside = ((bottom < y0) | (top >= y1))[:, None] | ((right < x0) | (left >= x1))
        return np.where(inside, self.peak, np.where(outside, self.background, np.nan))
