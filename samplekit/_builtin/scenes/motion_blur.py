"""Motion blur: three disks that move over a still checkerboard, sampled over pixel and time, and the lens if need be.

Cook, Porter, Carpenter 1984, "Distributed ray tracing". The disks lie in one plane at the depth 1/2 and move along one
direction, each in its own lane, so that none ever hides another. The board at the depth 1 is in focus. At the time t
from 0 to 1 the centre of a disk is its place at half time plus (t - 1/2) shutter speed; a point of the lens shifts it
by that point times the radius of the circle of confusion, half the aperture.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit.kernels import BLOCK, disk_point, fma, kernel, lane_sum

Array = NDArray[np.float64]

# Each row: centre at half time, radius, value, speed along the direction.
DISKS = np.array([[0.30, 0.70, 0.09, 0.875, 0.8], [0.55, 0.45, 0.11, 1.0, -0.5], [0.75, 0.25, 0.08, 0.75, 0.25]])
DIRECTION = (0.8, 0.6)
# First line, side of a cell, values of even and odd cells.
BOARD = np.array([-0.07, 0.25, 0.0625, 0.3125])
LARGEST_CELL = 1.0 / 64.0
"""The reference first divides pixels into cells of at most this side, then refines where the integrand varies."""
_SLACK = 1e-12  # relative: places are rounded a few times, each time by 2^-53


@kernel(
    "void(float64[:,:,::1], float64[:,::1], float64[::1], float64[:,::1], float64[::1], float64, float64, int64, int64)"
)
def _sums(
    tile: Array,
    boxes: Array,
    out: Array,
    disks: Array,
    board: Array,
    confusion: float,
    shutter: float,
    lens_row: int,
    time_row: int,
) -> None:
    """Paint from back to front; ``lens_row`` and ``time_row`` of the tile are the lens and the time, -1 for none."""
    pixels, _, count = tile.shape
    x, y, shift_x, shift_y, values = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    times = np.zeros(BLOCK)
    shift_x[:], shift_y[:] = 0.0, 0.0
    # A pass becomes vector instructions only if all its numbers but the samples are in local variables.
    first, per_cell, even, odd = board[0], 1.0 / board[1], board[2], board[3]
    for pixel in range(pixels):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(count):
            x[i] = fma(tile[pixel, 0, i], width, left)
            y[i] = fma(tile[pixel, 1, i], height, top)
        if lens_row > 0:
            for i in range(count):
                lens_x, lens_y = disk_point(tile[pixel, lens_row, i], tile[pixel, lens_row + 1, i])
                shift_x[i], shift_y[i] = confusion * lens_x, confusion * lens_y
        if time_row > 0:
            for i in range(count):
                times[i] = shutter * (tile[pixel, time_row, i] - 0.5)
        for i in range(count):
            half = 0.5 * (np.floor((x[i] - first) * per_cell) + np.floor((y[i] - first) * per_cell))
            values[i] = even if half == np.floor(half) else odd
        for k in range(disks.shape[0]):
            disk_x, disk_y, limit, disk_value = disks[k, 0], disks[k, 1], disks[k, 2] * disks[k, 2], disks[k, 3]
            speed_x, speed_y = disks[k, 4] * DIRECTION[0], disks[k, 4] * DIRECTION[1]
            for i in range(count):
                dx = x[i] + shift_x[i] - fma(times[i], speed_x, disk_x)
                dy = y[i] + shift_y[i] - fma(times[i], speed_y, disk_y)
                values[i] = disk_value if fma(dx, dx, dy * dy) < limit else values[i]
        out[pixel] = lane_sum(values, count)


@kernel("void(float64[::1], float64[::1], float64, float64, float64[:,::1])")
def _constant(x: Array, y: Array, reach: float, shutter: float, out: Array) -> None:
    """Write the value of constant pixels, NaN elsewhere, by bounds of their distance from each disk's path."""
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            out[j, i] = np.nan
            middle_x, middle_y = 0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1])
            around = 0.5 * math.hypot(x[i + 1] - x[i], y[j + 1] - y[j])
            shown = False
            for k in range(DISKS.shape[0]):
                half = 0.5 * shutter * abs(DISKS[k, 4])
                dx, dy = middle_x - DISKS[k, 0], middle_y - DISKS[k, 1]
                along = abs(dx * DIRECTION[0] + dy * DIRECTION[1])
                across = dy * DIRECTION[0] - dx * DIRECTION[1]
                slack = around + reach + _SLACK * (1.0 + reach + half)
                if math.hypot(along + half, across) + slack < DISKS[k, 2]:
                    out[j, i] = DISKS[k, 3]
                shown |= math.hypot(max(0.0, along - half), across) - slack <= DISKS[k, 2]
            if shown:
                continue
            column = np.floor((x[i] - _SLACK - BOARD[0]) / BOARD[1])
            row = np.floor((y[j] - _SLACK - BOARD[0]) / BOARD[1])
            last_column = np.floor((x[i + 1] + _SLACK - BOARD[0]) / BOARD[1])
            last_row = np.floor((y[j + 1] + _SLACK - BOARD[0]) / BOARD[1])
            if column == last_column and row == last_row:
                out[j, i] = BOARD[2] if 0.5 * (column + row) == np.floor(0.5 * (column + row)) else BOARD[3]


