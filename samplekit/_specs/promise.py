"""Promises: what a sampler guarantees of every set of points, exactly. Each is an object that can check a set.

The edge of a cell is the float64 nearest to its fraction: a point at 1/3 lies in the cell that begins at 1/3.
NumPy is imported when points are checked, not before.
"""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from samplekit._errors import UsageError
from samplekit._specs.counts import floor_root, grid_sides
from samplekit._specs.fields import are_dimensions, instance_of, integer, is_number, optional, require_fields

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from samplekit._specs.point_cells import Violation

_ROUNDING = 2.0**-51
"""Coordinates are rounded to 2^-53, and moved and wrapped with another rounding: a distance is known to this."""


class Cells(NamedTuple):
    """Equal cells of some dimensions: each holds as many points of a set as any other.

    Attributes
    ----------
    axes
        The dimensions.
    sides
        The number of cells along each of them.
    """

    axes: tuple[int, ...]
    sides: tuple[int, ...]


class Promise(ABC):
    """A property that a sampler guarantees for every set.

    Examples
    --------
    >>> import samplekit
    >>> points = samplekit.points("sobol", count=16)
    >>> [promise.find_violation(points) for promise in (samplekit.Net((0, 1)), samplekit.LatinStrata())]
    [None, None]
    """

    keyword: ClassVar[str]
    """The kind of promise, as :attr:`RandomizerSpec.keeps` names it."""

    @abstractmethod
    def describe(self) -> str:
        """Say what is promised, as a sentence without its full stop."""

    @abstractmethod
    def short(self, beside: Sequence[Promise] = ()) -> str:
        """Name the promise in few words; nets name the bases of all nets among those that stand beside them."""

    def cells(self, count: int, dims: int) -> Iterator[Cells]:
        """Yield all cells that hold equally many points in sets of ``count`` points in ``dims`` dimensions."""
        return iter(())

    def caption(self, count: int, dims: int) -> str:
        """Describe the cells of sets of ``count`` points for a picture: ``"8 x 8 cells"``; empty if there are none."""
        return ""

    def implies(self, other: Promise, dims: int) -> bool:
        """Tell whether, in the first ``dims`` dimensions, this says all that ``other`` says, and more."""
        return False

    def find_violation(self, points: ArrayLike) -> Violation | None:
        """Find where sets of points break this promise.

        Parameters
        ----------
        points
            float64[R, N, D] as :func:`samplekit.points` returns them, or one set, float64[N, D].

        Returns
        -------
        The first violation; None if the promise is kept, or promises nothing of so many points.

        Raises
        ------
        UsageError
            The array has another number of axes.
        """
        from samplekit._specs.point_cells import find_uneven_cell

        sets = _as_sets(points)
        return find_uneven_cell(sets, self.cells(*sets.shape[1:]), self.keyword)


