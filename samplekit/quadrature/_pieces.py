"""Quadrature nodes in the pieces into which circles and lines cut a cell: first along y, then along x.

A function that has its steps and kinks on these curves need not be smooth at the ends of a piece: the substitution
3 s^2 - 2 s^3 crowds the nodes there, and takes the beginning of a square root to one order more
(Davis and Rabinowitz 1984, "Methods of Numerical Integration", 2.12).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper, kernel

Array = NDArray[np.float64]


@kernel("void(float64[:,::1], float64[:,::1], float64[:,::1], boolean[::1])")
def mark_crossed(cells: Array, circles: Array, lines: Array, crossed: NDArray[np.bool_]) -> None:
    """Mark the cells that a curve enters."""
    for i in range(crossed.size):
        x0, x1, y0, y1 = cells[0, i], cells[1, i], cells[2, i], cells[3, i]
        for k in range(circles.shape[0]):
            cx, cy, radius = circles[k, 0], circles[k, 1], circles[k, 2]
            near_x, near_y = max(x0 - cx, cx - x1, 0.0), max(y0 - cy, cy - y1, 0.0)
            far_x, far_y = max(abs(x0 - cx), abs(x1 - cx)), max(abs(y0 - cy), abs(y1 - cy))
            if math.hypot(near_x, near_y) < radius < math.hypot(far_x, far_y):
                crossed[i] = True
        for k in range(lines.shape[0]):
            a, b, c = lines[k, 0], lines[k, 1], lines[k, 2]
            low = min(a * x0, a * x1) + min(b * y0, b * y1)
            if low < c < max(a * x0, a * x1) + max(b * y0, b * y1):
                crossed[i] = True


@helper
def _add(breaks: Array, count: int, place: float, low: float, high: float) -> int:
    """Insert a place into the sorted breaks if it lies between ``low`` and ``high``; return how many there are."""
    if not low < place < high:
        return count
    i = count
    while i > 0 and breaks[i - 1] > place:
        breaks[i] = breaks[i - 1]
        i -= 1
    breaks[i] = place
    return count + 1


@kernel("int64(float64, float64, float64, float64, float64[:,::1], float64[:,::1], float64[::1])")
def _x_breaks(x0: float, x1: float, y0: float, y1: float, circles: Array, lines: Array, breaks: Array) -> int:
    """Find where curves turn, and where they cross the top and the bottom of a cell."""
    count = 0
    for k in range(circles.shape[0]):
        cx, cy, radius = circles[k, 0], circles[k, 1], circles[k, 2]
        for edge in range(3):
            y = y0 if edge == 0 else y1 if edge == 1 else cy
            if abs(y - cy) < radius and y0 <= y <= y1:
                half = math.sqrt((radius - (y - cy)) * (radius + (y - cy)))
                count = _add(breaks, count, cx - half, x0, x1)
                count = _add(breaks, count, cx + half, x0, x1)
    for k in range(lines.shape[0]):
        a, b, c = lines[k, 0], lines[k, 1], lines[k, 2]
        if a != 0.0:
            count = _add(breaks, count, (c - b * y0) / a, x0, x1)
            count = _add(breaks, count, (c - b * y1) / a, x0, x1)
    return count


@kernel("int64(float64, float64, float64, float64[:,::1], float64[:,::1], float64[::1])")
def _y_breaks(x: float, y0: float, y1: float, circles: Array, lines: Array, breaks: Array) -> int:
    """Find where curves cross a column."""
    count = 0
    for k in range(circles.shape[0]):
        offset, radius = x - circles[k, 0], circles[k, 2]
        if abs(offset) < radius:
            half = math.sqrt((radius - offset) * (radius + offset))
            count = _add(breaks, count, circles[k, 1] - half, y0, y1)
            count = _add(breaks, count, circles[k, 1] + half, y0, y1)
    for k in range(lines.shape[0]):
        if lines[k, 1] != 0.0:
            count = _add(breaks, count, (lines[k, 2] - lines[k, 0] * x) / lines[k, 1], y0, y1)
    return count


@kernel(
    "int64(float64[:,::1], float64[:,::1], float64[:,::1], float64[::1], float64[::1], float64[:,::1], float64[::1],"
    " int64[::1])"
)
def piece_nodes(
    cells: Array,
    circles: Array,
    lines: Array,
    nodes: Array,
    weights: Array,
    points: Array,
    shares: Array,
    ends: NDArray[np.int64],
) -> int:
    """Write the nodes of as many cells as fit; return how many.

    Parameters
    ----------
    cells
        float64[4, C]: left, right, top, bottom.
    circles, lines
        As in :class:`samplekit.quadrature.Curves`.
    nodes, weights
        Of a rule on [0, 1].
    points, shares, ends
        Receive the nodes float64[2, M], their weights in the mean over their cell, and where each cell's end.
    """
    x_breaks = np.empty(6 * circles.shape[0] + 2 * lines.shape[0])
    y_breaks = np.empty(2 * circles.shape[0] + lines.shape[0])
    count = 0
    for i in range(cells.shape[1]):
        x0, x1, y0, y1 = cells[0, i], cells[1, i], cells[2, i], cells[3, i]
        across = _x_breaks(x0, x1, y0, y1, circles, lines, x_breaks)
        if i > 0 and count + (across + 1) * (y_breaks.size + 1) * nodes.size * nodes.size > shares.size:
            return i
        for piece in range(across + 1):
            left = x_breaks[piece - 1] if piece > 0 else x0
            span = (x_breaks[piece] if piece < across else x1) - left
            for m in range(nodes.size):
                s = nodes[m]
                x = left + span * (s * s * (3.0 - 2.0 * s))
                x_share = weights[m] * 6.0 * s * (1.0 - s) * span / (x1 - x0)
                down = _y_breaks(x, y0, y1, circles, lines, y_breaks)
                for part in range(down + 1):
                    top = y_breaks[part - 1] if part > 0 else y0
                    length = (y_breaks[part] if part < down else y1) - top
                    for n in range(nodes.size):
                        t = nodes[n]
                        points[0, count], points[1, count] = x, top + length * (t * t * (3.0 - 2.0 * t))
                        shares[count] = x_share * (weights[n] * 6.0 * t * (1.0 - t) * length / (y1 - y0))
                        count += 1
        ends[i] = count
    return ends.size


@kernel("void(float64[::1], float64[::1], int64[::1], float64[::1])")
def sum_cells(values: Array, shares: Array, ends: NDArray[np.int64], out: Array) -> None:
    """Write the sum of values times shares over the nodes of each cell, one cell after the other."""
    node = 0
    for i in range(out.size):
        total = 0.0
        while node < ends[i]:
            total += shares[node] * values[node]
            node += 1
        out[i] = total
