"""The ellipse, a needle if its aspect is small, with its exact area in every pixel however thin the needle is.

The reference is in :mod:`samplekit._builtin.scenes.ellipse_means`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit._builtin.scenes.sample_bounds import product_bounds, sample_bounds, square_bounds
from samplekit.kernels import direction, kernel

Array = NDArray[np.float64]


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64[::1])")
def _sums(tile: Array, boxes: Array, ellipse: Array, out: Array) -> None:
    cx, cy, cosine, sine = ellipse[0], ellipse[1], ellipse[2], ellipse[3]
    per_major, per_minor = 1.0 / ellipse[4], 1.0 / ellipse[5]
    for pixel in range(tile.shape[0]):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        # An integer: its sum has no order, so the loop becomes vector instructions.
        inside = 0
        for i in range(tile.shape[2]):
            x = left + tile[pixel, 0, i] * width - cx
            y = top + tile[pixel, 1, i] * height - cy
            along = (cosine * x + sine * y) * per_major
            across = (cosine * y - sine * x) * per_minor
            inside += along * along + across * across < 1.0
        out[pixel] = inside


class Ellipse(Scene):
    """1 where (p / radius)² + (q / (aspect radius))² < 1, else 0; p and q are measured along the axes from the centre.

    The float64 numbers cosine, sine, radius, aspect * radius and centre define the ellipse, for samples and reference
    alike.

    Parameters
    ----------
    radius
        Half of the longer axis, 1e-60 to 1e60.
    aspect
        The shorter axis over the longer, 1e-12 to 1.
    angle
        Angle of the longer axis from the x axis in degrees. Any finite number.
    cx, cy
        Centre, from -1e60 to 1e60.
    """

    value_range = (0.0, 1.0)

    def __init__(
        self, radius: float = 0.3, aspect: float = 0.1, angle: float = 30.0, cx: float = 0.4523, cy: float = 0.5317
    ) -> None:
        self.cx, self.cy = float(cx), float(cy)
        self.cosine, self.sine = direction(angle)
        self.major, self.minor = float(radius), float(aspect) * float(radius)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count each pixel's samples inside: see :meth:`Scene.sums`."""
        numbers = np.array([self.cx, self.cy, self.cosine, self.sine, self.major, self.minor])
        _sums(tile, boxes, numbers, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the fraction of each pixel that the ellipse covers: float64[h, w], within 1e-13 relative.

        Edges may lie anywhere. The bound holds for widths and heights from 1e-12 to 1e12 times the axes. Where the
        ellipse enters a pixel by less than 1e-15 of its own size, the bound is 1e-28 times its size over the pixel's.
        """
        from samplekit._builtin.scenes.ellipse_means import ellipse_means

        return ellipse_means(
            np.array(x_edges, np.float64),
            np.array(y_edges, np.float64),
            (self.cx, self.cy),
            (self.cosine, self.sine),
            (self.major, self.minor),
        )

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 or 0 where every sample of the pixel gives that in ``sums``, NaN elsewhere: float64[h, w]."""
        (left, right), (top, bottom) = sample_bounds(x_edges), sample_bounds(y_edges)
        x, y = (left - self.cx, right - self.cx), (top - self.cy, bottom - self.cy)
        least, most = np.zeros((2, y_edges.size - 1, x_edges.size - 1))
        for across, down, axis in ((self.cosine, self.sine, self.major), (-self.sine, self.cosine, self.minor)):
            columns, rows = product_bounds(across, x), product_bounds(down, y)
            low, high = rows[0][:, None] + columns[0], rows[1][:, None] + columns[1]
            with np.errstate(over="ignore"):
                near, far = square_bounds(low * (1.0 / axis), high * (1.0 / axis))
                least, most = least + near, most + far
        return np.where(most < 1.0, 1.0, np.where(least >= 1.0, 0.0, np.nan))
