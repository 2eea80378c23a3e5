"""Promises: what holds exactly of every realisation of a sampler, and what conformance checks.

The edge of a cell is the float64 nearest to its fraction: a point at 1/3 lies in the cell that begins at 1/3.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Net:
    """Promise: the projection on ``dims`` is a (t, m, s)-net in ``base`` for every power of the base.

    ``sequence``: every later block of a power of the base is a net as well ((t, s)-sequence).
    """

    dims: tuple[int, ...] = (0, 1)
    base: int = 2
    t: int = 0
    sequence: bool = True
    keyword = "net"


@dataclass(frozen=True)
class LatinStrata:
    """Promise: in each of ``dims`` (None: in all) every interval [i/N, (i+1)/N) holds exactly one of the N points."""

    dims: tuple[int, ...] | None = None
    keyword = "latin"


@dataclass(frozen=True)
class GridStrata:
    """Promise: each cell of the grid that the count factorises into holds exactly one point.

    ``block``: number of dimensions that one grid spans; None: all of them.
    """

    block: int | None = None
    keyword = "grid"


@dataclass(frozen=True)
class OrthogonalArray:
    """Promise: every ``strength`` dimensions project onto one point in each cell of their grid."""

    strength: int = 2
    keyword = "orthogonal-array"


@dataclass(frozen=True)
class MinimumDistance:
    """Promise: no two points are closer than ``fraction`` of the densest packing's distance on the torus."""

    fraction: float
    keyword = "distance"


Promise = Net | LatinStrata | GridStrata | OrthogonalArray | MinimumDistance
