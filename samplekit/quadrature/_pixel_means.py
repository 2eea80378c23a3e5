"""Means over pixels by adaptive quadrature: for references that have no closed form.

A pixel is a cell; a cell in which two Gauss rules disagree becomes four. A function whose steps and kinks lie on known
circles and lines is integrated piece by piece between them: :mod:`samplekit.quadrature._pieces`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from samplekit._threads import default_threads
from samplekit.quadrature._pieces import mark_crossed, piece_nodes, sum_cells

Array = NDArray[np.float64]
Function = Callable[[Array], Array]
"""From points float64[2, M] of the picture to values float64[M]."""

_CELLS_AT_ONCE = 2**14
_BUFFER = 2**20
_DEEPEST = 26
_BORDER = 0.03
"""Largest share of a cell that an edge cuts off between a corner and the nodes of a rule of order 5."""


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
    borders: bool = False,
    tolerance: float = 1e-6,
    evaluations: float = math.inf,
) -> tuple[Array, Array]:
    """Integrate a function over each pixel.

    Parameters
    ----------
    function
        Bounded; steps that ``curves`` do not name are found only where nodes of the first cells see both sides.
        Called from several threads.
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
    borders
        Also compare each cell's corners and the middles of its sides with what the finer rule's polynomial has there:
        for functions with steps that nobody names, which may cut off a corner before the first node.
    tolerance
        A cell of 1/4^k of its pixel is divided while its rules differ by more than this times 2^k.
    evaluations
        Where this many are used up, what is reached is kept. They are shared out among neighbouring pixels, so that a
        part of an image may then differ from the whole one; without a limit it does not.

    Returns
    -------
    The means, and for each an estimate from above of its error: the sum of the differences. Both float64[h, w].
    """
    width, height = x_edges.size - 1, y_edges.size - 1
    means = np.full(width * height, np.nan) if known is None else known.ravel().copy()
    errors = np.zeros(width * height)
    wanted = np.flatnonzero(np.isnan(means))
    means[wanted] = 0.0
    parts = np.maximum(1.0, np.ceil(np.array([pixel_side(x_edges), pixel_side(y_edges)]) / largest))
    at_once = max(1, int(_CELLS_AT_ONCE // parts.prod()))

    steps = curves or Curves()

    def compare_rules(cells: Array) -> tuple[Array, Array, int]:
        crossed = np.zeros(cells.shape[1], np.bool_)
        mark_crossed(cells, steps.circles, steps.lines, crossed)
        rough, _, rough_used = _rule(function, cells, crossed, steps, orders[0], False)
        fine, misfit, fine_used = _rule(function, cells, crossed, steps, orders[1], borders)
        return fine, np.abs(fine - rough) + misfit, rough_used + fine_used

    def integrate(pixels: NDArray[np.int64]) -> None:
        column, row = pixels % width, pixels // width
        boxes = np.array([x_edges[column], x_edges[column + 1], y_edges[row], y_edges[row + 1]])
        share = evaluations * pixels.size / wanted.size
        cells, owners = _divided(boxes, np.arange(pixels.size), int(parts[0]), int(parts[1]))
        found = _integrate(compare_rules, cells, owners, pixels.size, 1.0 / parts.prod(), tolerance, share)
        means[pixels], errors[pixels] = found

    batches = [wanted[first : first + at_once] for first in range(0, wanted.size, at_once)]
    with ThreadPoolExecutor(max(1, min(default_threads(), len(batches)))) as pool:
        list(pool.map(integrate, batches))
    return means.reshape(height, width), errors.reshape(height, width)


def pixel_side(edges: Array) -> float:
    """The largest distance of neighbouring edges, in single precision: the same for every part of an image."""
    return float(np.float32(np.diff(edges).max()))


def _divided(cells: Array, owners: NDArray[np.int64], across: int, down: int) -> tuple[Array, NDArray[np.int64]]:
    """Divide each of the cells float64[4, C] into ``across`` x ``down``."""
    x = cells[0] + (cells[1] - cells[0]) * np.linspace(0.0, 1.0, across + 1)[:, None]
    y = cells[2] + (cells[3] - cells[2]) * np.linspace(0.0, 1.0, down + 1)[:, None]
    x[-1], y[-1] = cells[1], cells[3]
    shape = (down, across, cells.shape[1])
    parts = [np.broadcast_to(edge, shape).ravel() for edge in (x[None, :-1], x[None, 1:], y[:-1, None], y[1:, None])]
    return np.array(parts), np.broadcast_to(owners, shape).ravel()


def _integrate(
    compare_rules: Callable[[Array], tuple[Array, Array, int]],
    cells: Array,
    owners: NDArray[np.int64],
    pixels: int,
    fraction: float,
    tolerance: float,
    evaluations: float,
) -> tuple[Array, Array]:
    """Integrate over cells, each ``fraction`` of a pixel; return sums and errors of the pixels, float64[P] each.

    ``compare_rules`` takes cells float64[4, C]. It returns the mean over each, the difference of two rules there, and
    the number of evaluations.
    """
    means, errors = np.zeros(pixels), np.zeros(pixels)
    for _ in range(_DEEPEST):
        fine, difference, used = compare_rules(cells)
        evaluations -= used
        done = difference <= tolerance / math.sqrt(fraction)
        if evaluations < 4 * used * np.count_nonzero(~done) / done.size:
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
    function: Function, cells: Array, crossed: NDArray[np.bool_], curves: Curves, order: int, borders: bool
) -> tuple[Array, Array, int]:
    """Return the mean over each of the cells float64[4, C], the misfit at its border, and the number of evaluations."""
    means, misfit = np.empty(cells.shape[1]), np.zeros(cells.shape[1])
    smooth = cells[:, ~crossed]
    nodes, weights = _gauss(order)
    values = _on_grid(function, smooth, nodes)
    used = values.size
    # Term by term: what a cell gets must not depend on its neighbours, and so on which part of an image is asked for.
    total = np.zeros(smooth.shape[1])
    for j, row in enumerate(values):
        for i, column in enumerate(row):
            total += (weights[j] * weights[i]) * column
    means[~crossed] = total
    if borders:
        places = np.array([2.0**-20, 0.5, 1.0 - 2.0**-20])
        true = _on_grid(function, smooth, places)
        basis = np.array([np.prod([(places - b) / (a - b) for b in nodes if b != a], axis=0) for a in nodes])
        polynomial = np.einsum("ip,jq,ijc->pqc", basis, basis, values)
        misfit[~crossed] = _BORDER * np.abs(true - polynomial).max(axis=(0, 1))
        used += true.size
    rest = np.flatnonzero(crossed)
    # Along a piece the substitution takes away two orders.
    nodes, weights = _gauss(order + 3)
    buffer, shares = np.empty((2, _BUFFER)), np.empty(_BUFFER)
    while rest.size:
        ends = np.zeros(rest.size, np.int64)
        filled = piece_nodes(cells[:, rest].copy(), curves.circles, curves.lines, nodes, weights, buffer, shares, ends)
        count = int(ends[filled - 1])
        sums = np.empty(filled)
        sum_cells(np.ascontiguousarray(function(buffer[:, :count].copy()), np.float64), shares, ends, sums)
        means[rest[:filled]] = sums
        used += count
        rest = rest[filled:]
    return means, misfit, used


def _on_grid(function: Function, cells: Array, places: Array) -> Array:
    """Return values float64[n, n, C] at n x n places, given on [0, 1], of each cell; rows first."""
    x = cells[0] + (cells[1] - cells[0]) * places[:, None]
    y = cells[2] + (cells[3] - cells[2]) * places[:, None]
    shape = (places.size, places.size, cells.shape[1])
    points = np.array([np.broadcast_to(x[None], shape).ravel(), np.broadcast_to(y[:, None], shape).ravel()])
    return function(points).reshape(shape) if points.size else np.empty(shape)
