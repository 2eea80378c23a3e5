"""Means over pixels by adaptive quadrature: for references that have no closed form.

A pixel is a cell; a cell in which two Gauss rules disagree becomes four. A function whose steps and kinks lie on known
circles and lines is integrated piece by piece between them: :mod:`samplekit.integration.pieces`.
"""

from __future__ import annotations

import math
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from samplekit.integration.pieces import mark_crossed, piece_nodes

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Function = Callable[[Array], Array]
    """From points float64[2, M] of the picture to values float64[M]."""

MOST_EVALUATIONS = 2**26
_CELLS_AT_ONCE = 2**14
_BUFFER = 2**20
_DEEPEST = 26


@dataclass(frozen=True)
class Curves:
    """Where a function is not smooth.

    Attributes
    ----------
    circles
        float64[K, 3]: centre and radius.
    lines
        float64[L, 3]: a, b, c of a x + b y = c.
    """

    circles: Array = field(default_factory=lambda: np.empty((0, 3)))
    lines: Array = field(default_factory=lambda: np.empty((0, 3)))


def pixel_means(
    function: Function,
    x_edges: Array,
    y_edges: Array,
    *,
    known: Array | None = None,
    curves: Curves | None = None,
    largest: float = math.inf,
    orders: tuple[int, int] = (3, 5),
    tolerance: float = 1e-6,
    evaluations: int = MOST_EVALUATIONS,
) -> tuple[Array, Array]:
    """Integrate a function over each pixel.

    Parameters
    ----------
    function
        Bounded; steps that ``curves`` do not name are found only where nodes of the first cells see both sides.
    x_edges, y_edges
        float64[w + 1], float64[h + 1].
    known
        float64[h, w]: the means that are known already, NaN elsewhere.
    curves
        Where the function has steps and kinks.
    largest
        Pixels are divided until the sides of a cell are at most this long: the size of what must not be missed.
    orders
        Nodes along an axis of the two rules that are compared, for cells without curves.
    tolerance
        A cell of 1/4^k of its pixel is divided while its rules differ by more than this times 2^k.
    evaluations
        Where this many are used up, what is reached is kept.

    Returns
    -------
    The means, and for each an estimate from above of its error: the sum of the differences. Both float64[h, w].
    """
    width, height = x_edges.size - 1, y_edges.size - 1
    means = np.full(width * height, np.nan) if known is None else known.ravel().copy()
    errors = np.zeros(width * height)
    wanted = np.flatnonzero(np.isnan(means))
    means[wanted] = 0.0
    parts = np.maximum(1.0, np.ceil([np.diff(x_edges).max() / largest, np.diff(y_edges).max() / largest]))
    at_once = max(1, int(_CELLS_AT_ONCE // parts.prod()))

    def integrate(pixels: NDArray[np.int64]) -> None:
        column, row = pixels % width, pixels // width
        boxes = np.array([x_edges[column], x_edges[column + 1], y_edges[row], y_edges[row + 1]])
        share = int(evaluations * pixels.size / wanted.size)
        cells, owners = _divided(boxes, np.arange(pixels.size), int(parts[0]), int(parts[1]))
        found = _integrate(
            function, cells, owners, pixels.size, 1.0 / parts.prod(), curves or Curves(), orders, tolerance, share
        )
        means[pixels], errors[pixels] = found

    batches = [wanted[first : first + at_once] for first in range(0, wanted.size, at_once)]
    with ThreadPoolExecutor(os.cpu_count() if len(batches) > 1 else 1) as pool:
        list(pool.map(integrate, batches))
    return means.reshape(height, width), errors.reshape(height, width)


def _divided(cells: Array, owners: NDArray[np.int64], across: int, down: int) -> tuple[Array, NDArray[np.int64]]:
    """Divide each of the cells float64[4, C] into ``across`` x ``down``."""
    x = cells[0] + (cells[1] - cells[0]) * np.linspace(0.0, 1.0, across + 1)[:, None]
    y = cells[2] + (cells[3] - cells[2]) * np.linspace(0.0, 1.0, down + 1)[:, None]
    x[-1], y[-1] = cells[1], cells[3]
    shape = (down, across, cells.shape[1])
    parts = [np.broadcast_to(edge, shape).ravel() for edge in (x[None, :-1], x[None, 1:], y[:-1, None], y[1:, None])]
    return np.array(parts), np.broadcast_to(owners, shape).ravel()


def _integrate(
    function: Function,
    cells: Array,
    owners: NDArray[np.int64],
    pixels: int,
    fraction: float,
    curves: Curves,
    orders: tuple[int, int],
    tolerance: float,
    evaluations: int,
) -> tuple[Array, Array]:
    """Integrate over cells, each ``fraction`` of a pixel; return sums and errors of the pixels, float64[P] each."""
    means, errors = np.zeros(pixels), np.zeros(pixels)
    for _ in range(_DEEPEST):
        crossed = np.zeros(cells.shape[1], np.bool_)
        mark_crossed(cells, curves.circles, curves.lines, crossed)
        rough, rough_used = _rule(function, cells, crossed, curves, orders[0])
        fine, fine_used = _rule(function, cells, crossed, curves, orders[1])
        evaluations -= rough_used + fine_used
        difference = np.abs(fine - rough)
        done = difference <= tolerance / math.sqrt(fraction)
        if evaluations < 4 * (rough_used + fine_used) * np.count_nonzero(~done) / done.size:
            done[:] = True
        means += np.bincount(owners[done], fine[done], pixels) * fraction
        errors += np.bincount(owners[done], difference[done], pixels) * fraction
        if done.all():
            break
        cells, owners = _divided(cells[:, ~done], owners[~done], 2, 2)
        fraction /= 4.0
    else:
        means += np.bincount(owners, np.repeat(fine[~done], 4), pixels) * fraction
        errors += np.bincount(owners, np.repeat(difference[~done], 4), pixels) * fraction
    return means, errors


def _gauss(order: int) -> tuple[Array, Array]:
    """Gauss and Legendre's nodes and weights on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    return 0.5 + 0.5 * nodes, 0.5 * weights


def _rule(
    function: Function, cells: Array, crossed: NDArray[np.bool_], curves: Curves, order: int
) -> tuple[Array, int]:
    """Return the mean over each of the cells float64[4, C], and the number of evaluations."""
    means = np.empty(cells.shape[1])
    smooth = cells[:, ~crossed]
    nodes, weights = _gauss(order)
    x = smooth[0] + (smooth[1] - smooth[0]) * nodes[:, None]
    y = smooth[2] + (smooth[3] - smooth[2]) * nodes[:, None]
    shape = (order, order, smooth.shape[1])
    points = np.array([np.broadcast_to(x[None], shape).ravel(), np.broadcast_to(y[:, None], shape).ravel()])
    used = points.shape[1]
    if used:
        means[~crossed] = np.einsum("i,j,ijc->c", weights, weights, function(points).reshape(shape))
    rest = np.flatnonzero(crossed)
    # Along a piece the substitution takes away two orders.
    nodes, weights = _gauss(order + 3)
    buffer, shares = np.empty((2, _BUFFER)), np.empty(_BUFFER)
    while rest.size:
        ends = np.zeros(rest.size, np.int64)
        filled = piece_nodes(cells[:, rest].copy(), curves.circles, curves.lines, nodes, weights, buffer, shares, ends)
        count = int(ends[filled - 1])
        sums = np.cumsum(np.concatenate([[0.0], shares[:count] * function(buffer[:, :count].copy())]))
        starts = np.concatenate([[0], ends[: filled - 1]])
        means[rest[:filled]] = sums[ends[:filled]] - sums[starts]
        used += count
        rest = rest[filled:]
    return means, used
