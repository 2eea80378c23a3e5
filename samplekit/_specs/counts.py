"""Rules about which numbers of points a sampler can make. A rule is an object that answers questions.

``PowersOf(2).allows(64, dims=2)`` is true, ``PowersOf(2).nearest(100, dims=2)`` is [64, 128]. Nothing here imports
NumPy.
"""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from samplekit._errors import CountError
from samplekit._specs.fields import integer, optional, require_fields

if TYPE_CHECKING:
    from collections.abc import Iterator

LARGEST_ASPECT = 2
"""A grid's longest side is at most this many times its shortest: beyond it, cells would be strips."""
_NEAR = 2000
"""So many counts on either side are tried one by one in search of a grid."""


@dataclass(frozen=True)
class Counts(ABC):
    """A rule about which numbers of points a sampler can make.

    A plugin may define rules of its own, which derive from this class: frozen dataclasses, if they have fields.

    Examples
    --------
    >>> from samplekit import Counts, PowersOf
    >>> isinstance(PowersOf(2), Counts)
    True
    >>> PowersOf(2).nearest(100, dims=2)
    [64, 128]
    """

    def allows(self, count: int, dims: int) -> bool:
        """Tell whether sets of ``count`` points in ``dims`` dimensions can be made."""
        return count >= 1 and self.above(count - 1, dims) == count

    @abstractmethod
    def below(self, count: int, dims: int) -> int | None:
        """Return the largest allowed count below ``count``; None if there is none."""

    @abstractmethod
    def above(self, count: int, dims: int) -> int | None:
        """Return the smallest allowed count above ``count``; None if there is none."""

    @abstractmethod
    def describe(self) -> str:
        """Say which counts are allowed: ``"powers of 2"``."""

    def short(self) -> str:
        """Say it for a narrow column: ``"2^m"``."""
        return self.describe()

    def __str__(self) -> str:
        return self.describe()

    @property
    def depends_on_dims(self) -> bool:
        """True if the allowed counts depend on the number of dimensions."""
        return False

    def nearest(self, count: int, dims: int) -> list[int]:
        """Return ``[count]`` if it is allowed, otherwise the nearest allowed counts below and above, if they exist."""
        if self.allows(count, dims):
            return [count]
        return [near for near in (self.below(count, dims), self.above(count, dims)) if near is not None]

    def rising(self, count: int, dims: int) -> Iterator[int]:
        """Yield the allowed counts above ``count``, smallest first. Most rules never end."""
        following = self.above(count, dims)
        while following is not None:
            yield following
            following = self.above(following, dims)

    def check(self, name: str, count: int, dims: int) -> None:
        """Raise unless a sampler called ``name`` can make ``count`` points.

        Raises
        ------
        CountError
            Names the nearest counts below and above that can be made.
        """
        if self.allows(count, dims):
            return
        below, above = self.below(count, dims), self.above(count, dims)
        nearest = [str(near) for near in (below, above) if near is not None]
        where = f" in {dims} dimensions" if self.depends_on_dims else ""
        known = f": the nearest {'is' if len(nearest) == 1 else 'are'} {' and '.join(nearest)}" if nearest else ""
        raise CountError(f"{name} makes {self.describe()}{where}, not {count}{known}", count, below, above)


class AnyCount(Counts):
    """Every number of points from 1 on.

    Examples
    --------
    >>> from samplekit import AnyCount
    >>> AnyCount().allows(97, dims=2)
    True
    """

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        return count - 1 if count > 1 else None

    def above(self, count: int, dims: int) -> int:
        """See :meth:`Counts.above`."""
        return max(count, 0) + 1

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        return "any number"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return "any"

    def __str__(self) -> str:
        return "any"


