"""Depth of field: three disks in front, a ring in focus, a checkered wall behind, seen through a thin lens.

Cook, Porter, Carpenter 1984, "Distributed ray tracing": pixel and lens are sampled together, four dimensions. A ray
through the pixel p and the lens point l of a lens of radius A, in focus at the distance f, meets the plane at the depth
z at p + c l in the picture, c = A (1/z - 1/f): what lies there is shifted by the circle of confusion times the lens
point. All layers are opaque and flat.

The reference takes the lens exactly (:mod:`samplekit.builtin.scenes.depth_of_field_lens`) and the pixel adaptively.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit.errors import UsageError
from samplekit.integration.scene import Scene
from samplekit.numerics.concentric import disk_point
from samplekit.numerics.kernel import fma, kernel
from samplekit.numerics.summation import BLOCK, lane_sum

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from samplekit.integration.pixel_means import Curves

    Array = NDArray[np.float64]

FRONT_DEPTH, RING_DEPTH, WALL_DEPTH = 0.5, 1.0, 2.0
# Centre, radius, value. The disks keep apart, so that at their common depth none hides another.
FRONT = np.array([[0.22, 0.25, 0.13, 1.0], [0.80, 0.62, 0.10, 0.875], [0.30, 0.86, 0.07, 0.75]])
# Centre, inner and outer radius, value.
RING = np.array([0.55, 0.48, 0.17, 0.29, 0.5])
# First line, side of a cell, number of cells along a side; values of even cells, of odd ones and of what lies beyond.
WALL = np.array([-0.92, 0.35, 8.0, 0.0625, 0.3125, 0.1875])
LARGEST_CONFUSION = 1e12
"""Largest circle of confusion, in widths of the picture: far beyond it places lose all their digits."""
LARGEST_CELL = 1.0 / 64.0
"""Pixels are divided into cells of at most this side before the reference looks for what varies."""
_SLACK = 1e-12  # relative: places p + c l are rounded three times, each time by 2^-53


@kernel(
    "void(float64[:,:,::1], float64[:,::1], float64[::1], float64[:,::1], float64[::1], float64[::1], float64[::1])"
)
def _sums(tile: Array, boxes: Array, out: Array, front: Array, ring: Array, wall: Array, confusion: Array) -> None:
    """Paint from back to front, layer after layer: each pass over the samples becomes vector instructions."""
    pixels, dims, count = tile.shape
    x, y, lens_x, lens_y, values = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    per_cell, cells = 1.0 / wall[1], wall[2]
    inner, outer = ring[2] * ring[2], ring[3] * ring[3]
    for pixel in range(pixels):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(count):
            x[i] = fma(tile[pixel, 0, i], width, left)
            y[i] = fma(tile[pixel, 1, i], height, top)
        if dims == 4:
            for i in range(count):
                lens_x[i], lens_y[i] = disk_point(tile[pixel, 2, i], tile[pixel, 3, i])
        else:
            for i in range(count):
                lens_x[i] = lens_y[i] = 0.0
        for i in range(count):
            column = np.floor((fma(confusion[2], lens_x[i], x[i]) - wall[0]) * per_cell)
            row = np.floor((fma(confusion[2], lens_y[i], y[i]) - wall[0]) * per_cell)
            half = 0.5 * (column + row)
            value = wall[3] if half == np.floor(half) else wall[4]
            within = (column >= 0.0) & (column < cells) & (row >= 0.0) & (row < cells)
            values[i] = value if within else wall[5]
        for i in range(count):
            dx = fma(confusion[1], lens_x[i], x[i]) - ring[0]
            dy = fma(confusion[1], lens_y[i], y[i]) - ring[1]
            squared = fma(dx, dx, dy * dy)
            values[i] = ring[4] if (squared >= inner) & (squared < outer) else values[i]
        for k in range(front.shape[0]):
            limit = front[k, 2] * front[k, 2]
            for i in range(count):
                dx = fma(confusion[0], lens_x[i], x[i]) - front[k, 0]
                dy = fma(confusion[0], lens_y[i], y[i]) - front[k, 1]
                values[i] = front[k, 3] if fma(dx, dx, dy * dy) < limit else values[i]
        out[pixel] = lane_sum(values, count)


@kernel("int64(float64, float64, float64, float64, float64, float64, float64, float64)")
def _side(x0: float, x1: float, y0: float, y1: float, cx: float, cy: float, radius: float, reach: float) -> int:
    """Return 1 if a box, moved by up to ``reach``, stays in a disk, -1 if it stays out, 0 if neither is proven."""
    slack = _SLACK * (1.0 + reach)
    near_x, near_y = max(x0 - cx, cx - x1, 0.0), max(y0 - cy, cy - y1, 0.0)
    far_x, far_y = max(abs(x0 - cx), abs(x1 - cx)), max(abs(y0 - cy), abs(y1 - cy))
    if math.sqrt(far_x * far_x + far_y * far_y) + reach + slack < radius:
        return 1
    return -1 if math.sqrt(near_x * near_x + near_y * near_y) - reach - slack > radius else 0


@kernel("void(float64[::1], float64[::1], float64[:,::1], float64[::1], float64[::1], float64[::1], float64[:,::1])")
def _constant(x: Array, y: Array, front: Array, ring: Array, wall: Array, confusion: Array, out: Array) -> None:
    """Go from front to back until a layer fills the pixel for all lens points, or shows but in part."""
    reach = np.abs(confusion)
    slack = _SLACK * (1.0 + reach[2])
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            out[j, i] = np.nan
            x0, x1, y0, y1 = x[i], x[i + 1], y[j], y[j + 1]
            hidden = False
            for k in range(front.shape[0]):
                side = _side(x0, x1, y0, y1, front[k, 0], front[k, 1], front[k, 2], reach[0])
                if side == 1:
                    out[j, i] = front[k, 3]
                hidden |= side != -1
            if hidden:
                continue
            inner = _side(x0, x1, y0, y1, ring[0], ring[1], ring[2], reach[1])
            outer = _side(x0, x1, y0, y1, ring[0], ring[1], ring[3], reach[1])
            if inner == -1 and outer == 1:
                out[j, i] = ring[4]
            if inner != 1 and outer != -1:
                continue
            column = np.floor((x0 - reach[2] - slack - wall[0]) / wall[1])
            row = np.floor((y0 - reach[2] - slack - wall[0]) / wall[1])
            last_column = np.floor((x1 + reach[2] + slack - wall[0]) / wall[1])
            last_row = np.floor((y1 + reach[2] + slack - wall[0]) / wall[1])
            if min(last_column, last_row) < 0.0 or max(column, row) >= wall[2]:
                out[j, i] = wall[5]
            elif column == last_column and row == last_row:
                even = 0.5 * (column + row) == np.floor(0.5 * (column + row))
                out[j, i] = wall[3] if even else wall[4]


class DepthOfField(Scene):
    """Layers at the depths 1/2 (disks), 1 (ring) and 2 (wall) behind a lens.

    Parameters
    ----------
    aperture
        Diameter of the lens, in widths of the picture as it is at the depth 1; 0: a pinhole, which needs no lens
        dimensions.
    focus
        Depth that is in focus: 1 the ring, 0.5 the disks, 2 the wall, infinity what is infinitely far.

    Raises
    ------
    UsageError
        Nothing can be in focus at depth 0; circles of confusion above 1e12.
    """

    reference_error = 5e-5
    """Found at most 2.5e-5, and 1e-6 in the root mean square, against a tolerance of 1e-9."""

    def __init__(self, aperture: float = 0.12, focus: float = 1.0) -> None:
        if not (0.0 <= aperture < math.inf and focus > 0.0):
            raise UsageError(f"aperture={aperture}, focus={focus}: expected an aperture of at least 0 and a focus > 0")
        self.aperture, self.focus = float(aperture), float(focus)
        self.confusion = np.zeros(3)
        if aperture > 0.0:
            depths = np.array([FRONT_DEPTH, RING_DEPTH, WALL_DEPTH])
            with np.errstate(over="ignore"):
                self.confusion = 0.5 * aperture * (1.0 / depths - 1.0 / np.float64(focus))
        if not np.abs(self.confusion).max() <= LARGEST_CONFUSION:
            raise UsageError(
                f"aperture={aperture:g}, focus={focus:g}: circles of confusion are wider than"
                f" {LARGEST_CONFUSION:g} pictures"
            )

    def dimensions(self) -> Mapping[str, int]:
        """Pixel, and lens unless the aperture is 0."""
        return {"pixel": 2, "lens": 2} if self.aperture > 0.0 else {"pixel": 2}

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum what each pixel's rays meet: see :meth:`Scene.sums`."""
        _sums(tile, boxes, out, FRONT, RING, WALL, self.confusion)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Find the pixels in which every ray, from every point of the lens, meets one value; NaN elsewhere."""
        out = np.empty((y_edges.size - 1, x_edges.size - 1))
        x, y = np.ascontiguousarray(x_edges, np.float64), np.ascontiguousarray(y_edges, np.float64)
        _constant(x, y, FRONT, RING, WALL, self.confusion, out)
        return out

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel and the lens: float64[h, w], within ``reference_error``."""
        from samplekit.builtin.scenes import depth_of_field_lens
        from samplekit.integration.kept_means import kept_means

        # A blur of many pixels is smooth enough for the adaptive rule; the edges of a sharper one are followed.
        sharp = 8.0 * min(LARGEST_CELL, max(np.diff(x_edges).max(), np.diff(y_edges).max()))
        return kept_means(
            f"{self.aperture!r} {self.focus!r}",
            (__file__, depth_of_field_lens.__file__),
            self._mean_over_lens,
            x_edges,
            y_edges,
            known=self.constant(x_edges, y_edges),
            curves=self._edges(sharp),
            # Where every layer is blurred over many cells, so is what varies.
            largest=max(LARGEST_CELL, np.abs(self.confusion).min() / 8.0),
            orders=(2, 3),
        )

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the mean over the lens at the points x float64[w] by y float64[h]: float64[h, w], within 1e-12."""
        points = np.array([np.tile(x, y.size), np.repeat(y, x.size)])
        return self._mean_over_lens(points).reshape(y.size, x.size)

    def _mean_over_lens(self, points: Array) -> Array:
        from samplekit.builtin.scenes.depth_of_field_lens import lens_means

        means = np.empty(points.shape[1])
        lens_means(points, FRONT, RING, WALL, self.confusion, means)
        return means

    def _edges(self, sharp: float) -> Curves:
        """Where layers whose circle of confusion is less than ``sharp`` begin and end to show."""
        from samplekit.integration.pixel_means import Curves

        reach = np.abs(self.confusion)
        edges = [(*disk[:3], reach[0]) for disk in FRONT] + [(*RING[:2], radius, reach[1]) for radius in RING[2:4]]
        circles = {(cx, cy, abs(r + side * c)) for cx, cy, r, c in edges if c < sharp for side in (-1, 1)}
        places = WALL[0] + WALL[1] * np.arange(WALL[2] + 1)
        lines = {place + side * reach[2] for place in places if reach[2] < sharp for side in (-1, 1)}
        return Curves(
            np.array(sorted(circles)).reshape(-1, 3),
            np.array([(*axis, place) for place in sorted(lines) for axis in ((1.0, 0.0), (0.0, 1.0))]).reshape(-1, 3),
        )
