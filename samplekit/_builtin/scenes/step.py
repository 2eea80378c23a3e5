"""The step: 1 on one side of a line and 0 on the other, sheer or as a sigmoid, with its exact mean over a pixel.

The part of a box below a line is the distribution function of a sum of two uniform numbers: quadratic, linear, then
quadratic in the line's distance from the box's nearest corner. That distance cancels where a pixel is small against its
place, so it is a difference of double-doubles. A part above one half is computed from the opposite corner.

With a width the step is the sigmoid 1 / (1 + exp(d / width)) of the distance d past the line. Over a box d is a sum of
two uniform numbers, whose density is a trapezoid. The mean is a one-dimensional integral of density times sigmoid, in
units of the width, by Gauss's rule between the corners of the trapezoid. Every term is positive, so that nothing
cancels, whether the width is small or large against the box.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene, UsageError
from samplekit._builtin.scenes.sample_bounds import product_bounds, sample_bounds
from samplekit.kernels import BLOCK, dd_add, direction, exp_of_minus, fma, helper, kernel, lane_sum, two_product
from samplekit.quadrature import NODES, WEIGHTS

Array = NDArray[np.float64]

_ALWAYS_0 = 746.0  # 1 / (1 + exp(v)) underflows to 0 from 745.14 on
_ALWAYS_1 = -38.0  # and rounds to 1 before -36.74
_FULL = -40.0  # the sigmoid is 1 within 4e-18
_TAIL = 45.0  # beyond this distance from its start, or from 0, the integral has less than 2e-18 of its value
_FAR_BEFORE = -100.0
_PANEL = 6.0  # the sigmoid's poles are at +-i pi: 24 nodes are right to 1e-18


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64, float64, float64)")
def _sums(tile: Array, boxes: Array, out: Array, cosine: float, sine: float, offset: float) -> None:
    for pixel in range(tile.shape[0]):
        left, width, top, height = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        # An integer: its sum has no order, so the loop becomes vector instructions.
        below = 0
        for i in range(tile.shape[2]):
            x = left + tile[pixel, 0, i] * width
            y = top + tile[pixel, 1, i] * height
            below += cosine * x + sine * y < offset
        out[pixel] = below


@helper
def _sigmoid(v: float) -> float:
    """Return 1 / (1 + exp(v))."""
    small = exp_of_minus(abs(v))
    return (small if v > 0.0 else 1.0) / (1.0 + small)


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64, float64, float64, float64[::1])")
def _smooth_sums(
    tile: Array, boxes: Array, cosine: float, sine: float, offset: float, width: float, out: Array
) -> None:
    """Sum the sigmoid over each pixel's samples: see :meth:`Scene.sums`."""
    values = np.empty(BLOCK)
    steepness = 1.0 / width
    for pixel in range(tile.shape[0]):
        # Distances are computed from the corner, so that they are rounded in units of the pixel, not of the picture.
        along, along_low = two_product(cosine, boxes[0, pixel])
        down, down_low = two_product(sine, boxes[2, pixel])
        corner, corner_low = dd_add(along, along_low, down, down_low)
        corner = dd_add(corner, corner_low, -offset, 0.0)[0]
        across, fall = cosine * boxes[1, pixel], sine * boxes[3, pixel]
        for i in range(tile.shape[2]):
            distance = fma(tile[pixel, 0, i], across, fma(tile[pixel, 1, i], fall, corner))
            values[i] = _sigmoid(distance * steepness)
        out[pixel] = lane_sum(values, tile.shape[2])


