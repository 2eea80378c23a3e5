"""The ellipse: a needle if its aspect is small, thinner than a pixel by any factor, with its exact area in every pixel.

Sampled as the disk is. Its reference is in :mod:`samplekit._builtin.scenes.ellipse_means`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Scene, UsageError
from samplekit.kernels import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_SMALLEST, _LARGEST = 1e-60, 1e60
_SMALLEST_ASPECT = 1e-12


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


def _between(edges: Array, centre: float) -> tuple[Array, Array]:
    """Bound from below and above the offsets that ``_sums`` meets in every interval: float64[n] each.

    Its every operation is monotone, rounded or not, so the first and the last sample of an interval bound all.
    The slack is for widths that were rounded otherwise than here.
    """
    last = np.maximum(edges[:-1] + np.diff(edges) * (1.0 + 2.0**-50), edges[1:])
    return edges[:-1] - centre, last - centre


def _times(factor: float, bounds: tuple[Array, Array]) -> tuple[Array, Array]:
    ends = factor * bounds[0], factor * bounds[1]
    return np.minimum(*ends), np.maximum(*ends)


def _squared(low: Array, high: Array) -> tuple[Array, Array]:
    near = np.where((low <= 0.0) & (high >= 0.0), 0.0, np.minimum(abs(low), abs(high)))
    far = np.maximum(abs(low), abs(high))
    return near * near, far * far


class Ellipse(Scene):
    """1 where (p / radius)² + (q / (aspect radius))² < 1, else 0; p and q are along the axes, from the centre.

    The ellipse is that of the float64 numbers cosine, sine, radius, aspect * radius and centre: they are the scene,
    for samples and reference alike.

    Parameters
    ----------
    radius
        Half of the longer axis, 1e-60 to 1e60.
    aspect
        The shorter axis over the longer, 1e-12 to 1.
    angle
        Of the longer axis from the x axis in degrees. Any finite number.
    cx, cy
        Centre, from -1e60 to 1e60.

    Raises
    ------
    UsageError
        A parameter outside its range, or NaN.
    """

    def __init__(
        self,
        radius: float = 0.3,
        aspect: float = 0.1,
        angle: float = 30.0,
        cx: float = 0.4523,
        cy: float = 0.5317,
    ) -> None:
        from samplekit.kernels import direction

        for name, value, least, most in (
            ("radius", radius, _SMALLEST, _LARGEST),
            ("aspect", aspect, _SMALLEST_ASPECT, 1.0),
            ("cx", cx, -_LARGEST, _LARGEST),
            ("cy", cy, -_LARGEST, _LARGEST),
        ):
            if not least <= value <= most:
                raise UsageError(f"ellipse: {name}={value} must be from {least:g} to {most:g}")
        if not np.isfinite(angle):
            raise UsageError(f"ellipse: angle={angle} must be finite")
        cosine, sine = direction(angle)
        self.cx, self.cy, self.cosine, self.sine = float(cx), float(cy), cosine, sine
        self.major, self.minor = float(radius), float(aspect) * float(radius)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count the samples inside."""
        numbers = np.array([self.cx, self.cy, self.cosine, self.sine, self.major, self.minor])
        _sums(tile, boxes, numbers, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the fraction of each pixel that the ellipse covers: float64[h, w], within 1e-13 relative.

        Edges may lie anywhere. Where it enters a pixel by less than 1e-15 of itself, within 1e-28 of its size over the
        pixel's: offsets are double-doubles. The bound holds for widths and heights from 1e-12 to 1e12 times the axes.
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
        """Return 1 or 0 where every sample of the pixel gives that in ``sums``, rounding included; NaN elsewhere."""
        x = _between(np.asarray(x_edges, np.float64), self.cx)
        y = _between(np.asarray(y_edges, np.float64), self.cy)
        least, most = np.zeros((2, y_edges.size - 1, x_edges.size - 1))
        for across, down, axis in ((self.cosine, self.sine, self.major), (-self.sine, self.cosine, self.minor)):
            columns, rows = _times(across, x), _times(down, y)
            low, high = rows[0][:, None] + columns[0], rows[1][:, None] + columns[1]
            with np.errstate(over="ignore"):
                near, far = _squared(low * (1.0 / axis), high * (1.0 / axis))
                least, most = least + near, most + far
        return np.where(most < 1.0, 1.0, np.where(least >= 1.0, 0.0, np.nan))
