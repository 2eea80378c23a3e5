"""The product x y: the plainest integrand that is not a sum of functions of one coordinate.

Christensen, Kensler, Kilpatrick 2018, "Progressive multi-jittered sample sequences", EGSR: one of its smooth functions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit.kernels import BLOCK, fma, kernel, lane_sum

Array = NDArray[np.float64]


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1])")
def _sums(tile: Array, boxes: Array, out: Array) -> None:
    values = np.empty(BLOCK)
    for pixel in range(tile.shape[0]):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(tile.shape[2]):
            values[i] = fma(tile[pixel, 0, i], width, left) * fma(tile[pixel, 1, i], height, top)
        out[pixel] = lane_sum(values, tile.shape[2])


class Bilinear(Scene):
    """The function x y."""

    value_range = (0.0, 1.0)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum x y over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel, the product of its middle's coordinates: float64[h, w]."""
        return np.multiply.outer(0.5 * (y_edges[:-1] + y_edges[1:]), 0.5 * (x_edges[:-1] + x_edges[1:]))
