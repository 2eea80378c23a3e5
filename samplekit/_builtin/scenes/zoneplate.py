"""The zone plate: rings whose frequency grows with the radius, so that one image shows every frequency and its aliases.

Mitchell and Netravali 1988, "Reconstruction filters in computer graphics", SIGGRAPH: the test image of reconstruction.

The exact mean over a box is separable: 1/2 + 1/2 Re(M(x0, x1) M(y0, y1)), where M(x0, x1) is the mean of exp(i k x^2),
a Fresnel integral. An image needs w + h such factors, not w * h.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene
from samplekit._builtin.scenes.sample_bounds import square_bounds
from samplekit.kernels import (
    BLOCK,
    cosine_of_turns,
    dd_add,
    dd_multiply,
    dd_scale,
    fma,
    helper,
    kernel,
    lane_sum,
    two_difference,
)
from samplekit.quadrature import NODES, WEIGHTS

Array = NDArray[np.float64]

_TAU_LOW = 2.4492935982947064e-16
_PER_TAU = 0.15915494309189535
_PER_TAU_LOW = -9.839338337591243e-18

_MOST_TURNS_OF_ONE = 1e-9  # cos(2 pi t) > 1 - 2^-55 for |t| up to here: rounded it is 1


class ZonePlate(Scene):
    """1/2 + 1/2 cos(k |x - c|^2).

    Parameters
    ----------
    k
        The phase in radians at distance 1, from 0 to 1e100: at distance r there are k r / pi rings per unit of length.
    cx, cy
        Centre, from -1e100 to 1e100: k |x - c|^2 stays finite.
    """

    value_range = (0.0, 1.0)

    def __init__(self, k: float = 1024.0, cx: float = 0.0, cy: float = 0.0) -> None:
        self.k, self.cx, self.cy = float(k), float(cx), float(cy)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the rings over each pixel's samples: see :meth:`Scene.sums`."""
        _sums(tile, boxes, self.k * _PER_TAU, self.cx, self.cy, out)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within 5e-16 for k up to 1e12."""
        x_means = _means(x_edges, self.cx, self.k)
        y_means = _means(y_edges, self.cy, self.k)
        real = np.multiply.outer(y_means.real, x_means.real) - np.multiply.outer(y_means.imag, x_means.imag)
        return 0.5 + 0.5 * real

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 where the phase is so small that its cosine rounds to 1, NaN elsewhere: float64[h, w]."""
        x, y = x_edges - self.cx, y_edges - self.cy
        farthest = square_bounds(y[:-1], y[1:])[1][:, None] + square_bounds(x[:-1], x[1:])[1]
        turns = self.k * _PER_TAU * farthest
        return np.where(turns < _MOST_TURNS_OF_ONE, 1.0, np.nan)


@kernel("void(float64[:,:,::1], float64[:,::1], float64, float64, float64, float64[::1])")
def _sums(tile: Array, boxes: Array, turns: float, cx: float, cy: float, out: Array) -> None:
    pixels, _, count = tile.shape
    values = np.empty(BLOCK)
    for pixel in range(pixels):
        left, width = boxes[0, pixel] - cx, boxes[1, pixel]
        top, height = boxes[2, pixel] - cy, boxes[3, pixel]
        for i in range(count):
            x = fma(tile[pixel, 0, i], width, left)
            y = fma(tile[pixel, 1, i], height, top)
            values[i] = cosine_of_turns(turns * fma(x, x, y * y))
        out[pixel] = 0.5 * count + 0.5 * lane_sum(values, count)


def _means(edges: Array, centre: float, k: float) -> NDArray[np.complex128]:
    """Average exp(i k (x - centre)^2) between neighbouring edges, within 4e-16: complex128[m] for float64[m + 1].

    Where the integrand oscillates little, by Gauss and Legendre's rule; elsewhere by the difference of two tails, which
    are so small against the width that their difference loses no digits.
    """
    edges = np.ascontiguousarray(edges)
    means = np.empty(edges.size - 1, np.complex128)
    _smooth_means(edges, centre, k, means)
    rough = np.flatnonzero(np.isnan(means))
    if rough.size:
        offsets = np.empty(edges.size)
        phases = np.empty(edges.size, np.complex128)
        _edge_phases(edges, centre, k, offsets, phases)
        tails = _tails(k, np.abs(offsets), phases)
        left, right = tails[rough], tails[rough + 1]
        before, after = offsets[rough + 1] <= 0, offsets[rough] >= 0
        whole = math.sqrt(math.pi / (2 * k)) * (1 + 1j)
        integrals = np.where(after, left - right, np.where(before, right - left, whole - left - right))
        means[rough] = integrals / (edges[rough + 1] - edges[rough])
    return means