@dataclass(frozen=True)
class Net(Promise):
    """Promise: the projection on ``dims`` is a (t, m, s)-net in ``base`` for every power of the base.

    Niederreiter 1987, "Point sets and sequences with small discrepancy".

    Parameters
    ----------
    dims
        The dimensions, counted from 0.
    base, t
        A net of base^m points has base^t points in every elementary interval of volume base^(t - m).
    sequence
        Every later block of a power of the base is a net as well, as in a (t, s)-sequence.

    Examples
    --------
    >>> from samplekit import Net
    >>> Net((0, 1), base=2, t=0).describe()
    'dimensions 0, 1: the first 2^m points are a (0, m, 2)-net in base 2, and so is every later block of as many'
    """

    dims: tuple[int, ...] = (0, 1)
    base: int = 2
    t: int = 0
    sequence: bool = True
    keyword = "net"

    def __post_init__(self) -> None:
        require_fields(
            self,
            "Net",
            dims=(are_dimensions, "a tuple of different dimensions from 0 on"),
            base=(integer(2), "an integer from 2 on"),
            t=(integer(0), "an integer from 0 on"),
            sequence=(instance_of(bool), "True or False"),
        )

    def describe(self) -> str:
        """See :meth:`Promise.describe`."""
        blocks = ", and so is every later block of as many" if self.sequence else ""
        kind = f"({self.t}, m, {len(self.dims)})-net in base {self.base}"
        return f"{name_dimensions(self.dims)}: the first {self.base}^m points are a {kind}{blocks}"

    def short(self, beside: Sequence[Promise] = ()) -> str:
        """See :meth:`Promise.short`."""
        bases = dict.fromkeys(str(net.base) for net in beside or (self,) if isinstance(net, Net))
        return f"net in base {', '.join(bases)}"

    def digits(self, count: int) -> int | None:
        """Return m - t, the digits that elementary intervals share; None if ``count`` is no base^m with m >= t."""
        digits, size = 0, self.base**self.t
        while size < count:
            digits, size = digits + 1, size * self.base
        return digits if size == count else None

    def cells(self, count: int, dims: int) -> Iterator[Cells]:
        """Yield the elementary intervals of all shapes; see :meth:`Promise.cells`."""
        digits = self.digits(count)
        axes = tuple(axis for axis in self.dims if axis < dims)
        if axes and digits is not None:
            for shape in _shares(digits, len(axes)):
                yield Cells(axes, tuple(self.base**q for q in shape))

    def caption(self, count: int, dims: int) -> str:
        """See :meth:`Promise.caption`."""
        digits = self.digits(count)
        axes = tuple(axis for axis in self.dims if axis < dims)
        if not axes or not digits:
            return ""
        if len(axes) == 1:
            return f"{self.base**digits} intervals of x{axes[0]}"
        sides = self.base ** ((digits + 1) // 2), self.base ** (digits // 2)
        where = "" if len(axes) == dims else f" of {_coordinates(axes, dims)}"
        return f"{_times(sides)} elementary intervals in base {self.base}{where}"

    def implies(self, other: Promise, dims: int) -> bool:
        """See :meth:`Promise.implies`."""
        if not (isinstance(other, Net) and self.base == other.base and self.t <= other.t):
            return False
        axes, others = ({axis for axis in net.dims if axis < dims} for net in (self, other))
        return others <= axes and (others < axes or self.t < other.t)


class Strata(Promise):
    """Promise: every cell of some grids holds exactly one point. What the three kinds of strata have in common."""


@dataclass(frozen=True)
class LatinStrata(Strata):
    """Promise: in each of ``dims`` (None: in all) every interval [i/N, (i+1)/N) holds exactly one of the N points.

    Examples
    --------
    >>> from samplekit import LatinStrata
    >>> LatinStrata().find_violation([[0.1, 0.7], [0.6, 0.2]]) is None
    True
    >>> print(LatinStrata().find_violation([[0.1, 0.7], [0.4, 0.2]]))
    the cell [0/2, 1/2) of dimension 0 holds 2 points, expected 1; 1 of 2 cells are empty (latin)
    """

    dims: tuple[int, ...] | None = None
    keyword = "latin"

    def __post_init__(self) -> None:
        expected = "a tuple of different dimensions from 0 on, or None"
        require_fields(self, "LatinStrata", dims=(optional(are_dimensions), expected))

    def describe(self) -> str:
        """See :meth:`Promise.describe`."""
        where = "every dimension" if self.dims is None else name_dimensions(self.dims)
        return f"one point in each of N intervals of {where}"

    def short(self, beside: Sequence[Promise] = ()) -> str:
        """See :meth:`Promise.short`."""
        return "Latin"

    def cells(self, count: int, dims: int) -> Iterator[Cells]:
        """See :meth:`Promise.cells`."""
        return (Cells((axis,), (count,)) for axis in range(dims) if self.dims is None or axis in self.dims)

    def caption(self, count: int, dims: int) -> str:
        """See :meth:`Promise.caption`."""
        axes = tuple(axis for cells in self.cells(count, dims) for axis in cells.axes)
        return f"{count} intervals of {_coordinates(axes, dims)}" if axes and count > 1 else ""


@dataclass(frozen=True)
class GridStrata(Strata):
    """Promise: each cell of the grid that the count factorises into (:func:`grid_sides`) holds exactly one point.

    ``block``: number of dimensions that one grid spans; None: all of them.

    Examples
    --------
    >>> from samplekit import GridStrata
    >>> GridStrata(block=2).caption(96, dims=4)
    '12 x 8 cells in each block of 2 dimensions'
    """

    block: int | None = None
    keyword = "grid"

    def __post_init__(self) -> None:
        require_fields(self, "GridStrata", block=(optional(integer(1)), "a positive integer or None"))

    def describe(self) -> str:
        """See :meth:`Promise.describe`."""
        where = "" if self.block is None else f" of every block of {self.block} dimensions"
        return f"one point in each cell of a grid of near-equal sides{where}"

    def short(self, beside: Sequence[Promise] = ()) -> str:
        """See :meth:`Promise.short`."""
        return {None: "grid", 2: "grid in pairs"}.get(self.block, f"grid in {self.block}s")

    def cells(self, count: int, dims: int) -> Iterator[Cells]:
        """See :meth:`Promise.cells`; a block that the dimensions cut short has no grid."""
        block = self.block or dims
        sides = grid_sides(count, block)
        if sides is not None:
            for first in range(0, dims - block + 1, block):
                yield Cells(tuple(range(first, first + block)), sides)

    def caption(self, count: int, dims: int) -> str:
        """See :meth:`Promise.caption`."""
        block = self.block or dims
        sides = grid_sides(count, block)
        if sides is None or block > dims or count == 1:
            return ""
        if dims == 1:
            return f"{count} intervals of x0"
        each = "" if block == dims else f" in each block of {block} dimensions"
        return f"{_times(sides)} cells{each}"


@dataclass(frozen=True)
class OrthogonalArray(Strata):
    """Promise: every ``strength`` dimensions project onto one point in each cell of their grid.

    In fewer dimensions than that, each cell of the grid of all dimensions holds equally many points.

    Examples
    --------
    >>> from samplekit import OrthogonalArray
    >>> OrthogonalArray(strength=2).caption(49, dims=3)
    '7 x 7 cells of each pair'
    """

    strength: int = 2
    keyword = "orthogonal-array"

    def __post_init__(self) -> None:
        require_fields(self, "OrthogonalArray", strength=(integer(1), "a positive integer"))

    def describe(self) -> str:
        """See :meth:`Promise.describe`."""
        t = self.strength
        return f"one point in each of the s^{t} cells of any {t} dimensions, N = s^{t}"

    def short(self, beside: Sequence[Promise] = ()) -> str:
        """See :meth:`Promise.short`."""
        return "orthogonal array"

    def cells(self, count: int, dims: int) -> Iterator[Cells]:
        """See :meth:`Promise.cells`."""
        side = floor_root(count, self.strength)
        if side**self.strength == count:
            for axes in itertools.combinations(range(dims), min(self.strength, dims)):
                yield Cells(axes, (side,) * len(axes))

    def caption(self, count: int, dims: int) -> str:
        """See :meth:`Promise.caption`."""
        cells = next(self.cells(count, dims), None)
        if cells is None or count == 1:
            return ""
        together = len(cells.axes)
        if together == 1:
            return f"{cells.sides[0]} intervals of each axis"
        return f"{_times(cells.sides)} cells of {'each pair' if together == 2 else f'every {together} axes'}"


@dataclass(frozen=True)
class MinimumDistance(Promise):
    """Promise: no two points are closer than ``fraction`` of the densest packing's distance on the torus.

    Examples
    --------
    >>> from samplekit import MinimumDistance
    >>> print(MinimumDistance(0.7).find_violation([[0.05, 0.5], [0.95, 0.5]]))
    two points are 0.1 apart, expected at least 0.531885
    """

    fraction: float
    keyword = "distance"

    def __post_init__(self) -> None:
        def is_fraction(value: object) -> bool:
            return is_number(value) and 0.0 < value <= 1.0  # type: ignore[operator]

        require_fields(self, "MinimumDistance", fraction=(is_fraction, "a number in (0, 1]"))

    def describe(self) -> str:
        """See :meth:`Promise.describe`."""
        return f"points at least {self.fraction:g} of the densest packing's distance apart, on the torus"

    def short(self, beside: Sequence[Promise] = ()) -> str:
        """See :meth:`Promise.short`."""
        return "distance"

    def distance(self, count: int, dims: int) -> float | None:
        """Return the promised distance; None where the densest packing is not known, and of a single point.

        Densest lattices, of centre density delta: (d / 2)^D N / delta = 1. Conway and Sloane 1999, "Sphere packings,
        lattices and groups", table 1.2.
        """
        density = {1: 1 / 2, 2: 1 / (2 * math.sqrt(3)), 3: 1 / (4 * math.sqrt(2)), 4: 1 / 8, 5: 1 / (8 * math.sqrt(2))}
        if count < 2 or dims not in density:
            return None
        return self.fraction * 2.0 * float((density[dims] / count) ** (1 / dims))

    def find_violation(self, points: ArrayLike) -> Violation | None:
        """Find two points that are too close; see :meth:`Promise.find_violation`."""
        from samplekit._specs.point_cells import Violation, closest_pair

        sets = _as_sets(points)
        promised = self.distance(*sets.shape[1:])
        if promised is None:
            return None
        for row, one in enumerate(sets):
            distance, *pair = closest_pair(one)
            if distance < promised - _ROUNDING:
                message = f"two points are {distance:.6g} apart, expected at least {promised:.6g}"
                return Violation(message, row, tuple(pair))
        return None


KINDS = sorted(kind.keyword for kind in (Net, LatinStrata, GridStrata, OrthogonalArray, MinimumDistance))
"""The words for the kinds of promises, as randomizers name those that they keep."""


def _as_sets(points: ArrayLike) -> NDArray[np.float64]:
    import numpy as np

    sets = np.asarray(points, np.float64)
    if sets.ndim not in (2, 3):
        raise UsageError(f"points must be float64[R, N, D] or float64[N, D], not an array of {sets.ndim} axes")
    return sets if sets.ndim == 3 else sets[None]


def _shares(digits: int, dims: int) -> Iterator[tuple[int, ...]]:
    """Yield all ways to share ``digits`` among ``dims`` axes."""
    if dims == 1:
        yield (digits,)
        return
    for first in range(digits + 1):
        for rest in _shares(digits - first, dims - 1):
            yield (first, *rest)


def name_dimensions(axes: tuple[int, ...]) -> str:
    """Return the axes after the word for them: ``"dimensions 0, 1"``."""
    return ("dimension " if len(axes) == 1 else "dimensions ") + ", ".join(map(str, axes))


def _coordinates(axes: tuple[int, ...], dims: int) -> str:
    return "each axis" if len(axes) == dims > 1 else ", ".join(f"x{axis}" for axis in axes)


def _times(sides: tuple[int, ...]) -> str:
    return " x ".join(map(str, sides))
