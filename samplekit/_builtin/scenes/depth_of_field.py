"""Depth of field: three disks in front, a ring in focus and a checkered wall behind, seen through a thin lens.

Cook, Porter, Carpenter 1984, "Distributed ray tracing": pixel and lens are sampled together, in four dimensions. Take a
lens of radius A that is in focus at the distance f. A ray through the place p in the picture and the point l of the
lens meets the plane at the depth z at the place p + c l, where c = A (1/z - 1/f) is the radius of the circle of
confusion. All layers are opaque and flat.

The reference integrates over the lens exactly (:mod:`samplekit._builtin.scenes.depth_of_field_lens`) and over the pixel
adaptively.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene, UsageError
from samplekit.kernels import BLOCK, disk_point, fma, kernel, lane_sum

Array = NDArray[np.float64]

FRONT_DEPTH, RING_DEPTH, WALL_DEPTH = 0.5, 1.0, 2.0
# Each row: centre, radius, value. The disks do not overlap, so that none hides another at their common depth.
FRONT = np.array([[0.22, 0.25, 0.13, 1.0], [0.80, 0.62, 0.10, 0.875], [0.30, 0.86, 0.07, 0.75]])
# Centre, inner and outer radius, value.
RING = np.array([0.55, 0.48, 0.17, 0.29, 0.5])
INNER, OUTER = 3, 4
CIRCLES = np.array([*FRONT, RING[[0, 1, 2, 4]], RING[[0, 1, 3, 4]]])
"""The disks in front, and the ring's inner and outer circle: float64[5, 4], as in ``FRONT``."""
# First line, side of a cell, number of cells along a side; values of even cells, of odd cells and beyond the wall.
WALL = np.array([-0.92, 0.35, 8.0, 0.0625, 0.3125, 0.1875])
LARGEST_CONFUSION = 1e12
"""Largest circle of confusion, in widths of the picture: far beyond it places lose all their digits."""
LARGEST_CELL = 1.0 / 64.0
"""The reference first divides pixels into cells of at most this side, then refines where the integrand varies."""


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64[::1])")
def _sums(tile: Array, boxes: Array, out: Array, confusion: Array) -> None:
    """Paint from back to front, layer after layer, so that each pass over the samples becomes vector instructions.

    That needs the circles of confusion in local variables: for all that the compiler knows, ``out`` and ``confusion``
    may share memory.
    """
    pixels, dims, count = tile.shape
    x, y, lens_x, lens_y, values = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    first, per_cell, cells = WALL[0], 1.0 / WALL[1], WALL[2]
    inner, outer = RING[2] * RING[2], RING[3] * RING[3]
    front_coc, ring_coc, wall_coc = confusion[0], confusion[1], confusion[2]
    lens_x[:], lens_y[:] = 0.0, 0.0
    for pixel in range(pixels):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(count):
            x[i] = fma(tile[pixel, 0, i], width, left)
            y[i] = fma(tile[pixel, 1, i], height, top)
        if dims == 4:
            for i in range(count):
                lens_x[i], lens_y[i] = disk_point(tile[pixel, 2, i], tile[pixel, 3, i])
        for i in range(count):
            column = np.floor((fma(wall_coc, lens_x[i], x[i]) - first) * per_cell)
            row = np.floor((fma(wall_coc, lens_y[i], y[i]) - first) * per_cell)
            half = 0.5 * (column + row)
            value = WALL[3] if half == np.floor(half) else WALL[4]
            within = (column >= 0.0) & (column < cells) & (row >= 0.0) & (row < cells)
            values[i] = value if within else WALL[5]
        for i in range(count):
            dx = fma(ring_coc, lens_x[i], x[i]) - RING[0]
            dy = fma(ring_coc, lens_y[i], y[i]) - RING[1]
            squared = fma(dx, dx, dy * dy)
            values[i] = RING[4] if (squared >= inner) & (squared < outer) else values[i]
        for k in range(FRONT.shape[0]):
            disk_x, disk_y, limit, disk_value = FRONT[k, 0], FRONT[k, 1], FRONT[k, 2] * FRONT[k, 2], FRONT[k, 3]
            for i in range(count):
                dx = fma(front_coc, lens_x[i], x[i]) - disk_x
                dy = fma(front_coc, lens_y[i], y[i]) - disk_y
                values[i] = disk_value if fma(dx, dx, dy * dy) < limit else values[i]
        out[pixel] = lane_sum(values, count)


