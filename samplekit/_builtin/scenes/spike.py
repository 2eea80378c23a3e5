"""The spike: a small bright square on a dark ground, the dynamic range of a lamp seen from a cellar.

Its mean is that of two numbers which may be 60 orders of magnitude apart. Where no sample meets the square, every
sample is the same: the estimate is the ground, its variance 0, and it has not converged.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Scene, UsageError
from samplekit.kernels import BLOCK, kernel, lane_sum, two_difference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

LARGEST = 1e290
"""Of peak and background: the sum of 2^48 of them is finite."""


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
    """Write the part of each interval inside [start, end) and the part outside, both without cancellation."""
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
    """``peak`` in a square of that area around (cx, cy), ``background`` elsewhere.

    The square's sides are the float64 numbers c - s/2 and c + s/2 with s = sqrt(area), rounded: they are the scene,
    for samples and reference alike.

    Parameters
    ----------
    peak, background
        0 to 1e290.
    area
        1e-30 to 1.
    cx, cy
        The centre, from -1 to 2.

    Raises
    ------
    UsageError
        A parameter outside its range, or NaN.
    """

    def __init__(
        self,
        peak: float = 1e30,
        background: float = 1e-30,
        area: float = 1e-4,
        cx: float = 0.4523,
        cy: float = 0.5317,
    ) -> None:
        for name, value, least, most in (
            ("peak", peak, 0.0, LARGEST),
            ("background", background, 0.0, LARGEST),
            ("area", area, 1e-30, 1.0),
            ("cx", cx, -1.0, 2.0),
            ("cy", cy, -1.0, 2.0),
        ):
            if not least <= value <= most:
                raise UsageError(f"spike: {name}={value} must be from {least:g} to {most:g}")
        half = 0.5 * math.sqrt(area)
        self.square = np.array([cx - half, cx + half, cy - half, cy + half])
        self.peak, self.background = float(peak), float(background)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum peaks and background over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.square, self.peak, self.background, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Integrate over each pixel's box: its mean float64[h, w], within 2e-15 relative, wherever the edges lie."""
        x0, x1, y0, y1 = self.square
        across, down = np.empty((2, x_edges.size - 1)), np.empty((2, y_edges.size - 1))
        _shares(np.array(x_edges, np.float64), x0, x1, across)
        _shares(np.array(y_edges, np.float64), y0, y1, down)
        covered = np.multiply.outer(down[0], across[0])
        bare = down[1][:, None] + np.multiply.outer(down[0], across[1])
        means: Array = self.peak * covered + self.background * bare
        return means

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Find the pixels that lie on one side of all the square's edges, rounding included; NaN elsewhere."""
        x0, x1, y0, y1 = self.square
        (left, right), (top, bottom) = _extent(x_edges), _extent(y_edges)
        inside = ((top >= y0) & (bottom < y1))[:, None] & ((left >= x0) & (right < x1))
        outside = ((bottom < y0) | (top >= y1))[:, None] | ((right < x0) | (left >= x1))
        return np.where(inside, self.peak, np.where(outside, self.background, np.nan))


def _extent(edges: Array) -> tuple[Array, Array]:
    """Bound the samples of each interval from below and above; the slack is for widths that were rounded otherwise."""
    first = np.asarray(edges[:-1], np.float64)
    return first, np.maximum(first + np.diff(edges) * (1.0 + 2.0**-50), edges[1:])
