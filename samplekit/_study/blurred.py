"""The mean square of an error after the Gaussian blur of ``blurred_mse``, as fast as one drawing of the image."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._metrics import BLUR_RADIUS, BLUR_SIGMA, blur
from samplekit.kernels._compile import helper, kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_WEIGHTS = np.exp(-0.5 * np.square(np.arange(BLUR_RADIUS + 1) / BLUR_SIGMA))
_WEIGHTS /= _WEIGHTS[0] + 2.0 * _WEIGHTS[1:].sum()


@helper
def _tapped(values: Array, at: int, step: int, weights: Array) -> float:
    """The weighted sum of a value and of the eight on either side, ``step`` apart: written out, it is vectorised."""
    total: float = (
        weights[0] * values[at]
        + weights[1] * (values[at - step] + values[at + step])
        + weights[2] * (values[at - 2 * step] + values[at + 2 * step])
        + weights[3] * (values[at - 3 * step] + values[at + 3 * step])
        + weights[4] * (values[at - 4 * step] + values[at + 4 * step])
        + weights[5] * (values[at - 5 * step] + values[at + 5 * step])
        + weights[6] * (values[at - 6 * step] + values[at + 6 * step])
        + weights[7] * (values[at - 7 * step] + values[at + 7 * step])
        + weights[8] * (values[at - 8 * step] + values[at + 8 * step])
    )
    return total


@helper
def _reflected(place: int, length: int) -> int:
    """The pixel that stands at a place beyond the edges: the image mirrored, as often as it takes."""
    place %= 2 * length
    return place if place < length else 2 * length - 1 - place


@kernel("void(float64[:,::1], float64[::1], float64[::1])")
def _blurred_squares(error: Array, weights: Array, squares: Array) -> None:
    """Write the sum of squares of each row of the blurred error."""
    height, width = error.shape
    padded = np.empty(width + 2 * BLUR_RADIUS)
    across = np.empty((height + 2 * BLUR_RADIUS) * width)
    for y in range(height):
        for x in range(BLUR_RADIUS):
            padded[x] = error[y, _reflected(x - BLUR_RADIUS, width)]
            padded[width + BLUR_RADIUS + x] = error[y, _reflected(width + x, width)]
        for x in range(width):
            padded[BLUR_RADIUS + x] = error[y, x]
        first = (y + BLUR_RADIUS) * width
        for x in range(width):
            across[first + x] = _tapped(padded, BLUR_RADIUS + x, 1, weights)
    for y in range(BLUR_RADIUS):
        above = (_reflected(y - BLUR_RADIUS, height) + BLUR_RADIUS) * width
        below = (_reflected(height + y, height) + BLUR_RADIUS) * width
        for x in range(width):
            across[y * width + x] = across[above + x]
            across[(height + BLUR_RADIUS + y) * width + x] = across[below + x]
    row = np.empty(width)
    for y in range(height):
        first = (y + BLUR_RADIUS) * width
        for x in range(width):
            row[x] = _tapped(across, first + x, width, weights)
        total = 0.0
        for x in range(width):
            total += row[x] * row[x]
        squares[y] = total


def blurred_mean_square(error: Array, valid: NDArray[np.bool_]) -> float:
    """The mean over the valid pixels, at least one, of the square of the blurred error float64[h, w].

    Pixels that are not valid are 0 in ``error``, and left out of the blur as :func:`samplekit._metrics.metrics` does.
    """
    if not valid.all():
        return float(np.mean(np.square(blur(error, valid)[valid])))
    squares = np.empty(error.shape[0])
    _blurred_squares(np.ascontiguousarray(error), _WEIGHTS, squares)
    return float(squares.sum() / error.size)