@kernel("float64(float64, float64, float64, float64, float64, float64)")
def _panel(start: float, end: float, first: float, last: float, shift: float, shorter: float) -> float:
    """Integrate density times sigmoid over [start, end], without the density's factor 1 / longer.

    Places are in units of the width. The trapezoid reaches from ``first`` to ``last`` with flanks of the length
    ``shorter``; the sigmoid is evaluated at the place plus ``shift``.
    """
    middle, half = 0.5 * (start + end), 0.5 * (end - start)
    total = 0.0
    for node in range(NODES.size):
        pair = 0.0
        for sign in (-1.0, 1.0):
            place = middle + sign * half * NODES[node]
            ramp = min(place - first, last - place)
            height = 1.0 if ramp >= shorter else ramp / shorter
            pair += max(height, 0.0) * _sigmoid(place + shift)
        total += 0.5 * WEIGHTS[node] * pair
    return total * 2.0 * half


@kernel("float64(float64, float64, float64, float64, float64)")
def _smooth_mean(below: float, above: float, p: float, q: float, width: float) -> float:
    """Return the mean over a box whose corners are ``below`` before the line and ``above`` past it, p + q apart."""
    shorter, longer = min(p, q) / width, max(p, q) / width
    before, after = -below / width, above / width
    if before >= _ALWAYS_0:
        return 0.0
    if after <= _FULL:
        return 1.0
    # Places are counted from the box's first corner, so that the flanks keep their digits. Where that corner is far
    # before the line they are counted from the line, so that the sigmoid keeps its digits: the box is then as large.
    first, last, shift = 0.0, shorter + longer, before
    if before < _FAR_BEFORE:
        first, last, shift = before, after, 0.0
    end = min(last, max(first, -shift) + _TAIL)
    full, first_kink, second_kink = _FULL - shift, first + shorter, last - shorter
    here, integral = first, 0.0
    while here < end:
        there = end
        if here < full < there:
            there = full
        if here < first_kink < there:
            there = first_kink
        if here < second_kink < there:
            there = second_kink
        # Where the sigmoid is 1, the integrand is the density, and one panel is exact.
        panels = 1.0 if there <= full else np.ceil((there - here) / _PANEL)
        step = (there - here) / panels
        for panel in range(int(panels)):
            until = there if panel == panels - 1.0 else here + (panel + 1.0) * step
            integral += _panel(here + panel * step, until, first, last, shift, shorter)
        here = there
    return min(integral / longer, 1.0)


@helper
def _corner(distance: float, p: float, q: float) -> float:
    """Return P(p U + q V < distance) for independent uniform U, V, where ``distance`` <= (p + q) / 2."""
    shorter, longer = min(p, q), max(p, q)
    if distance <= 0.0:
        return 0.0
    if distance <= shorter:
        return 0.5 * (distance / shorter) * (distance / longer)
    return (distance - 0.5 * shorter) / longer


@kernel("void(float64[::1], float64[::1], float64, float64, float64, float64[:,::1], float64[:,::1])")
def _distances(x: Array, y: Array, cosine: float, sine: float, offset: float, below: Array, above: Array) -> None:
    """Write how far the line is past each pixel's first corner, and the last corner past the line: float64[h, w]."""
    rows, columns = below.shape
    # The share of each vertical edge in the distance, as a double-double.
    taken, taken_low = np.empty(columns + 1), np.empty(columns + 1)
    for i in range(columns + 1):
        taken[i], taken_low[i] = two_product(-cosine, x[i])
    # The corner nearest to the side of ones, and its opposite.
    left = 0 if cosine >= 0.0 else 1
    top = 0 if sine >= 0.0 else 1
    for j in range(rows):
        product, error = two_product(-sine, y[j + top])
        near, near_low = dd_add(offset, 0.0, product, error)
        product, error = two_product(-sine, y[j + 1 - top])
        far, far_low = dd_add(offset, 0.0, product, error)
        for i in range(columns):
            below[j, i] = dd_add(near, near_low, taken[i + left], taken_low[i + left])[0]
            above[j, i] = -dd_add(far, far_low, taken[i + 1 - left], taken_low[i + 1 - left])[0]


