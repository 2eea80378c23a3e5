"""Pixels of the depth-of-field scene that show one value, from every place in them and every point of the lens.

Interval arithmetic on the places p + c l: a pixel's box, grown by the circle of confusion, is inside a disk if its
farthest corner is, and outside if its nearest point is. The bounds have slack for the rounding of the samples' places.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit._builtin.scenes.depth_of_field import CIRCLES, INNER, OUTER, RING, WALL
from samplekit.kernels import helper, kernel, largest

Array = NDArray[np.float64]

_BLOCK = 8
_SLACK = 1e-12  # relative: places p + c l are rounded three times, each time by 2^-53


@kernel("int64(float64, float64, float64, float64, int64, float64[::1])")
def _side(x0: float, x1: float, y0: float, y1: float, circle: int, confusion: Array) -> int:
    """Return 1 if a box stays in a circle from all points of the lens, -1 if outside, 0 if neither is proven.

    Return 2 if neither can be proven for any part of the box.
    """
    cx, cy, radius = CIRCLES[circle, 0], CIRCLES[circle, 1], CIRCLES[circle, 2]
    reach = abs(confusion[0 if circle < INNER else 1])
    reach += _SLACK * (1.0 + reach)
    near_x, near_y = max(x0 - cx, cx - x1, 0.0), max(y0 - cy, cy - y1, 0.0)
    far_x, far_y = max(cx - x0, x1 - cx), max(cy - y0, y1 - cy)
    near, far = near_x * near_x + near_y * near_y, far_x * far_x + far_y * far_y
    inside, outside = max(0.0, radius - reach) * max(0.0, radius - reach), (radius + reach) * (radius + reach)
    if far < inside:
        return 1
    if near > outside:
        return -1
    return 2 if near >= inside and far <= outside else 0


@kernel("float64(float64, float64, float64, float64, float64[::1], int64[::1])")
def _shown(x0: float, x1: float, y0: float, y1: float, confusion: Array, sides: NDArray[np.int64]) -> float:
    """Return the value that a box shows through the whole lens, NaN if it is not proven to be one value.

    Goes from front to back until a layer fills the box or shows in part. ``sides`` holds the results of ``_side`` for
    all circles, and receives those that are found here.
    """
    for k in range(CIRCLES.shape[0]):
        if sides[k] == 0:
            sides[k] = _side(x0, x1, y0, y1, k, confusion)
        if k < INNER and sides[k] != -1:
            return float(CIRCLES[k, 3]) if sides[k] == 1 else math.nan
    if sides[INNER] == -1 and sides[OUTER] == 1:
        return float(RING[4])
    if sides[INNER] != 1 and sides[OUTER] != -1:
        return math.nan
    reach = abs(confusion[2])
    reach += _SLACK * (1.0 + reach)
    column, last_column = np.floor((x0 - reach - WALL[0]) / WALL[1]), np.floor((x1 + reach - WALL[0]) / WALL[1])
    row, last_row = np.floor((y0 - reach - WALL[0]) / WALL[1]), np.floor((y1 + reach - WALL[0]) / WALL[1])
    if min(last_column, last_row) < 0.0 or max(column, row) >= WALL[2]:
        return float(WALL[5])
    if column != last_column or row != last_row:
        return math.nan
    return float(WALL[3] if 0.5 * (column + row) == np.floor(0.5 * (column + row)) else WALL[4])


@helper
def _is_near_line(low: float, high: float, reach: float) -> bool:
    """Return whether one of the wall's lines is within ``reach`` of every place between ``low`` and ``high``."""
    line = max(np.ceil((high - reach - WALL[0]) / WALL[1]), 0.0)
    return bool(line <= WALL[2] and WALL[0] + line * WALL[1] <= low + reach)


@kernel("void(float64[::1], float64[::1], float64[::1], float64[:,::1])")
def constant_pixels(x: Array, y: Array, confusion: Array, out: Array) -> None:
    """Write the value that each pixel shows through the whole lens, NaN where it is not proven to be one value.

    Blocks of pixels come first: a result for a block holds for its pixels, and so does that there is nothing to prove.
    Pixels near the end of a line, where the wall's border is in view, count as blurred without a closer look.
    """
    of_block, of_pixel = np.empty(CIRCLES.shape[0], np.int64), np.empty(CIRCLES.shape[0], np.int64)
    for top in range(0, out.shape[0], _BLOCK):
        bottom = min(top + _BLOCK, out.shape[0])
        for left in range(0, out.shape[1], _BLOCK):
            right = min(left + _BLOCK, out.shape[1])
            x0, x1, y0, y1 = x[left], x[right], y[top], y[bottom]
            of_block[:] = 0
            blurred = False
            for k in range(CIRCLES.shape[0]):
                of_block[k] = _side(x0, x1, y0, y1, k, confusion)
                blurred |= of_block[k] == 2 and (k < INNER or largest(of_block[:INNER]) != 1)
            in_front, inner, outer = largest(of_block[:INNER]), of_block[INNER], of_block[OUTER]
            if in_front == -1 and (inner == 1 or outer == -1):
                reach = abs(confusion[2])
                blurred |= _is_near_line(x0, x1, reach) or _is_near_line(y0, y1, reach)
            value = math.nan
            if not blurred:
                value = _shown(x0, x1, y0, y1, confusion, of_block)
            for j in range(top, bottom):
                for i in range(left, right):
                    out[j, i] = value
                    if math.isnan(value) and not blurred:
                        for k in range(of_block.size):
                            of_pixel[k] = of_block[k]
                        out[j, i] = _shown(x[i], x[i + 1], y[j], y[j + 1], confusion, of_pixel)
