"""The checkerboard: edges along the axes, on which grids of samples are lucky or unlucky as a whole.

The exact mean over a box is separable: 1/2 + 1/2 S(x0, x1) S(y0, y1), S the mean of the square wave that alternates
between 1 and -1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Scene, UsageError
from samplekit.kernels import BLOCK, fma, helper, kernel, lane_sum, two_product

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MOST_CELLS = 2**20


class Checker(Scene):
    """1 where floor(cells x) + floor(cells y) is even, else 0.

    Samples see cell j begin at the float64 nearest to j / cells, and stay below the right edge of their pixel. A pixel
    edge i / w that equals j / cells is that same float64, so that no sample falls into the cell beyond, whatever the
    rounding. The reference has the edges of the real line, at most half a unit in the last place away.

    Parameters
    ----------
    cells
        Cells along the unit square's side, 1 to 2^20.
    """

    def __init__(self, cells: int = 8) -> None:
        if not 1 <= cells <= _MOST_CELLS or cells != int(cells):
            raise UsageError(f"checker: cells={cells} must be a whole number from 1 to {_MOST_CELLS}")
        self.cells = float(cells)

    def sums(self, tile: NDArray[np.float64], boxes: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Count each pixel's samples in even cells: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.cells, out)

    def exact(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """Integrate over each pixel's box: its mean float64[h, w], within 1e-15."""
        x_means, y_means = np.empty(x_edges.size - 1), np.empty(y_edges.size - 1)
        _means(np.ascontiguousarray(x_edges), self.cells, x_means)
        _means(np.ascontiguousarray(y_edges), self.cells, y_means)
        return 0.5 + 0.5 * np.multiply.outer(y_means, x_means)

    def constant(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """Find the pixels whose first and last sample are in one cell; NaN elsewhere: float64[h, w]."""
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
    """Return the last cell whose edge, rounded to float64, is at or before ``x``: the nearest edge's, or one less."""
    nearest = np.rint(x * cells)
    return float(nearest - (1.0 if nearest / cells > x else 0.0))


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64[::1])")
def _sums(tile: NDArray[np.float64], boxes: NDArray[np.float64], cells: float, out: NDArray[np.float64]) -> None:
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
def _signs(edges: NDArray[np.float64], cells: float, signs: NDArray[np.float64]) -> None:
    """Find the sign of the cell of all samples between neighbouring edges; NaN where there are several."""
    for i in range(signs.size):
        left, width = edges[i], edges[i + 1] - edges[i]
        first, last = _cell(left, cells), _cell(np.nextafter(left + width, left), cells)
        signs[i] = _sign(first) if first == last else np.nan


@helper
def _split(edge: float, cells: float) -> tuple[float, float, float]:
    """Return the cell of an edge, and its distances from the cell's begin and end in cells, each fully accurate."""
    product, error = two_product(edge, cells)
    cell = np.floor(product)
    if product == cell and error < 0.0:
        cell -= 1.0
    return cell, (product - cell) + error, ((cell + 1.0) - product) - error


@kernel("void(float64[::1], float64, float64[::1])")
def _means(edges: NDArray[np.float64], cells: float, means: NDArray[np.float64]) -> None:
    """Average the square wave between neighbouring edges, within 4e-16.

    The cells between the first and the last cancel in pairs; what is left is the ends, and one cell of an odd number.
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
