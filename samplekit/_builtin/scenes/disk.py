"""The disk: 1 inside a circle, 0 outside, with the exact area of its intersection with every pixel.

The usual area (differences of the antiderivative of sqrt(r² - x²) at the four corners) loses all its digits where a
pixel is small against the radius, or where the circle only just enters it. Here a pixel is cut at the centre's
coordinates and mirrored into the first quadrant, so that the arc falls from left to right. Its crossings with the
pixel's sides are offsets u, v from the corner nearest to the centre, (a, c):

    u(y) = sqrt(r² - y²) - a = g(a, y) / (sqrt((r - y)(r + y)) + a),    g(x, y) = r² - x² - y²,

and the area is a rectangle, a trapezoid under the arc's chord and a circular segment: all terms are positive. Only g
cancels. It is evaluated in double-double arithmetic, and where that is not enough as an expansion (Shewchuk 1997,
"Adaptive precision floating-point arithmetic and fast robust geometric predicates").
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene, UsageError
from samplekit._builtin.scenes.sample_bounds import sample_bounds, square_bounds
from samplekit.kernels import expansion_sum, helper, kernel, two_difference, two_product, two_sum

Array = NDArray[np.float64]
Pair = tuple[float, float]
"""A double-double."""
Part = tuple[Pair, Pair, float]
"""Start, end and length of an interval."""

SMALLEST = 1e-150
"""Smallest radius but 0: its square does not underflow."""

# Area of a circular segment: (theta - sin theta) / (theta³ / 6) = 1 - theta²/20 + ..., to 2^-53 for theta <= pi/2.
_SEGMENT = tuple((-1.0) ** k * 6.0 / math.factorial(2 * k + 3) for k in range(12))


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64, float64, float64)")
def _sums(tile: Array, boxes: Array, out: Array, cx: float, cy: float, radius: float) -> None:
    squared = radius * radius
    for pixel in range(tile.shape[0]):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        # An integer: its sum has no order, so the loop becomes vector instructions.
        inside = 0
        for i in range(tile.shape[2]):
            x = left + tile[pixel, 0, i] * width - cx
            y = top + tile[pixel, 1, i] * height - cy
            inside += x * x + y * y < squared
        out[pixel] = inside


@kernel("float64(UniTuple(float64, 2), UniTuple(float64, 2), float64, float64[::1])")
def _inwards(x: Pair, y: Pair, radius: float, terms: Array) -> float:
    """Return r² - x² - y² for 0 <= x, y <= r, 1/2 <= r < 1, within 3u relative; ``terms``: float64[14], workspace."""
    rr, rr_low = two_product(radius, radius)
    xx, xx_low = two_product(x[0], x[0])
    yy, yy_low = two_product(y[0], y[0])
    total, total_low = two_sum(xx, yy)
    rest, rest_low = two_difference(rr, total)
    squares_low = (xx_low + 2.0 * x[0] * x[1]) + (yy_low + 2.0 * y[0] * y[1])
    result = rest + ((rest_low - total_low) + (rr_low - squares_low))
    # All that was rounded or left out stays below 2^-100.
    if abs(result) > 2.0**-46:
        return result
    terms[0], terms[1] = rr, rr_low
    terms[2], terms[3] = -xx, -xx_low
    terms[4], terms[5] = two_product(-2.0 * x[0], x[1])
    terms[6], terms[7] = two_product(-x[1], x[1])
    terms[8], terms[9] = -yy, -yy_low
    terms[10], terms[11] = two_product(-2.0 * y[0], y[1])
    terms[12], terms[13] = two_product(-y[1], y[1])
    return expansion_sum(terms, 14)


@helper
def _leg(x: Pair, radius: float) -> float:
    """Return sqrt(r² - x²) for 0 <= x <= r, without cancellation."""
    gap, gap_low = two_difference(radius, x[0])
    return math.sqrt((gap + (gap_low - x[1])) * (radius + x[0]))


@helper
def _segment(half: float) -> float:
    """Return the area of a circular segment over its chord squared; ``half`` = chord / (2 r) <= sqrt(1/2)."""
    if half < 1e-100:
        return half / 6.0
    theta = 2.0 * math.asin(half)
    z = theta * theta
    series = 0.0
    for k in range(11, -1, -1):
        series = series * z + _SEGMENT[k]
    # r² (theta - sin theta) / 2 over (2 r half)²
    return theta / 48.0 * (z / (half * half)) * series


@helper
def _quadrant_mean(x: Part, y: Part, width: float, height: float, radius: float, terms: Array) -> float:
    """Return the area within the circle of [a, b] x [c, d], 0 <= a < b <= r and 0 <= c < d <= r, over width * height.

    ``x`` = (a, b, b - a) and ``y`` = (c, d, d - c) may be part of a pixel; ``width`` and ``height`` are the whole's.
    """
    a, b, across = x
    c, d, down = y
    near = _inwards(a, c, radius, terms)
    if near <= 0.0:
        return 0.0
    if _inwards(b, d, radius, terms) >= 0.0:
        return across / width * (down / height)
    # The arc falls from (u_left, v_left) to (u_right, v_right), offsets from the corner (a, c).
    u_left, v_left, u_right, v_right = 0.0, down, across, 0.0
    corner = _inwards(a, d, radius, terms)
    if corner > 0.0:
        u_left = min(across, corner / (_leg(d, radius) + a[0]))
    else:
        v_left = min(down, near / (_leg(a, radius) + c[0]))
    corner = _inwards(b, c, radius, terms)
    if corner > 0.0:
        v_right = min(down, corner / (_leg(b, radius) + c[0]))
    else:
        u_right = min(across, near / (_leg(c, radius) + a[0]))
    run, fall = max(u_right - u_left, 0.0), max(v_left - v_right, 0.0)
    chord = math.sqrt(run * run + fall * fall)
    segment = chord / width * (chord / height) * _segment(chord / (2.0 * radius))
    # The arc stays within the box run x fall, beyond its diagonal: a bound where run or fall is nothing but rounding.
    segment = min(segment, run / width * (fall / height) * 0.5)
    return u_left / width * (down / height) + run / width * ((v_left + v_right) * 0.5 / height) + segment


@helper
def _offset(edge: float, centre: float, scale: float) -> Pair:
    """Return ``(edge - centre) * scale`` exactly, or -2 or 2 far outside the circle."""
    high, low = two_difference(edge, centre)
    high *= scale
    return (high, low * scale) if abs(high) <= 2.0 else (math.copysign(2.0, high), 0.0)


@helper
def _clip(start: Pair, end: Pair, length: float, radius: float) -> Part:
    """Cut an interval down to [0, r]: the length is at most 0 if nothing is left."""
    starts_before = start[0] < 0.0
    ends_beyond = end[0] > radius or (end[0] == radius and end[1] > 0.0)
    if starts_before:
        start = (0.0, 0.0)
    if ends_beyond:
        end = (radius, 0.0)
    if starts_before or ends_beyond:
        high, low = two_difference(end[0], start[0])
        length = high + (low + (end[1] - start[1]))
    return start, end, length


@kernel("void(float64[::1], float64[::1], float64, float64, float64, float64, float64[:,::1])")
def _fill_means(x: Array, y: Array, cx: float, cy: float, radius: float, scale: float, out: Array) -> None:
    """Replace every NaN in ``out`` float64[h, w] by its pixel's mean; ``scale`` is the 2^k that takes r to [1/2, 1)."""
    r = radius * scale
    terms = np.empty(14)
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            if not math.isnan(out[j, i]):
                continue
            width, height = (x[i + 1] - x[i]) * scale, (y[j + 1] - y[j]) * scale
            left, right = _offset(x[i], cx, scale), _offset(x[i + 1], cx, scale)
            top, bottom = _offset(y[j], cy, scale), _offset(y[j + 1], cy, scale)
            total = 0.0
            for _ in range(2):
                columns = _clip(left, right, width, r)
                for _ in range(2):
                    rows = _clip(top, bottom, height, r)
                    if columns[2] > 0.0 and rows[2] > 0.0:
                        total += _quadrant_mean(columns, rows, width, height, r, terms)
                    top, bottom = (-bottom[0], -bottom[1]), (-top[0], -top[1])
                left, right = (-right[0], -right[1]), (-left[0], -left[1])
            out[j, i] = min(total, 1.0)


