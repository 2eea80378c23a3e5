"""The grids that a sampler's promises speak of, as they appear on one axis or in the square of two."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from samplekit._specs import GridStrata, LatinStrata, Net, OrthogonalArray
from samplekit._specs.counts import grid_sides

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._specs import Promise


class Grid(NamedTuple):
    """What is promised of a projection: every cell, and every interval, holds as many points as any other.

    Attributes
    ----------
    cells
        Columns and rows of the finest grid of near-square cells; (1, 1): none is promised.
    intervals
        The intervals of the first and of the second axis, each axis taken alone; 1: none are promised.
    """

    cells: tuple[int, int] = (1, 1)
    intervals: tuple[int, int] = (1, 1)


def grid_of(promises: Sequence[Promise], count: int, dims: int, axes: tuple[int, ...]) -> Grid:
    """Find the grid of one projection of a set.

    Parameters
    ----------
    promises
        The sampler's, as its declaration has them.
    count, dims
        Size of the set and its dimensions.
    axes
        One dimension, or two: along x and along y.
    """
    cells = [(1, 1), *(_cells(promise, count, dims, (axes[0], axes[1])) for promise in promises if len(axes) == 2)]
    intervals = [max((1, *(_intervals(promise, count, dims, axes, axis) for promise in promises))) for axis in axes]
    return Grid(
        max(cells, key=lambda sides: sides[0] * sides[1]), (intervals[0], intervals[1] if len(axes) == 2 else 1)
    )


def describe_grids(promises: Sequence[Promise], count: int, dims: int) -> str:
    """Say what is promised of sets of ``count`` points: empty if it is nothing."""
    phrases = [
        _phrase(promise, count, dims)
        for promise in promises
        if not any(_implies(other, promise, dims) for other in promises)
    ]
    return "; ".join(dict.fromkeys(phrase for phrase in phrases if phrase))


def _implies(net: Promise, other: Promise, dims: int) -> bool:
    """Whether, of the first ``dims`` dimensions, ``net`` says all that ``other`` says, and more."""
    if not (isinstance(net, Net) and isinstance(other, Net) and net.base == other.base and net.t <= other.t):
        return False
    axes, others = ({axis for axis in each.dims if axis < dims} for each in (net, other))
    return others <= axes and (others < axes or net.t < other.t)


def _cells(promise: Promise, count: int, dims: int, pair: tuple[int, int]) -> tuple[int, int]:
    """Find columns and rows of the cells of a pair of dimensions; (1, 1): none."""
    x, y = pair
    if isinstance(promise, GridStrata):
        block = promise.block or dims
        sides = grid_sides(count, block)
        first = x - x % block
        # A block that the dimensions cut short has no grid of its own.
        if sides is not None and first == y - y % block and first + block <= dims:
            return sides[x - first], sides[y - first]
    if isinstance(promise, Net) and x in promise.dims and y in promise.dims:
        digits = _digits(promise, count)
        # For an odd number of digits two shapes are as near to squares: the wide one, as `grid_sides` has it.
        return promise.base ** ((digits + 1) // 2), promise.base ** (digits // 2)
    if isinstance(promise, OrthogonalArray) and promise.strength >= 2:
        side = _root(count, promise.strength)
        return side, side
    return 1, 1


def _intervals(promise: Promise, count: int, dims: int, axes: tuple[int, ...], axis: int) -> int:
    """Count the intervals of one dimension that are not those of cells; 1: none."""
    if isinstance(promise, LatinStrata) and (promise.dims is None or axis in promise.dims):
        return count
    if isinstance(promise, Net) and axis in promise.dims and not (len(axes) == 2 and set(axes) <= set(promise.dims)):
        return int(promise.base ** _digits(promise, count))
    if isinstance(promise, GridStrata) and dims == 1:
        return count
    if isinstance(promise, OrthogonalArray):
        if promise.strength == 1:
            return count
        return _root(count, promise.strength) if dims == 1 else 1
    return 1


def _digits(net: Net, count: int) -> int:
    """Give the m - t of a (t, m, s)-net: elementary intervals of base^(t - m) hold base^t points each; 0: no net."""
    digits = 0
    while net.base > 1 and count > 1 and count % net.base == 0:
        count //= net.base
        digits += 1
    return max(digits - net.t, 0) if count == 1 else 0


def _root(count: int, degree: int) -> int:
    """Find the integer whose power ``degree`` is ``count``; 1 if there is none."""
    root = round(count ** (1 / degree))
    return next((r for r in (root - 1, root, root + 1) if r >= 1 and r**degree == count), 1)


def _phrase(promise: Promise, count: int, dims: int) -> str:
    if count == 1:
        return ""
    if isinstance(promise, LatinStrata):
        axes = [axis for axis in range(dims) if promise.dims is None or axis in promise.dims]
        return f"{count} intervals of {_axes(axes, dims)}" if axes else ""
    if isinstance(promise, GridStrata):
        sides = grid_sides(count, promise.block or dims)
        if sides is None or (promise.block or dims) > dims:
            return ""
        if dims == 1:
            return f"{count} intervals of x0"
        each = "" if promise.block in (None, dims) else f" in each block of {promise.block} dimensions"
        return f"{_times(sides)} cells{each}"
    if isinstance(promise, Net):
        axes = [axis for axis in promise.dims if axis < dims]
        digits = _digits(promise, count)
        if not axes or digits == 0:
            return ""
        if len(axes) == 1:
            return f"{promise.base**digits} intervals of x{axes[0]}"
        sides = promise.base ** ((digits + 1) // 2), promise.base ** (digits // 2)
        where = "" if len(axes) == dims else f" of {_axes(axes, dims)}"
        return f"{_times(sides)} elementary intervals in base {promise.base}{where}"
    if isinstance(promise, OrthogonalArray):
        side = count if promise.strength == 1 else _root(count, promise.strength)
        if side == 1:
            return ""
        if promise.strength == 1 or dims == 1:
            return f"{side} intervals of each axis"
        together = min(promise.strength, dims)
        return f"{_times((side,) * together)} cells of {'each pair' if together == 2 else f'every {together} axes'}"
    return ""


def _axes(axes: list[int], dims: int) -> str:
    return "each axis" if len(axes) == dims > 1 else ", ".join(f"x{axis}" for axis in axes)


def _times(sides: tuple[int, ...]) -> str:
    return " x ".join(str(side) for side in sides)
