"""Exact means of Genz's integrands over a pixel and all further dimensions: products of means in one dimension.

The corner peak is no product. The textbook's sum of 2^d alternating terms loses every digit for small coefficients and
many dimensions. With t^-(d+1) = 1/d! ∫ s^d exp(-s t) ds the mean is one integral of positive terms,

    1/d! ∫ s^d exp(-s (1 + sum a_i l_i)) prod phi(s a_i h_i) ds,    phi(z) = (1 - exp(-z)) / z,

over a box with the lower corner l and the sides h. The trapezoidal rule in log s gives all its digits, since the
integrand is analytic in a strip and vanishes at both ends (Trefethen, Weideman 2014, "The exponentially convergent
trapezoidal rule", SIAM Review 56).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit._builtin.declarations.scenes import GENZ_FAMILIES
from samplekit._builtin.scenes.gaussian import gaussian_means
from samplekit.kernels import (
    cosine_of_turns,
    dd_add,
    dd_multiply,
    dd_scale,
    kernel,
    lane_sum,
    two_difference,
    two_product,
    two_sum,
)

Array = NDArray[np.float64]
Sides = tuple[Array, Array]
"""Left and right ends of neighbouring intervals, float64[n] each; for points both are the same array."""

_WHOLE = np.zeros(1), np.ones(1)
"""The one interval [0, 1], as the sides that functions here take."""
_STEP = 0.125
_LOGS = np.arange(-72.0, 5.0, _STEP)
"""Logarithms of s: below them s^d is negligible, above them exp(-s)."""
_TAU_LOW = 2.4492935982947064e-16  # what 2 pi is beyond math.tau

_, _PRODUCT_PEAK, _, _GAUSSIAN, _CONTINUOUS, _ = range(len(GENZ_FAMILIES))


def genz_means(family: str, a: Array, u: float, x: Sides, y: Sides) -> Array:
    """Return the mean over every pixel x by y: float64[h, w].

    Parameters
    ----------
    family, a, u
        The family, its coefficients float64[d] and its place: see
        :class:`samplekit._builtin.scenes.oscillating.Oscillating`.
    x, y
        Ends of the columns, left and right, and of the rows, top and bottom.
    """
    if family == "oscillatory":
        return _waves(a, u, x, y)
    if family == "corner-peak":
        return _corner_peaks(a, x, y)
    code = GENZ_FAMILIES.index(family)
    columns = _along(code, a[0], u, x)
    rows = _along(code, a[1], u, y) if a.size > 1 else np.ones(y[0].size)
    rest = 1.0
    for coefficient in a[2:]:
        rest *= float(_along(code, coefficient, 1.0 if family == "discontinuous" else u, _WHOLE)[0])
    return np.multiply.outer(rows, columns) * rest


def _along(code: int, a: float, u: float, sides: Sides) -> Array:
    """Average the factor of one dimension over intervals: float64[n]."""
    if code == _GAUSSIAN:
        left, right = sides
        if left is right:
            values: Array = np.exp(-np.square(a * (left - u)))
            return values
        return gaussian_means(np.append(left, right[-1:]), u, a)
    means = np.empty(sides[0].size)
    _factor_means(code, a, u, *sides, means)
    return means


@kernel("float64(float64, float64, float64, float64)")
def _decay(a: float, before: float, after: float, width: float) -> float:
    """Average exp(-a t) over [near, near + width], near = after - before >= 0."""
    near, near_low = two_difference(after, before)
    exponent, low = two_product(a, near)
    low += a * near_low
    across = a * width
    return math.exp(-exponent) * (1.0 - low) * (-math.expm1(-across) / across if across > 0.0 else 1.0)


@kernel("void(int64, float64, float64, float64[::1], float64[::1], float64[::1])")
def _factor_means(code: int, a: float, u: float, left: Array, right: Array, out: Array) -> None:
    for i in range(out.size):
        width = right[i] - left[i]
        if code == _PRODUCT_PEAK:
            first, last = a * (left[i] - u), a * (right[i] - u)
            # One angle in place of the difference of two arctangents.
            angle = math.atan2(a * width, 1.0 + first * last)
            out[i] = angle / (a * width) if a * width > 0.0 else 1.0 / (1.0 + first * first)
        elif code == _CONTINUOUS:
            if left[i] >= u:
                out[i] = _decay(a, u, left[i], width)
            elif right[i] <= u:
                out[i] = _decay(a, right[i], u, width)
            else:
                before, after = u - left[i], right[i] - u
                out[i] = (before * _decay(a, 0.0, 0.0, before) + after * _decay(a, 0.0, 0.0, after)) / width
        elif left[i] > u or (left[i] == u and width > 0.0):
            out[i] = 0.0
        else:
            end = min(right[i], u)
            share = (end - left[i]) / width if end < right[i] else 1.0
            out[i] = share * _decay(a, end, u, end - left[i])


@kernel("void(float64, float64[::1], float64[::1], float64[::1], float64[::1])")
def _wave_means(a: float, left: Array, right: Array, turns: Array, lengths: Array) -> None:
    """Average exp(2 pi i a x) over intervals: write the phase in turns, and the real factor sinc(a (right - left))."""
    for i in range(left.size):
        total, low = two_sum(left[i], right[i])
        phase, phase_low = dd_scale(0.5 * total, 0.5 * low, a)
        turns[i] = (phase - np.rint(phase)) + phase_low
        width, width_low = two_difference(right[i], left[i])
        half, half_low = dd_scale(0.5 * width, 0.5 * width_low, a)
        # sin(2 pi t) = cos(2 pi (t - 1/4)): a whole number of turns is taken off first, exactly.
        rest = (half - np.rint(half)) + (half_low - np.rint(half_low))
        angle, angle_low = dd_multiply(half, half_low, math.tau, _TAU_LOW)
        angle = dd_add(angle, angle_low, 0.0, 0.0)[0]
        lengths[i] = math.sin(math.tau * rest) / angle if angle > 0.0 else 1.0


def _waves(a: Array, u: float, x: Sides, y: Sides) -> Array:
    """Average the oscillatory family: the real part of a product of waves."""
    columns, column_factors = _wave(a[0], x)
    rows, row_factors = _wave(a[1] if a.size > 1 else 0.0, y)
    phase, factor = 0.0, 1.0
    for coefficient in a[2:]:
        turns, lengths = _wave(coefficient, _WHOLE)
        phase, factor = math.remainder(phase + turns[0], 1.0), factor * lengths[0]
    out = np.empty((rows.size, columns.size))
    _wave_image(columns, rows, math.remainder(phase + u, 1.0), out)
    image: Array = out * np.multiply.outer(row_factors * factor, column_factors)
    return image


def _wave(a: float, sides: Sides) -> tuple[Array, Array]:
    """Return the phases in turns and the real factors of the means of exp(2 pi i a x) over intervals."""
    turns, lengths = np.empty((2, sides[0].size))
    _wave_means(a, *sides, turns, lengths)
    return turns, lengths


@kernel("void(float64[::1], float64[::1], float64, float64[:,::1])")
def _wave_image(columns: Array, rows: Array, phase: float, out: Array) -> None:
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            out[j, i] = cosine_of_turns(columns[i] + rows[j] + phase)


def _corner_peaks(a: Array, x: Sides, y: Sides) -> Array:
    s = np.exp(_LOGS)
    d = a.size
    weights = _STEP * np.exp((d + 1) * _LOGS - s - math.lgamma(d + 1))
    for coefficient in a[2:]:
        weights *= _falling(s * coefficient)
    columns = _corner_factors(a[0], s, x)
    rows = _corner_factors(a[1] if d > 1 else 0.0, s, y)
    out = np.empty((y[0].size, x[0].size))
    _sum_of_products(np.ascontiguousarray(rows * weights), np.ascontiguousarray(columns), out)
    return out


def _falling(z: Array) -> Array:
    """Return phi(z) = (1 - exp(-z)) / z for z >= 0."""
    return np.where(z > 0.0, -np.expm1(-z) / np.where(z > 0.0, z, 1.0), 1.0)


def _corner_factors(a: float, s: Array, sides: Sides) -> Array:
    """Return exp(-s a left) phi(s a (right - left)): float64[n, K]."""
    left, right = sides
    factors: Array = np.exp(-np.multiply.outer(a * left, s)) * _falling(np.multiply.outer(a * (right - left), s))
    return factors


@kernel("void(float64[:,::1], float64[:,::1], float64[:,::1])")
def _sum_of_products(rows: Array, columns: Array, out: Array) -> None:
    terms = np.empty(rows.shape[1])
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            for k in range(terms.size):
                terms[k] = rows[j, k] * columns[i, k]
            out[j, i] = lane_sum(terms, terms.size)
