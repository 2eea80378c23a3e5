"""Pixels of a window as realisations and boxes, made for many at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations, seed_word
from samplekit.kernels._compile import kernel
from samplekit.kernels._hashing import mix64

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._integrate.plan import Plan

_U64 = np.uint64


@kernel(
    "void(int64[::1], int64, int64, int64, uint64, float64[::1], float64[::1],"
    " uint64[::1], int64[::1], int64[::1], float64[:,::1])"
)
def _locate(
    indices: NDArray[np.int64],
    x_first: int,
    y_first: int,
    width: int,
    seed: np.uint64,
    x_edges: NDArray[np.float64],
    y_edges: NDArray[np.float64],
    keys: NDArray[np.uint64],
    xs: NDArray[np.int64],
    ys: NDArray[np.int64],
    boxes: NDArray[np.float64],
) -> None:
    previous, row, column = -2, 0, 0
    for i in range(indices.size):
        # Mostly neighbours: a division is needed only behind a gap or at the end of a row.
        column += 1
        if indices[i] != previous + 1 or column >= width:
            row = indices[i] // width
            column = indices[i] - row * width
        previous = indices[i]
        x, y = x_first + column, y_first + row
        xs[i] = x
        ys[i] = y
        keys[i] = mix64((_U64(x) | (_U64(y) << _U64(32))) ^ seed)
        boxes[0, i] = x_edges[column]
        boxes[1, i] = x_edges[column + 1] - x_edges[column]
        boxes[2, i] = y_edges[row]
        boxes[3, i] = y_edges[row + 1] - y_edges[row]


def locate(indices: NDArray[np.int64], plan: Plan) -> tuple[Realizations, NDArray[np.float64]]:
    """The realisations and boxes float64[4, P] of some of the window's pixels, given by their flat indices int64[P]."""
    count = indices.size
    keys, xs, ys = np.empty(count, np.uint64), np.empty(count, np.int64), np.empty(count, np.int64)
    boxes = np.empty((4, count))
    x, y, width, _ = plan.window
    _locate(indices, x, y, width, seed_word(plan.seed), plan.x_edges, plan.y_edges, keys, xs, ys, boxes)
    return Realizations(keys, xs, ys, plan.seed, plan.scene.blocks), boxes