@kernel("void(float64[:,::1], float64[:,::1], float64[::1], float64[::1], float64, float64[:,::1])")
def _smooth_means(below: Array, above: Array, p: Array, q: Array, width: float, out: Array) -> None:
    """Write the mean of the sigmoid over each pixel; the arrays as for ``_means``."""
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            out[j, i] = _smooth_mean(below[j, i], above[j, i], p[i], q[j], width)


@kernel("void(float64[:,::1], float64[:,::1], float64[::1], float64[::1], float64[:,::1])")
def _means(below: Array, above: Array, p: Array, q: Array, out: Array) -> None:
    """Write the mean over each pixel, float64[h, w]; ``p`` and ``q`` are the pixels' extents along the normal."""
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            if above[j, i] <= 0.0:
                out[j, i] = 1.0
            elif below[j, i] <= above[j, i]:
                out[j, i] = _corner(below[j, i], p[i], q[j])
            else:
                out[j, i] = 1.0 - _corner(above[j, i], p[i], q[j])


class Step(Scene):
    """1 where cos(angle) x + sin(angle) y < offset, else 0; with a width the sigmoid 1 / (1 + exp(d / width)).

    Here d = cos(angle) x + sin(angle) y - offset is the distance from the line; the slope there is 1 / (4 width).

    The float64 numbers ``cosine``, ``sine`` and ``offset`` define the line, for samples and reference alike; they
    differ from those of the true angle by at most 2e-16.

    Parameters
    ----------
    angle
        Direction of the line's normal in degrees, towards the zeros; 90 points down the image. Any finite number.
    offset
        Distance of the line from the origin along the normal, from -1e150 to 1e150.
    width
        Width of the sigmoid: 0 (sheer), or from 1e-150 to 1e150.

    Raises
    ------
    UsageError
        The width is neither 0 nor at least 1e-150.
    """

    value_range = (0.0, 1.0)

    def __init__(self, angle: float = 0.0, offset: float = 0.5, width: float = 0.0) -> None:
        if 0.0 < width < 1e-150:
            raise UsageError(f"step: width={width}: expected 0, or a number of at least 1e-150")
        self.cosine, self.sine = direction(angle)
        self.offset, self.width = float(offset), float(width)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count each pixel's samples on the side of ones, or sum the sigmoid: see :meth:`Scene.sums`."""
        if self.width > 0.0:
            _smooth_sums(tile, boxes, self.cosine, self.sine, self.offset, self.width, out)
        else:
            _sums(tile, boxes, out, self.cosine, self.sine, self.offset)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 1e-15; with a width 2e-15, and 1e-12 relative.

        Edges may lie anywhere; the bound holds for widths and heights above 1e-14 of their distance from the origin.
        """
        x, y = np.array(x_edges, np.float64), np.array(y_edges, np.float64)
        below, above, means = np.empty((3, y.size - 1, x.size - 1))
        _distances(x, y, self.cosine, self.sine, self.offset, below, above)
        p, q = abs(self.cosine) * np.diff(x), abs(self.sine) * np.diff(y)
        if self.width > 0.0:
            _smooth_means(below, above, p, q, self.width, means)
        else:
            _means(below, above, p, q, means)
        return means

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 or 0 where every sample of the pixel gives that in ``sums``, NaN elsewhere: float64[h, w]."""
        low_x, high_x = product_bounds(self.cosine, sample_bounds(x_edges))
        low_y, high_y = product_bounds(self.sine, sample_bounds(y_edges))
        low, high = low_y[:, None] + low_x, high_y[:, None] + high_x
        if self.width == 0.0:
            return np.where(low >= self.offset, 0.0, np.where(high < self.offset, 1.0, np.nan))
        # The sigmoid's samples are rounded once more than the bounds.
        slack = 2.0**-48 * (np.maximum(abs(low), abs(high)) + abs(self.offset)) + 1e-300
        with np.errstate(over="ignore"):
            least, most = (low - self.offset - slack) / self.width, (high - self.offset + slack) / self.width
        return np.where(least > _ALWAYS_0, 0.0, np.where(most < _ALWAYS_1, 1.0, np.nan))
