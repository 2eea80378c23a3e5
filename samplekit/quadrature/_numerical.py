"""References of scenes without a closed form: adaptive quadrature over the pixel, Gauss rules over all else.

The result is deterministic and independent of any sampler. ``Reference.error`` is the difference of two rules, summed
over the cells of a pixel, in the worst pixel: an estimate from above, not a proof. A detail that falls between all
nodes (33 in a pixel, which is never taken wider than 1/64) stays unseen.
"""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from samplekit._bases.reference import Reference
from samplekit._errors import UsageError
from samplekit.quadrature._pixel_means import pixel_means

if TYPE_CHECKING:
    from samplekit._bases.scene import Scene

Array = NDArray[np.float64]

TOLERANCE = 1e-6
"""Error that the adaptive rule aims at in each pixel. Pixels with an edge use up all evaluations before."""
EVALUATIONS = 2**25
"""Most evaluations of a reference in two dimensions: they take some seconds."""
MORE_EVALUATIONS = 2**26
"""Most evaluations in more than two dimensions."""
_ORDERS = (16, 12, 8, 6, 5, 4, 3)
_LEAST_PER_PIXEL = 13
_LARGEST_CELL = 1.0 / 64.0
_POINTS_AT_ONCE = 2**17


def numerical_means(scene: Scene, x_edges: Array, y_edges: Array, known: Array | None = None) -> Reference:
    """Integrate a scene over each pixel and all its other dimensions.

    ``known`` float64[h, w]: the means that are known already, NaN elsewhere; None: no mean is known.

    Raises
    ------
    UsageError
        With so many pixels and dimensions it would take too long.
    """
    known = np.full((y_edges.size - 1, x_edges.size - 1), np.nan) if known is None else known
    pixels = int(np.count_nonzero(np.isnan(known)))
    rough, fine = _rules(scene, pixels * _LEAST_PER_PIXEL)
    plane = fine[1].size == 1
    means, errors = pixel_means(
        lambda points: _means(scene, points, *fine),
        x_edges,
        y_edges,
        known=known,
        largest=_LARGEST_CELL if plane else math.inf,
        orders=(3, 5) if plane else (2, 3),
        borders=plane,
        tolerance=TOLERANCE,
        evaluations=EVALUATIONS if plane else MORE_EVALUATIONS // fine[1].size,
    )
    if not plane:
        # Over the other dimensions the two rules are compared at the centre of each pixel.
        x, y = x_edges[:-1] + 0.5 * np.diff(x_edges), y_edges[:-1] + 0.5 * np.diff(y_edges)
        row, column = np.nonzero(np.isnan(known))
        points = np.array([x[column], y[row]])
        errors[row, column] += np.abs(_means(scene, points, *fine) - _means(scene, points, *rough))
    return Reference(means, float(errors.max()), numerical=True)


def numerical_means_at(scene: Scene, x: Array, y: Array) -> Reference:
    """Integrate a scene over all its dimensions but the pixel's, at the points x by y.

    Raises
    ------
    UsageError
        With so many pixels and dimensions it would take too long.
    """
    points = np.array([np.tile(x, y.size), np.repeat(y, x.size)])
    rough, fine = (_means(scene, points, *rule) for rule in _rules(scene, points.shape[1]))
    return Reference(fine.reshape(y.size, x.size), float(np.abs(fine - rough).max()), numerical=True)


def _rules(scene: Scene, points: int) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Two tensor Gauss rules over [0, 1)^d for the d dimensions beside the pixel's: nodes float64[d, Q], weights [Q].

    As fine as may be for so many points of the picture.
    """
    dims = sum(scene.dimensions().values()) - 2
    for order in _ORDERS:
        if points * order**dims <= MORE_EVALUATIONS:
            return _tensor(order - 1, dims), _tensor(order, dims)
    raise UsageError(
        f"{type(scene).__name__} gives no reference of its own, and one in {dims + 2} dimensions takes too long over"
        " so many pixels: leave the error out (--no-error), or render less (--size, --crop)"
    )


def _tensor(order: int, dims: int) -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    grid = np.array(list(itertools.product(0.5 + 0.5 * nodes, repeat=dims))).reshape(order**dims, dims)
    shares = np.array([np.prod(share) for share in itertools.product(0.5 * weights, repeat=dims)])
    return np.ascontiguousarray(grid.T), shares


def _means(scene: Scene, points: Array, nodes: Array, weights: Array) -> Array:
    """Return the mean over the nodes at each of the points float64[2, M]."""
    means = np.empty(points.shape[1])
    at_once = max(1, _POINTS_AT_ONCE // weights.size)
    for first in range(0, means.size, at_once):
        part = points[:, first : first + at_once]
        count = part.shape[1] * weights.size
        # Each value as a pixel of its own, which is a point: scenes that give sums alone give values so as well.
        tile, boxes, values = np.zeros((count, 2 + nodes.shape[0], 1)), np.zeros((4, count)), np.empty(count)
        boxes[0::2] = np.repeat(part, weights.size, axis=1)
        tile[:, 2:, 0] = np.tile(nodes.T, (part.shape[1], 1))
        scene.sums(tile, boxes, values)
        means[first : first + at_once] = values.reshape(-1, weights.size) @ weights
    return means
