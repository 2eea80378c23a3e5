"""Which cells points lie in, exactly, and how far apart points are: what promises are checked with.

A boundary c/n is rarely a float64, and a sampler's exact value k/b^j is not either: what it can give is the float64
nearest to k/b^j. So the boundary here is the float64 nearest to c/n, which is what dividing two integers below 2^53
gives. Rounding is monotone: an exact value at or above c/n never rounds to less than the rounded boundary, so a sampler
that computes its digits in integers and divides once is always judged right, and one that adds up digits in floating
point and ends below the boundary is not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit._specs.promise import name_dimensions

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from samplekit._specs.promise import Cells


@dataclass(frozen=True)
class Violation:
    """The place where a set breaks a promise, as :meth:`Promise.find_violation` returns it. ``str`` gives one line.

    Attributes
    ----------
    message
        The violation in one line.
    realization
        Index of the set.
    points
        Indices of the points that show it.
    axes, box
        The dimensions, and the interval along each of them, of the cell that holds too many points or too few; empty
        if no cell is at fault.

    Examples
    --------
    >>> import samplekit
    >>> found = samplekit.LatinStrata().find_violation([[0.1, 0.7], [0.4, 0.2]])
    >>> found.points, found.axes, found.box
    ((0, 1), (0,), ((0.0, 0.5),))
    """

    message: str
    realization: int
    points: tuple[int, ...]
    axes: tuple[int, ...] = ()
    box: tuple[tuple[float, float], ...] = ()

    def __str__(self) -> str:
        return self.message


def cell_of(x: NDArray[np.float64], cells: int) -> NDArray[np.int64]:
    """Return the cell, from 0 to cells - 1, of each coordinate; coordinates outside [0, 1) get the nearest cell.

    Exact for ``cells`` below 2^31: the product is within one of the cell, and comparing with both boundaries mends it.
    """
    cell = np.clip(x * cells, 0, cells - 1).astype(np.int64)
    cell -= x < cell / cells
    cell += x >= (cell + 1) / cells
    return np.clip(cell, 0, cells - 1)


def find_uneven_cell(points: NDArray[np.float64], grids: Iterable[Cells], keyword: str) -> Violation | None:
    """Find the first set in which the cells of a grid do not all hold equally many points.

    Parameters
    ----------
    points
        float64[R, N, D]: R sets, each judged alone.
    grids
        Cells whose number divides N.
    keyword
        The kind of promise, for the message.

    Returns
    -------
    The fullest cell of the set, so that there are points to show; None if all is even.
    """
    grids = list(grids)
    sets, count, _ = points.shape
    finest: dict[int, int] = {}
    for cells in grids:
        for axis, side in zip(cells.axes, cells.sides, strict=True):
            finest[axis] = max(side, finest.get(axis, 1))
    finest_cells = {axis: cell_of(points[:, :, axis], side) for axis, side in finest.items()}

    @cache
    def along(axis: int, side: int) -> NDArray[np.int64]:
        if finest[axis] % side == 0:
            # The same cells as `cell_of` gives, for equal fractions are equal float64s; and faster.
            return finest_cells[axis] // (finest[axis] // side)
        return cell_of(points[:, :, axis], side)

    for cells in grids:
        total = math.prod(cells.sides)
        boxes = np.repeat(np.arange(sets)[:, None], count, axis=1)
        for axis, side in zip(cells.axes, cells.sides, strict=True):
            if side > 1:
                boxes *= side
                boxes += along(axis, side)
        held = np.bincount(boxes.ravel(), minlength=sets * total).reshape(sets, total)
        uneven = (held != count // total).any(axis=1)
        if uneven.any():
            row = int(uneven.argmax())
            fullest = int(held[row].argmax())
            places = np.unravel_index(fullest, cells.sides)
            intervals = [(int(place), side) for place, side in zip(places, cells.sides, strict=True)]
            box = " x ".join(f"[{place}/{side}, {place + 1}/{side})" for place, side in intervals)
            message = (
                f"the cell {box} of {name_dimensions(cells.axes)} holds {held[row, fullest]} points,"
                f" expected {count // total}; {(held[row] == 0).sum()} of {total} cells are empty ({keyword})"
            )
            return Violation(
                message,
                row,
                tuple(np.flatnonzero(boxes[row] == row * total + fullest).tolist()),
                cells.axes,
                tuple((place / side, (place + 1) / side) for place, side in intervals),
            )
    return None


def closest_pair(points: NDArray[np.float64]) -> tuple[float, int, int]:
    """Return the least toroidal distance of ``points`` float64[N, D], N >= 2, and the indices of the closest pair."""
    coordinates = np.ascontiguousarray(points.T)
    least, pair = math.inf, (0, 1)
    for i in range(len(points) - 1):
        apart = np.abs(coordinates[:, i + 1 :] - coordinates[:, i : i + 1])
        apart = np.minimum(apart, 1.0 - apart)
        squared = (apart * apart).sum(axis=0)
        j = int(squared.argmin())
        if squared[j] < least:
            least, pair = float(squared[j]), (i, i + 1 + j)
    return math.sqrt(least), *pair
