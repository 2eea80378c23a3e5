"""The exact area of an ellipse in every pixel, as an integral over its chords.

At height d above the centre the chord reaches from k d - s(d) to k d + s(d), with s(d) = m sqrt((H - d)(H + d)). The
part of it inside a pixel is the least of four differences. One of them is the chord's own length, which is never formed
by subtraction; so the area of a needle is right to all digits, although its thickness is far below the rounding of its
place. The range of heights is cut where a chord begins or ends on a side of the pixel. Between the cuts the integrand
is smooth but for the square root, which the substitution H - d = t² removes near the ellipse's end. Offsets are
double-doubles.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import dd_add, dd_multiply, helper, kernel, quick_two_sum, two_difference, two_product
from samplekit.quadrature import NODES, WEIGHTS

Array = NDArray[np.float64]
Pair = tuple[float, float]
"""A double-double."""

_NEAR_THE_END = 0.25
"""The substitution is made where a piece is nearer to the ellipse's end than this part of its own length."""


def ellipse_means(
    x_edges: Array,
    y_edges: Array,
    centre: tuple[float, float],
    direction: tuple[float, float],
    axes: tuple[float, float],
) -> Array:
    """Return the fraction of each pixel within the ellipse: float64[h, w].

    Parameters
    ----------
    x_edges, y_edges
        The edges of the pixels: float64[w + 1] and float64[h + 1].
    centre
        The ellipse's x and y.
    direction
        Cosine c and sine s of the longer axis. Their squares need not add up to exactly 1: the ellipse is
        (c x + s y)² / a² + (c y - s x)² / b² < 1.
    axes
        Half of the longer axis, a, and of the shorter, b.
    """
    c, s, a, b = (Fraction(number) for number in (*direction, *axes))
    # A x² + 2 B x y + C y² < 1 with the determinant A C - B² = root²
    first, second = c * c / (a * a) + s * s / (b * b), s * s / (a * a) + c * c / (b * b)
    mixed, root = c * s * (1 / (a * a) - 1 / (b * b)), (c * c + s * s) / (a * b)
    rows = _chord_numbers(first, mixed, root)
    columns = _chord_numbers(second, mixed, root)
    means = np.empty((y_edges.size - 1, x_edges.size - 1))
    _means(x_edges, y_edges, *centre, rows, columns, means)
    return means


def _chord_numbers(along: Fraction, mixed: Fraction, root: Fraction) -> Array:
    """Return H, k and m as double-doubles, float64[6]."""
    numbers = (_square_root(along) / root, -mixed / along, root / along)
    return np.array([part for number in numbers for part in (float(number), float(number - Fraction(float(number))))])


