"""The cells in which a sampler promises equally many points, projected on one axis or on two."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._specs import Promise


class Grid(NamedTuple):
    """The cells and intervals of a projection that are promised to hold equally many points.

    Attributes
    ----------
    cells
        Columns and rows of the finest grid of near-square cells; (1, 1): no grid is promised.
    intervals
        The intervals of the first and of the second axis, each axis alone; 1: no intervals are promised.
    """

    cells: tuple[int, int] = (1, 1)
    intervals: tuple[int, int] = (1, 1)


def grid_of(promises: Sequence[Promise], count: int, dims: int, axes: tuple[int, ...]) -> Grid:
    """Find the grid of one projection of a set.

    Parameters
    ----------
    promises
        What the sampler promises, from its declaration.
    count, dims
        Size of the set and its dimensions.
    axes
        One dimension, or two: along x and along y.
    """
    shapes = [(1, 1)]
    intervals = dict.fromkeys(axes, 1)
    for promise in promises:
        for cells in promise.cells(count, dims):
            sides = {axis: side for axis, side in zip(cells.axes, cells.sides, strict=True) if axis in axes}
            if len(axes) == len(sides) == 2:
                shapes.append((sides[axes[0]], sides[axes[1]]))
                continue
            for axis, side in sides.items():
                # Cells that other axes share are no intervals of this one.
                if side == math.prod(cells.sides):
                    intervals[axis] = max(intervals[axis], side)
    finest = max(shapes, key=lambda shape: (shape[0] * shape[1], min(shape), shape[0]))
    return Grid(finest, (intervals[axes[0]], intervals[axes[1]] if len(axes) == 2 else 1))


def describe_grids(promises: Sequence[Promise], count: int, dims: int) -> str:
    """Say in words which cells of sets of ``count`` points are promised; empty if there are none."""
    captions = [
        promise.caption(count, dims)
        for promise in promises
        if not any(other.implies(promise, dims) for other in promises)
    ]
    return "; ".join(dict.fromkeys(caption for caption in captions if caption))
