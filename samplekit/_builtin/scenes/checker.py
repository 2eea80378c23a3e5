"""The checkerboard, whose edges lie along the axes: on them all rows of a grid of samples err alike.

The exact mean over a box is separable: 1/2 + 1/2 S(x0, x1) S(y0, y1), where S is the mean of the square wave that
alternates between 1 and -1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit.kernels import BLOCK, fma, helper, kernel, lane_sum, two_product

Array = NDArray[np.float64]


class Checker(Scene):
    """1 where floor(cells x) + floor(cells y) is even, else 0.

    For samples cell j begins at the float64 nearest to j / cells, and every sample stays below the right edge of its
    pixel. A pixel edge i / w that equals j / cells is that same float64, so that rounding moves no sample into the next
    cell. The reference has its edges at the real numbers j / cells, at most half a unit in the last place away.

    Parameters
    ----------
    cells
        Cells along the unit square's side, 1 to 2^20.
    """

    value_range = (0.0, 1.0)

    def __init__(self, cells: int = 8) -> None:
        self.cells = float(cells)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count each pixel's samples in even cells: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.cells, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 1e-15."""
        x_means, y_means = np.empty(x_edges.size - 1), np.empty(y_edges.size - 1)
        _means(np.ascontiguousarray(x_edges), self.cells, x_means)
        _means(np.ascontiguousarray(y_edges), self.cells, y_means)
        return 0.5 + 0.5 * np.multiply.outer(y_means, x_means)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value of the pixels whose first and last sample are in one cell, NaN elsewhere: float64[h, w]."""
        x_signs, y_signs = np.empty(x_edges.size - 1), np.empty(y_edges.size - 1)
        _signs(np.ascontiguousarray(x_edges), self.cells, x_signs)
        _signs(np.ascontiguousarray(y_edges), self.cells, y_signs)
        return 0.5 + 0.5 * np.multiply.outer(y_signs, x_signs)


@helper
def _sign(cell: float) -> float:
    """Return 1 for an even cell, -1 for an odd one."""
    return 1.0 - 2.0 * float(cell - 2.0 * np.floor(0.5 * cell))


@helper
def _cell(x: float, cells: float) -> float:
    """Return the last cell that begins at or before ``x``: that of the nearest edge, or the one before it."""
    nearest = np.rint(x * cells)
    return float(nearest - (1.0 if nearest / cells > x else 0.0))


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64[::1])")
def _sums(tile: Array, boxes: Array, cells: float, out: Array) -> None:
    pixels, _, count = tile.shape
    values = np.empty(BLOCK)
    for pixel in range(pixels):
        left, width = boxes[0, pixel], boxes[1, pixel]
        top, height = boxes[2, pixel], boxes[3, pixel]
        last_x, last_y = np.nextafter(left + width, left), np.nextafter(top + height, top)
        for i in range(count):
            x = min(fma(tile[pixel, 0, i], width, left), last_x)
            y = min(fma(tile[pixel, 1, i], height, top), last_y)
            values[i] = 0.5 + 0.5 * _sign(_cell(x, cells) + _cell(y, cells))
        out[pixel] = lane_sum(values, count)


@kernel("void(float64[::1], float64, float64[::1])")
def _signs(edges: Array, cells: float, signs: Array) -> None:
    """Write the sign of the cell that holds all samples between neighbouring edges, NaN where they are in several."""
    for i in range(signs.size):
        left, width = edges[i], edges[i + 1] - edges[i]
        first, last = _cell(left, cells), _cell(np.nextafter(left + width, left), cells)
        signs[i] = _sign(first) if first == last else np.nan


@helper
def _split(edge: float, cells: float) -> tuple[float, float, float]:
    """Return the cell of an edge, and the edge's distances from the cell's start and end, accurate to the last bit."""
    product, error = two_product(edge, cells)
    cell = np.floor(product)
    if product == cell and error < 0.0:
        cell -= 1.0
    return cell, (product - cell) + error, ((cell + 1.0) - product) - error


@kernel("void(float64[::1], float64, float64[::1])")
def _means(edges: Array, cells: float, means: Array) -> None:
    """Average the square wave between neighbouring edges, within 4e-16.

    The cells between the first and the last cancel in pairs; the ends are left, and one cell if their number is odd.
    """
    for i in range(means.size):
        first, _, after = _split(edges[i], cells)
        last, before, _ = _split(edges[i + 1], cells)
        if first == last:
            means[i] = _sign(first)
        else:
            between = last - first - 1.0
            unpaired = between - 2.0 * np.floor(0.5 * between)
            integral = _sign(first) * (after - unpaired) + _sign(last) * before
            means[i] = integral / (between + after + before)
