"""The step with a width: a sigmoid across the line, 1 / (1 + exp(d / width)), from a slow ramp to a sheer edge.

Over a box d is a sum of two uniform numbers, whose density is a trapezoid. The mean is a one-dimensional integral of
density times sigmoid, in units of the width, by Gauss's rule between the corners of the trapezoid. Every term is
positive, so that nothing cancels, whether the width is small or large against the box.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import BLOCK, dd_add, exp_of_minus, fma, helper, kernel, lane_sum, two_product
from samplekit.quadrature import NODES, WEIGHTS

Array = NDArray[np.float64]

_ALWAYS_0 = 746.0  # 1 / (1 + exp(v)) underflows to 0 from 745.14 on
_ALWAYS_1 = -38.0  # and rounds to 1 before -36.74
_FULL = -40.0  # the sigmoid is 1 within 4e-18
_TAIL = 45.0  # beyond this distance from its start, or from 0, the integral has less than 2e-18 of its value
_FAR_BEFORE = -100.0
_PANEL = 6.0  # the sigmoid's poles are at +-i pi: 24 nodes are right to 1e-18


@helper
def _sigmoid(v: float) -> float:
    """Return 1 / (1 + exp(v))."""
    small = exp_of_minus(abs(v))
    return (small if v > 0.0 else 1.0) / (1.0 + small)


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64, float64, float64, float64[::1])")
def smooth_sums(tile: Array, boxes: Array, cosine: float, sine: float, offset: float, width: float, out: Array) -> None:
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
def _mean(below: float, above: float, p: float, q: float, width: float) -> float:
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


@kernel("void(float64[:,::1], float64[:,::1], float64[::1], float64[::1], float64, float64[:,::1])")
def smooth_means(below: Array, above: Array, p: Array, q: Array, width: float, out: Array) -> None:
    """Write the mean over each pixel into ``out`` float64[h, w].

    Parameters
    ----------
    below, above
        float64[h, w]: how far the line is past the pixel's first corner, and the last corner past the line.
    p, q
        float64[w], float64[h]: extent of the pixels along the normal, from their width and from their height.
    width
        Width of the sigmoid, above 0.
    """
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            out[j, i] = _mean(below[j, i], above[j, i], p[i], q[j], width)


def smooth_constant(low: Array, high: Array, offset: float, width: float) -> Array:
    """Return 1 or 0 where the sigmoid of every sample rounds to that, NaN elsewhere.

    ``low`` and ``high`` bound cos(angle) x + sin(angle) y over each pixel; the slack bounds the rounding of samples.
    """
    slack = 2.0**-48 * (np.maximum(abs(low), abs(high)) + abs(offset)) + 1e-300
    with np.errstate(over="ignore"):
        least, most = (low - offset - slack) / width, (high - offset + slack) / width
    return np.where(least > _ALWAYS_0, 0.0, np.where(most < _ALWAYS_1, 1.0, np.nan))