class Disk(Scene):
    """1 where (x - cx)² + (y - cy)² < radius², else 0.

    Parameters
    ----------
    radius
        0 (nothing is inside), or from 1e-150 to 1e150.
    cx, cy
        Centre, from -1e150 to 1e150.

    Raises
    ------
    UsageError
        The radius is neither 0 nor at least 1e-150.
    """

    value_range = (0.0, 1.0)

    def __init__(self, radius: float = 0.3, cx: float = 0.4523, cy: float = 0.5317) -> None:
        if 0.0 < radius < SMALLEST:
            raise UsageError(f"disk: radius={radius}: expected 0, or a number of at least {SMALLEST:g}")
        self.radius, self.cx, self.cy = float(radius), float(cx), float(cy)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count each pixel's samples inside: see :meth:`Scene.sums`."""
        _sums(tile, boxes, out, self.cx, self.cy, self.radius)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the fraction of each pixel that the disk covers: float64[h, w], within 1e-14 relative.

        Edges, centre and radius are the float64 numbers given, and edges may lie anywhere. The bound holds for widths
        and heights from 1e-100 to 1e100 times the radius.
        """
        x, y = np.array(x_edges, np.float64), np.array(y_edges, np.float64)
        # Sums of rounded squares are within 5u of the truth; 2^-48 is 32u.
        means = self._classify(x, y, 2.0**-48)
        scale = 2.0 ** -math.frexp(self.radius)[1]
        _fill_means(x, y, self.cx, self.cy, self.radius, scale, means)
        return means

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 or 0 where every sample of the pixel gives that in ``sums``, NaN elsewhere: float64[h, w]."""
        return self._classify(x_edges, y_edges, 0.0)

    def _classify(self, x_edges: Array, y_edges: Array, margin: float) -> Array:
        """Return 1 for pixels inside, 0 for pixels outside, NaN for those within ``margin`` of the circle."""
        (near_x, far_x), (near_y, far_y) = (
            square_bounds(*(place - centre for place in sample_bounds(edges)))
            for edges, centre in ((x_edges, self.cx), (y_edges, self.cy))
        )
        squared = self.radius * self.radius
        classes = np.where(far_y[:, None] + far_x < squared * (1.0 - margin), 1.0, np.nan)
        classes[near_y[:, None] + near_x >= squared * (1.0 + margin)] = 0.0
        return classes
