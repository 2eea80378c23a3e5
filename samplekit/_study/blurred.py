"""The mean square of an error after the Gaussian blur of ``blurred_mse``, compiled because every trial needs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._metrics import BLUR_RADIUS, BLUR_WEIGHTS, Array, blur
from samplekit.kernels import helper, kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray


@helper
def _weighted_sum(values: Array, at: int, step: int, weights: Array) -> float:
    """Sum a value and its eight neighbours on either side, ``step`` apart. Written out, the loop is vectorised."""
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
    """Return the pixel at a place beyond the edges of an image that is mirrored at them, as often as necessary."""
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
            across[first + x] = _weighted_sum(padded, BLUR_RADIUS + x, 1, weights)
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
            row[x] = _weighted_sum(across, first + x, width, weights)
        total = 0.0
        for x in range(width):
            total += row[x] * row[x]
        squares[y] = total


def blurred_mean_square(error: Array, valid: NDArray[np.bool_]) -> float:
    """Return the mean square of the blurred error over the valid pixels.

    Parameters
    ----------
    error
        float64[h, w].
    valid
        bool[h, w], true for at least one pixel. The others are left out of the blur as in
        :func:`samplekit._metrics.metrics`.
    """
    if not valid.all():
        return float(np.mean(np.square(blur(np.where(valid, error, 0.0), valid)[valid])))
    squares = np.empty(error.shape[0])
    _blurred_squares(np.ascontiguousarray(error), BLUR_WEIGHTS, squares)
    return float(squares.sum() / error.size)