class MotionBlur(Scene):
    """Moving disks in front of a still board.

    Parameters
    ----------
    shutter
        Time for which the shutter is open. 0: nothing moves, and the scene has no dimension of time.
    aperture
        Diameter of the lens. 0: a pinhole, and the scene has no dimensions of the lens.
    """

    value_range = (0.0, 1.0)
    reference_error = 2e-6
    """Against a tolerance of 1e-9 the error was at most 5.1e-7."""

    def __init__(self, shutter: float = 0.5, aperture: float = 0.0) -> None:
        self.shutter, self.confusion = float(shutter), 0.5 * aperture * (1.0 / 0.5 - 1.0)

    def dimensions(self) -> dict[str, int]:
        """Return the dimensions of pixel, lens and time: no lens with the aperture 0, no time with the shutter 0."""
        return {"pixel": 2} | ({"lens": 2} if self.confusion else {}) | ({"time": 1} if self.shutter else {})

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the values that each pixel's rays meet: see :meth:`Scene.sums`."""
        lens_row = 2 if self.confusion else -1
        time_row = tile.shape[1] - 1 if self.shutter else -1
        _sums(tile, boxes, out, DISKS, BOARD, self.confusion, self.shutter, lens_row, time_row)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value of the pixels that always show one cell or one disk, from the whole lens; NaN elsewhere."""
        out = np.empty((y_edges.size - 1, x_edges.size - 1))
        x, y = np.ascontiguousarray(x_edges, np.float64), np.ascontiguousarray(y_edges, np.float64)
        _constant(x, y, self.confusion, self.shutter, out)
        return out

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over pixel, lens and time: float64[h, w], within ``reference_error``."""
        from samplekit._builtin.scenes import motion_blur_means
        from samplekit.quadrature import Curves, kept_means

        return kept_means(
            f"{self.shutter!r} {self.confusion!r}",
            (__file__, motion_blur_means.__file__),
            self._means,
            x_edges,
            y_edges,
            known=self.constant(x_edges, y_edges),
            curves=Curves(*self._edges(x_edges, y_edges)),
            largest=LARGEST_CELL,
        )

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the mean over lens and time at the points x float64[w] by y float64[h]: float64[h, w]."""
        return self._means(np.array([np.tile(x, y.size), np.repeat(y, x.size)])).reshape(y.size, x.size)

    def _means(self, points: Array) -> Array:
        from samplekit._builtin.scenes.motion_blur_means import lens_and_time_means

        out = np.empty(points.shape[1])
        lens_and_time_means(points, self.confusion, self.shutter, out)
        return out

    def _edges(self, x_edges: Array, y_edges: Array) -> tuple[Array, Array]:
        """Return circles float64[K, 3] and lines float64[L, 3]: the board's, and where disks begin and end to show.

        Disks that are blurred over many pixels have none.
        """
        from samplekit.quadrature import pixel_side

        circles, lines = set(), set()
        for axis, edges in enumerate((x_edges, y_edges)):
            first, last = (math.floor((edge - BOARD[0]) / BOARD[1]) for edge in (edges[0], edges[-1]))
            normal = (1.0, 0.0) if axis == 0 else (0.0, 1.0)
            lines |= {(*normal, BOARD[0] + j * BOARD[1]) for j in range(first, last + 2)}
        cell = min(LARGEST_CELL, max(pixel_side(x_edges), pixel_side(y_edges)))
        # A blur of many pixels is smooth enough for the adaptive rule.
        for x, y, radius, _, speed in DISKS if self.confusion < 8.0 * cell else ():
            lane = y * DIRECTION[0] - x * DIRECTION[1]
            for r in {abs(radius - self.confusion), radius + self.confusion}:
                for end in {-0.5 * self.shutter * speed, 0.5 * self.shutter * speed}:
                    circles.add((x + end * DIRECTION[0], y + end * DIRECTION[1], r))
                if self.shutter:
                    lines |= {(-DIRECTION[1], DIRECTION[0], lane + side * r) for side in (-1, 1)}
        return np.array(sorted(circles)).reshape(-1, 3), np.array(sorted(lines)).reshape(-1, 3)
