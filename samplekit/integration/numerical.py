"""References of scenes that give values alone: adaptive quadrature over the pixel, Gauss rules over all else.

Deterministic, and independent of any sampler. What is reached is told: ``Reference.error`` is what two rules differ by,
summed over a pixel's cells, in the worst pixel: an estimate from above, no proof. A detail that falls between all
nodes (33 in a pixel, which is never taken wider than 1/64) stays unseen.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit.errors import UsageError
from samplekit.integration.pixel_means import pixel_means

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.integration.scene import Scene

    Array = NDArray[np.float64]

TOLERANCE = 1e-6
"""What the adaptive rule aims at in each pixel. Pixels with an edge use up all evaluations before."""
EVALUATIONS = 2**25
"""Values that one reference may take: some seconds."""
_NODES = {0: (1, 1), 1: (12, 16), 2: (8, 12), 3: (5, 7), 4: (3, 4)}
_LARGEST_CELL = 1.0 / 64.0
_POINTS_AT_ONCE = 2**17


@dataclass(frozen=True)
class Reference:
    """A reference image.

    Attributes
    ----------
    image
        float64[h, w].
    error
        Bound of its error beyond rounding, in any pixel; 0: exact.
    numerical
        The bound is an estimate of adaptive quadrature: the scene gives no reference of its own.
    """

    image: Array
    error: float = 0.0
    numerical: bool = False

    @property
    def kind(self) -> str:
        """How exact it is, in words."""
        if self.numerical:
            return f"adaptive quadrature, estimated within {self.error:.1g}"
        return f"within {self.error:g}" if self.error else "exact"


def numerical_means(scene: Scene, x_edges: Array, y_edges: Array) -> Reference:
    """Integrate a scene over each pixel and all its other dimensions.

    Raises
    ------
    UsageError
        More than four dimensions beside the pixel's.
    """
    known = scene.constant(x_edges, y_edges)
    rough, fine = _rules(scene)
    size = max(1, fine[0].shape[1])
    means, errors = pixel_means(
        lambda points: _means(scene, points, *fine),
        x_edges,
        y_edges,
        known=known,
        largest=_LARGEST_CELL,
        borders=True,
        tolerance=TOLERANCE,
        evaluations=EVALUATIONS // size,
    )
    if fine[0].shape[0]:
        # Over the other dimensions the two rules are compared at the pixel's corners and its centre.
        column, row = np.meshgrid(np.arange(x_edges.size - 1), np.arange(y_edges.size - 1))
        for across, down in itertools.product((0.0, 1.0 - 2.0**-53), (0.0, 1.0 - 2.0**-53)):
            x = x_edges[:-1] + np.diff(x_edges) * across
            y = y_edges[:-1] + np.diff(y_edges) * down
            points = np.array([x[column.ravel()], y[row.ravel()]])
            difference = np.abs(_means(scene, points, *fine) - _means(scene, points, *rough)).reshape(errors.shape)
            errors += np.where(np.isnan(known), 0.25 * difference, 0.0)
    return Reference(means, float(errors.max()), numerical=True)


def numerical_means_at(scene: Scene, x: Array, y: Array) -> Reference:
    """Integrate a scene over all its dimensions but the pixel's, at the points x by y.

    Raises
    ------
    UsageError
        More than four dimensions beside the pixel's.
    """
    points = np.array([np.tile(x, y.size), np.repeat(y, x.size)])
    rough, fine = (_means(scene, points, *rule) for rule in _rules(scene))
    return Reference(fine.reshape(y.size, x.size), float(np.abs(fine - rough).max()), numerical=True)


def _rules(scene: Scene) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Tensor Gauss rules over [0, 1)^d for the d dimensions beside the pixel's: nodes float64[d, Q], weights [Q]."""
    dims = sum(scene.dimensions().values()) - 2
    if dims not in _NODES:
        raise UsageError(f"{type(scene).__name__} gives no reference, and {dims + 2} dimensions are too many for one")
    rough, fine = (_tensor(order, dims) for order in _NODES[dims])
    return rough, fine


def _tensor(order: int, dims: int) -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    grid = np.array(list(itertools.product(0.5 + 0.5 * nodes, repeat=dims))).reshape(-1, dims)
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