@dataclass(frozen=True)
class Products(Counts):
    """Numbers of cells of a grid whose longest side is at most twice its shortest; see :func:`grid_sides`.

    Parameters
    ----------
    dims
        The grid spans so many dimensions; None: all dimensions of the set.

    Examples
    --------
    >>> from samplekit import Products
    >>> Products().nearest(97, dims=2), Products(3).nearest(97, dims=2)
    ([96, 98], [96, 100])
    """

    dims: int | None = None

    def __post_init__(self) -> None:
        require_fields(self, "Products", dims=(optional(integer(1)), "a positive integer or None"))

    @property
    def depends_on_dims(self) -> bool:
        """See :attr:`Counts.depends_on_dims`."""
        return self.dims is None

    def allows(self, count: int, dims: int) -> bool:
        """See :meth:`Counts.allows`."""
        return count >= 1 and grid_sides(count, self.dims or dims) is not None

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        near = range(count - 1, max(count - _NEAR, 0), -1)
        found = next((n for n in near if self.allows(n, dims)), None)
        return found if found or count <= _NEAR else _nearest_grid(count, self.dims or dims, -1)

    def above(self, count: int, dims: int) -> int:
        """See :meth:`Counts.above`."""
        count = max(count, 0)
        found = next((n for n in range(count + 1, count + _NEAR) if self.allows(n, dims)), None)
        return found or _nearest_grid(count, self.dims or dims, +1)

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        number = {None: "", 2: "two "}.get(self.dims, f"{self.dims} ")
        return f"products of {number}near-equal sides (a grid)"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return "a grid" if self.dims is None else f"a grid in {self.dims}D"

    def __str__(self) -> str:
        return "products" if self.dims is None else f"products-in-{self.dims}"


@dataclass(frozen=True)
class Powers(Counts):
    """Powers with a fixed exponent: ``Powers(2)`` allows the squares 1, 4, 9, ...

    Examples
    --------
    >>> from samplekit import Powers
    >>> Powers(2).nearest(15, dims=2)
    [9, 16]
    """

    degree: int

    def __post_init__(self) -> None:
        require_fields(self, type(self).__name__, degree=(integer(2), "an integer from 2 on"))

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        roots = range(floor_root(count - 1, self.degree), 0, -1)
        return next((root**self.degree for root in roots if self._is_root(root)), None)

    def above(self, count: int, dims: int) -> int:
        """See :meth:`Counts.above`."""
        roots = itertools.count(floor_root(count, self.degree) + 1)
        return int(next(root**self.degree for root in roots if self._is_root(root)))

    def _is_root(self, root: int) -> bool:
        return root >= 1

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        return {2: "squares", 3: "cubes"}.get(self.degree, f"powers with exponent {self.degree}")

    def __str__(self) -> str:
        return {2: "squares", 3: "cubes"}.get(self.degree, f"exponent-{self.degree}")


class PrimePowers(Powers):
    """Powers of primes with a fixed exponent: ``PrimePowers(2)`` allows 4, 9, 25, 49, ...

    Examples
    --------
    >>> from samplekit import PrimePowers
    >>> PrimePowers(2).nearest(50, dims=2)
    [49, 121]
    """

    def _is_root(self, root: int) -> bool:
        return _is_prime(root)

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        if self.degree in (2, 3):
            return f"{super().describe()} of primes"
        return f"powers of primes with exponent {self.degree}"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return f"prime^{self.degree}"

    def __str__(self) -> str:
        return f"prime-{super().__str__()}"


@dataclass(frozen=True)
class PowersOf(Counts):
    """Powers of a base: 1, B, B^2, ...

    Examples
    --------
    >>> from samplekit import PowersOf
    >>> PowersOf(3).nearest(100, dims=2)
    [81, 243]
    """

    base: int

    def __post_init__(self) -> None:
        require_fields(self, "PowersOf", base=(integer(2), "an integer from 2 on"))

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        return self.above(count - 1, dims) // self.base if count > 1 else None

    def above(self, count: int, dims: int) -> int:
        """See :meth:`Counts.above`."""
        power = 1
        while power <= count:
            power *= self.base
        return power

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        return f"powers of {self.base}"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return f"{self.base}^m"

    def __str__(self) -> str:
        return f"powers-of-{self.base}"


class FibonacciNumbers(Counts):
    """The Fibonacci numbers 1, 2, 3, 5, 8, ...

    Examples
    --------
    >>> from samplekit import FibonacciNumbers
    >>> FibonacciNumbers().nearest(100, dims=2)
    [89, 144]
    """

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        return _fibonacci_pair(count)[0] if count > 1 else None

    def above(self, count: int, dims: int) -> int:
        """See :meth:`Counts.above`."""
        return _fibonacci_pair(count + 1)[1]

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        return "Fibonacci numbers"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return "Fibonacci"

    def __str__(self) -> str:
        return "fibonacci"