@helper
def _phase(k: float, offset: float, low: float) -> complex:
    """Return exp(i k (offset + low)^2), whose phase is reduced as a double-double.

    At k = 1e12 the rounding of an offset to one float64 would change the phase by 1e-4.
    """
    square, square_low = dd_multiply(offset, low, offset, low)
    turns, turns_low = dd_multiply(square, square_low, _PER_TAU, _PER_TAU_LOW)
    turns, turns_low = dd_scale(turns, turns_low, k)
    turns -= np.rint(turns)
    turns_low -= np.rint(turns_low)
    angle, angle_low = dd_multiply(turns, turns_low, math.tau, _TAU_LOW)
    cosine, sine = math.cos(angle), math.sin(angle)
    return complex(cosine - angle_low * sine, sine + angle_low * cosine)


@kernel("void(float64[::1], float64, float64, float64[::1], complex128[::1])")
def _edge_phases(edges: Array, centre: float, k: float, offsets: Array, phases: NDArray[np.complex128]) -> None:
    for i in range(edges.size):
        offset, low = two_difference(edges[i], centre)
        offsets[i] = offset
        phases[i] = _phase(k, offset, low)


@kernel("void(float64[::1], float64, float64, complex128[::1])")
def _smooth_means(edges: Array, centre: float, k: float, means: NDArray[np.complex128]) -> None:
    """Average by 24 nodes where exp(i k x^2) oscillates little; write NaN elsewhere.

    At the distance d from the middle c of an interval x^2 = c^2 + 2 c d + d^2. The second term changes its sign with d,
    so the nodes c + d and c - d are summed as pairs.
    """
    for i in range(means.size):
        left, left_low = two_difference(edges[i], centre)
        right, right_low = two_difference(edges[i + 1], centre)
        middle, low = dd_add(0.5 * left, 0.5 * left_low, 0.5 * right, 0.5 * right_low)
        width = edges[i + 1] - edges[i]
        if 2.0 * k * abs(middle) * width > 10.0 or k * width * width > 10.0:
            means[i] = np.nan
            continue
        real = imaginary = 0.0
        for node in range(NODES.size):
            d = 0.5 * width * NODES[node]
            pair = WEIGHTS[node] * math.cos(2.0 * k * middle * d)
            real += pair * math.cos(k * d * d)
            imaginary += pair * math.sin(k * d * d)
        means[i] = _phase(k, middle, low) * complex(real, imaginary)


def _tails(k: float, offsets: Array, phases: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Integrate exp(i k x^2) from each offset >= 0 to infinity.

    That is exp(i k x^2) times a slowly varying factor, Faddeeva's function of (1 + i) sqrt(k / 2) x (NIST DLMF 7.5.8,
    7.5.9).
    """
    slow = _faddeeva(math.sqrt(k / 2) * offsets)
    tails: NDArray[np.complex128] = (math.sqrt(math.pi / (2 * k)) * (0.5 + 0.5j)) * (phases * slow)
    return tails


def _faddeeva(x: Array) -> NDArray[np.complex128]:
    """Return w(z) = exp(-z^2) erfc(-i z) on the diagonal z = (1 + i) x, x >= 0.

    Where x^2 > 6, by Laplace's continued fraction (NIST DLMF 7.9.3), within 3e-16 relative: SciPy's function is up to
    1.3e-14 off for x^2 from 6 to 50. Nearer to 0, SciPy's, which is within 3e-15 there.
    """
    z = x * (1 + 1j)
    far = x * x > 6
    outer = z[far]
    fraction = np.zeros_like(outer)
    for m in range(40, 0, -1):
        fraction = (0.5 * m) / (outer - fraction)
    w = np.empty(z.shape, np.complex128)
    w[far] = 1j / math.sqrt(math.pi) / (outer - fraction)
    if not far.all():
        from scipy.special import wofz

        w[~far] = wofz(z[~far])
    return w
