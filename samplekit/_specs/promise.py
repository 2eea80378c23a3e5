"""Promises: what holds exactly of every realisation of a sampler, and what conformance checks.

The edge of a cell is the float64 nearest to its fraction: a point at 1/3 lies in the cell that begins at 1/3.
"""

from __future__ import annotations

from dataclasses import dataclass

from samplekit._specs.option import is_number, require


def _is_integer(value: object, least: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= least


def _are_dimensions(dims: object) -> bool:
    return isinstance(dims, tuple) and bool(dims) and all(_is_integer(d, 0) for d in dims) and len({*dims}) == len(dims)


@dataclass(frozen=True)
class Net:
    """Promise: the projection on ``dims`` is a (t, m, s)-net in ``base`` for every power of the base.

    ``sequence``: every later block of a power of the base is a net as well ((t, s)-sequence).

    Examples
    --------
    >>> from samplekit import Net
    >>> Net((0, 1), base=2, t=0, sequence=True).dims
    (0, 1)
    """

    dims: tuple[int, ...] = (0, 1)
    base: int = 2
    t: int = 0
    sequence: bool = True
    keyword = "net"

    def __post_init__(self) -> None:
        require(_are_dimensions(self.dims), "Net: dims must be a tuple of different dimensions from 0 on")
        require(_is_integer(self.base, 2), "Net: the base must be an integer from 2 on")
        require(_is_integer(self.t, 0), "Net: t must be an integer from 0 on")


@dataclass(frozen=True)
class LatinStrata:
    """Promise: in each of ``dims`` (None: in all) every interval [i/N, (i+1)/N) holds exactly one of the N points.

    Examples
    --------
    >>> from samplekit import LatinStrata
    >>> LatinStrata(dims=(0,))
    LatinStrata(dims=(0,))
    """

    dims: tuple[int, ...] | None = None
    keyword = "latin"

    def __post_init__(self) -> None:
        require(
            self.dims is None or _are_dimensions(self.dims),
            "LatinStrata: dims must be a tuple of different dimensions from 0 on, or None",
        )


@dataclass(frozen=True)
class GridStrata:
    """Promise: each cell of the grid that the count factorises into holds exactly one point.

    ``block``: number of dimensions that one grid spans; None: all of them.

    Examples
    --------
    >>> from samplekit import GridStrata
    >>> GridStrata(block=2)
    GridStrata(block=2)
    """

    block: int | None = None
    keyword = "grid"

    def __post_init__(self) -> None:
        require(
            self.block is None or _is_integer(self.block, 1), "GridStrata: block must be a positive integer or None"
        )


@dataclass(frozen=True)
class OrthogonalArray:
    """Promise: every ``strength`` dimensions project onto one point in each cell of their grid.

    Examples
    --------
    >>> from samplekit import OrthogonalArray
    >>> OrthogonalArray(strength=2).strength
    2
    """

    strength: int = 2
    keyword = "orthogonal-array"

    def __post_init__(self) -> None:
        require(_is_integer(self.strength, 1), "OrthogonalArray: the strength must be a positive integer")


@dataclass(frozen=True)
class MinimumDistance:
    """Promise: no two points are closer than ``fraction`` of the densest packing's distance on the torus.

    Examples
    --------
    >>> from samplekit import MinimumDistance
    >>> MinimumDistance(0.7).fraction
    0.7
    """

    fraction: float
    keyword = "distance"

    def __post_init__(self) -> None:
        require(
            is_number(self.fraction) and 0.0 < self.fraction <= 1.0, "MinimumDistance: the fraction must be in (0, 1]"
        )


Promise = Net | LatinStrata | GridStrata | OrthogonalArray | MinimumDistance
