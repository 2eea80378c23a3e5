"""The product x y: the plainest integrand that is not a sum of functions of one coordinate.

Christensen, Kensler, Kilpatrick 2018, "Progressive multi-jittered sample sequences", EGSR: one of its smooth functions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Scene
from samplekit.kernels import BLOCK, fma, kernel, lane_sum

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Bilinear(Scene):
    """The function x y."""

    def sums(self, tile: NDArray[np.float64], boxes: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Sum x y over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, out)

    def exact(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """Integrate over each pixel's box: its mean float64[h, w], the product of the midpoints."""
        return np.multiply.outer(0.5 * (y_edges[:-1] + y_edges[1:]), 0.5 * (x_edges[:-1] + x_edges[1:]))


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1])")
def _sums(tile: NDArray[np.float64], boxes: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    pixels, _, count = tile.shape
    values = np.empty(BLOCK)
    for pixel in range(pixels):
        left, width = boxes[0, pixel], boxes[1, pixel]
        top, height = boxes[2, pixel], boxes[3, pixel]
        for i in range(count):
            values[i] = fma(tile[pixel, 0, i], width, left) * fma(tile[pixel, 1, i], height, top)
        out[pixel] = lane_sum(values, count)