@dataclass(frozen=True)
class Exactly(Counts):
    """One number of points and no other: what a file of points has.

    Examples
    --------
    >>> from samplekit import Exactly
    >>> Exactly(100).nearest(64, dims=2)
    [100]
    """

    count: int

    def __post_init__(self) -> None:
        require_fields(self, "Exactly", count=(integer(1), "a positive integer"))

    def below(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.below`."""
        return self.count if self.count < count else None

    def above(self, count: int, dims: int) -> int | None:
        """See :meth:`Counts.above`."""
        return self.count if self.count > count else None

    def describe(self) -> str:
        """See :meth:`Counts.describe`."""
        return f"exactly {self.count} points"

    def short(self) -> str:
        """See :meth:`Counts.short`."""
        return f"only {self.count}"

    def __str__(self) -> str:
        return f"exactly-{self.count}"


@lru_cache(4096)
def grid_sides(count: int, dims: int) -> tuple[int, ...] | None:
    """Find the grid of ``count`` cells that is nearest to a cube.

    Parameters
    ----------
    count, dims
        Number of cells and of dimensions, at least 1.

    Returns
    -------
    The number of cells along each side, longest first; None if the longest would be more than twice the shortest.

    Examples
    --------
    >>> from samplekit import grid_sides
    >>> grid_sides(96, 2)
    (12, 8)
    >>> grid_sides(97, 2) is None
    True
    """
    if dims >= count.bit_length():
        # Fewer than 2^dims cells: the shortest side is 1, so none is longer than 2.
        twos = count.bit_length() - 1
        return (2,) * twos + (1,) * (dims - twos) if count == 1 << twos else None
    within = (sides for sides in _factorizations(count, dims, count) if sides[0] <= LARGEST_ASPECT * sides[-1])
    return min(within, key=lambda sides: sides[0] / sides[-1], default=None)


def _factorizations(count: int, dims: int, largest: int) -> list[tuple[int, ...]]:
    """Ways to write ``count`` as a product of ``dims`` descending factors of near-equal size."""
    if dims == 1:
        return [(count,)] if count <= largest else []
    mean = count ** (1 / dims)
    # The first side is the longest: at least the mean, and at most the mean times the largest aspect.
    low, high = math.floor(mean * (1 - 1e-9)), min(largest, math.ceil(mean * LARGEST_ASPECT))
    return [
        (side, *rest)
        for side in range(max(1, low), high + 1)
        if count % side == 0
        for rest in _factorizations(count // side, dims - 1, side)
    ]


def _nearest_grid(count: int, dims: int, direction: int) -> int:
    """Find the nearest count below (-1) or above (+1) that has a grid, by branch and bound over the sides.

    Grids of many dimensions are few and far apart: stepping from one count to the next would take for ever.
    """
    if dims > count.bit_length():
        # Fewer than 2^dims cells: the shortest side is 1, so none is longer than 2.
        return 1 << (count.bit_length() - 1 - (direction < 0 and count.bit_count() == 1) + (direction > 0))
    best = 0 if direction < 0 else (2 ** (count.bit_length() + dims)) ** 2
    limit = count + direction

    def extend(cells: int, left: int, longest: int, shortest: int) -> None:
        nonlocal best
        if left == 1:
            side = min(longest, limit // cells) if direction < 0 else max(shortest, -(-limit // cells))
            if shortest <= side <= longest:
                best = max(best, cells * side) if direction < 0 else min(best, cells * side)
            return
        for side in range(longest, shortest - 1, -1):
            most, least = cells * side**left, cells * side * shortest ** (left - 1)
            if (most <= best) if direction < 0 else (most < limit):
                return
            if (least <= limit) if direction < 0 else (least < best):
                extend(cells * side, left - 1, side, shortest)

    root = int(count ** (1 / dims))
    for shortest in range(root + 2, max(root // LARGEST_ASPECT - 1, 0), -1):
        extend(1, dims, LARGEST_ASPECT * shortest, shortest)
    return best


def floor_root(count: int, degree: int) -> int:
    """Return the largest integer whose power ``degree`` is at most ``count``; 0 below 1."""
    root: int = round(max(count, 0) ** (1 / degree))
    while root**degree > max(count, 0):
        root -= 1
    while (root + 1) ** degree <= count:
        root += 1
    return root


def _is_prime(number: int) -> bool:
    """Tell whether a number is prime, by trial division."""
    return number >= 2 and all(number % divisor for divisor in range(2, math.isqrt(number) + 1))


def _fibonacci_pair(count: int) -> tuple[int, int]:
    """Return two successive Fibonacci numbers of which the second is the first that is at least ``count``."""
    before, number = 1, 1
    while number < count:
        before, number = number, before + number
    return before, number