def _square_root(value: Fraction) -> Fraction:
    """Return the square root within 2^-120 relative."""
    shift = max(0, 130 - (value.numerator.bit_length() - value.denominator.bit_length()) // 2)
    return Fraction(math.isqrt((value.numerator << 2 * shift) // value.denominator), 1 << shift)


@helper
def _root(a: float, a_low: float) -> Pair:
    """Return the square root of a double-double, or 0 if that is not positive."""
    if a <= 0.0:
        return 0.0, 0.0
    high = math.sqrt(a)
    square, square_low = two_product(high, high)
    rest = dd_add(a, a_low, -square, -square_low)[0]
    return quick_two_sum(high, rest / (2.0 * high))


@kernel("void(float64, float64, float64[::1], float64[::1])")
def _chord(d: float, d_low: float, numbers: Array, ends: Array) -> None:
    """Write the left and the right end of the chord at height d as double-doubles, then its length: float64[5]."""
    above, above_low = dd_add(numbers[0], numbers[1], -d, -d_low)
    below, below_low = dd_add(numbers[0], numbers[1], d, d_low)
    product, product_low = dd_multiply(max(above, 0.0), above_low, max(below, 0.0), below_low)
    root, root_low = _root(product, product_low)
    half, half_low = dd_multiply(root, root_low, numbers[4], numbers[5])
    middle, middle_low = dd_multiply(d, d_low, numbers[2], numbers[3])
    ends[0], ends[1] = dd_add(middle, middle_low, -half, -half_low)
    ends[2], ends[3] = dd_add(middle, middle_low, half, half_low)
    ends[4] = 2.0 * half


@kernel("float64(float64, float64, float64[::1], float64[::1], float64[::1])")
def _inside(d: float, d_low: float, sides: Array, numbers: Array, ends: Array) -> float:
    """Return the length of the chord at height d inside ``sides``: left and right as double-doubles, then the width."""
    _chord(d, d_low, numbers, ends)
    from_left = dd_add(ends[2], ends[3], -sides[0], -sides[1])[0]
    to_right = dd_add(sides[2], sides[3], -ends[0], -ends[1])[0]
    inside: float = max(0.0, min(min(ends[4], sides[4]), min(from_left, to_right)))
    return inside


@kernel("float64(float64[::1], float64[::1], float64[::1], float64[::1], float64[::1])")
def _piece(start: Array, stop: Array, sides: Array, numbers: Array, ends: Array) -> float:
    """Integrate the chords between two heights, given as double-doubles, between which the integrand is smooth."""
    size = dd_add(stop[0], stop[1], -start[0], -start[1])[0]
    to_lower = dd_add(start[0], start[1], numbers[0], numbers[1])[0]
    to_upper = dd_add(numbers[0], numbers[1], -stop[0], -stop[1])[0]
    # The end of the ellipse that is near: -1 the lower, 1 the upper, 0 none.
    end = 0.0
    if to_lower < _NEAR_THE_END * size:
        end = -1.0
    elif to_upper < _NEAR_THE_END * size:
        end = 1.0
    if end == 0.0:
        low, high = 0.0, size
    else:
        nearest = max(to_lower if end < 0.0 else to_upper, 0.0)
        low, high = math.sqrt(nearest), math.sqrt(nearest + size)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    total = 0.0
    for node in range(2 * NODES.size):
        k = node // 2
        t = middle + (half if node % 2 else -half) * NODES[k]
        if end == 0.0:
            d, d_low = dd_add(start[0], start[1], t, 0.0)
            weight = 1.0
        else:
            square, square_low = two_product(t, t)
            d, d_low = dd_add(numbers[0], numbers[1], -square, -square_low)
            d, d_low = end * d, end * d_low
            weight = 2.0 * t
        total += 0.5 * WEIGHTS[k] * weight * _inside(d, d_low, sides, numbers, ends)
    return total * (high - low)


@kernel("void(float64[:,::1], int64, float64, float64)")
def _insert(heights: Array, count: int, d: float, d_low: float) -> None:
    """Insert a double-double into the rising ``heights`` float64[> count, 2]."""
    k = count
    while k > 0 and (heights[k - 1, 0] > d or (heights[k - 1, 0] == d and heights[k - 1, 1] > d_low)):
        heights[k] = heights[k - 1]
        k -= 1
    heights[k, 0], heights[k, 1] = d, d_low


@kernel("float64(float64[::1], float64[::1], float64[::1], float64[::1], float64[:,::1], float64[::1])")
def _area(sides: Array, levels: Array, rows: Array, columns: Array, heights: Array, ends: Array) -> float:
    """Integrate the chords within a pixel: ``sides`` as in ``_inside``, ``levels`` top and bottom as double-doubles."""
    start, start_low = levels[0], levels[1]
    if dd_add(start, start_low, rows[0], rows[1])[0] < 0.0:
        start, start_low = -rows[0], -rows[1]
    stop, stop_low = levels[2], levels[3]
    if dd_add(rows[0], rows[1], -stop, -stop_low)[0] < 0.0:
        stop, stop_low = rows[0], rows[1]
    if dd_add(stop, stop_low, -start, -start_low)[0] <= 0.0:
        return 0.0
    heights[0, 0], heights[0, 1] = start, start_low
    _insert(heights, 1, stop, stop_low)
    # Cuts: the middle, so that no piece is near both ends of the ellipse; and wherever the integrand is not smooth.
    _insert(heights, 2, 0.0, 0.0)
    count = 3
    for side in range(2):
        x, x_low = sides[2 * side], sides[2 * side + 1]
        sign = math.copysign(1.0, x)
        if dd_add(columns[0], columns[1], -sign * x, -sign * x_low)[0] > 0.0:
            _chord(x, x_low, columns, ends)
            first, first_low, last, last_low = ends[0], ends[1], ends[2], ends[3]
            _insert(heights, count, first, first_low)
            _insert(heights, count + 1, last, last_low)
            count += 2
    total = 0.0
    for k in range(count - 1):
        below = dd_add(heights[k, 0], heights[k, 1], -start, -start_low)[0] < 0.0
        above = dd_add(stop, stop_low, -heights[k + 1, 0], -heights[k + 1, 1])[0] < 0.0
        empty = dd_add(heights[k + 1, 0], heights[k + 1, 1], -heights[k, 0], -heights[k, 1])[0] <= 0.0
        if not (below or above or empty):
            total += _piece(heights[k], heights[k + 1], sides, rows, ends)
    return total


@kernel("UniTuple(float64, 2)(float64, float64, float64[::1], float64[::1], float64[::1])")
def _reach(top: float, bottom: float, rows: Array, columns: Array, ends: Array) -> Pair:
    """Return bounds of how far the ellipse reaches to the left and to the right between two heights."""
    low, high = max(top, -rows[0]), min(bottom, rows[0])
    _chord(low, 0.0, rows, ends)
    left, right = ends[0], ends[2]
    _chord(high, 0.0, rows, ends)
    left, right = min(left, ends[0]), max(right, ends[2])
    # Where the ellipse is widest: a height k' x on either side.
    farthest = columns[0]
    peak = columns[2] * farthest
    if low <= peak <= high:
        right = farthest
    if low <= -peak <= high:
        left = -farthest
    # At the ellipse's end a height that is off by one rounding moves the ends of a chord by its square root.
    slack = 2.0**-24 * farthest
    return left - slack, right + slack


@kernel("void(float64[::1], float64[::1], float64, float64, float64[::1], float64[::1], float64[:,::1])")
def _means(x: Array, y: Array, cx: float, cy: float, rows: Array, columns: Array, out: Array) -> None:
    sides, levels, heights, ends = np.empty(5), np.empty(4), np.empty((7, 2)), np.empty(5)
    for j in range(out.shape[0]):
        levels[0], levels[1] = two_difference(y[j], cy)
        levels[2], levels[3] = two_difference(y[j + 1], cy)
        if levels[0] > rows[0] or levels[2] < -rows[0]:
            out[j] = 0.0
            continue
        height = y[j + 1] - y[j]
        least, most = _reach(levels[0], levels[2], rows, columns, ends)
        for i in range(out.shape[1]):
            sides[0], sides[1] = two_difference(x[i], cx)
            sides[2], sides[3] = two_difference(x[i + 1], cx)
            sides[4] = x[i + 1] - x[i]
            if sides[0] > most or sides[2] < least:
                out[j, i] = 0.0
                continue
            area = _area(sides, levels, rows, columns, heights, ends)
            out[j, i] = min(area / (sides[4] * height), 1.0)