class DepthOfField(Scene):
    """Layers at the depths 1/2 (disks), 1 (ring) and 2 (wall) behind a lens.

    Parameters
    ----------
    aperture
        Diameter of the lens, in widths of the picture at the depth 1. 0: a pinhole, which needs no lens dimensions.
    focus
        Depth that is in focus: 0.5 the disks, 1 the ring, 2 the wall, infinity what is infinitely far.

    Raises
    ------
    UsageError
        The focus is 0, or a circle of confusion is wider than 1e12 pictures.
    """

    value_range = (0.0, 1.0)
    reference_error = 1.5e-5
    """Against a tolerance of 1e-9 the error was at most 7.2e-6, its root mean square 4e-7. The square of the bound is a
    third of 1 % of the smallest mse that any sampler reached with 4096 samples per pixel at 512 x 512."""

    def __init__(self, aperture: float = 0.1, focus: float = 1.0) -> None:
        if focus == 0.0:
            raise UsageError("depth-of-field: focus=0: expected a depth above 0")
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

    def dimensions(self) -> dict[str, int]:
        """Return the dimensions of pixel and lens; with the aperture 0 those of the pixel alone."""
        return {"pixel": 2, "lens": 2} if self.aperture > 0.0 else {"pixel": 2}

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the values that each pixel's rays meet: see :meth:`Scene.sums`."""
        _sums(tile, boxes, out, self.confusion)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value of the pixels whose rays from all points of the lens meet one value, NaN elsewhere."""
        from samplekit._builtin.scenes.depth_of_field_bounds import constant_pixels

        out = np.empty((y_edges.size - 1, x_edges.size - 1))
        x, y = np.ascontiguousarray(x_edges, np.float64), np.ascontiguousarray(y_edges, np.float64)
        constant_pixels(x, y, self.confusion, out)
        return out

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel and the lens: float64[h, w], within ``reference_error``."""
        from samplekit._builtin.scenes import depth_of_field_lens
        from samplekit.quadrature import Curves, kept_means, pixel_side

        # A blur of many pixels is smooth enough for the adaptive rule; the edges of sharper layers are followed.
        sharp = 8.0 * min(LARGEST_CELL, max(pixel_side(x_edges), pixel_side(y_edges)))
        return kept_means(
            f"{self.aperture!r} {self.focus!r}",
            (__file__, depth_of_field_lens.__file__),
            self._mean_over_lens,
            x_edges,
            y_edges,
            known=self.constant(x_edges, y_edges),
            curves=Curves(*self._edges(sharp)),
            # Larger cells will do where every layer is blurred over many of them.
            largest=max(LARGEST_CELL, np.abs(self.confusion).min() / 8.0),
        )

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the mean over the lens at the points x float64[w] by y float64[h]: float64[h, w], within 1e-12."""
        points = np.array([np.tile(x, y.size), np.repeat(y, x.size)])
        return self._mean_over_lens(points).reshape(y.size, x.size)

    def _mean_over_lens(self, points: Array) -> Array:
        from samplekit._builtin.scenes.depth_of_field_lens import lens_means

        means = np.empty(points.shape[1])
        lens_means(points, self.confusion, means)
        return means

    def _edges(self, sharp: float) -> tuple[Array, Array]:
        """Return the circles float64[K, 3] and the lines float64[L, 3] along which layers begin and end to show.

        Layers whose circles of confusion are not below ``sharp`` have none.
        """
        reach = np.abs(self.confusion)
        edges = [(*circle[:3], reach[0 if k < INNER else 1]) for k, circle in enumerate(CIRCLES)]
        circles = {(cx, cy, abs(r + side * c)) for cx, cy, r, c in edges if c < sharp for side in (-1, 1)}
        places = WALL[0] + WALL[1] * np.arange(WALL[2] + 1)
        lines = {place + side * reach[2] for place in places if reach[2] < sharp for side in (-1, 1)}
        both_ways = [(*axis, place) for place in sorted(lines) for axis in ((1.0, 0.0), (0.0, 1.0))]
        return np.array(sorted(circles)).reshape(-1, 3), np.array(both_ways).reshape(-1, 3)
