"""Which numbers of points a sampler can make, and the nearest to one that it cannot.

The rules are the words of ``SamplerSpec.counts``. Nothing here imports NumPy.
"""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable

LARGEST_ASPECT = 2
"""A grid's longest side is at most this many times its shortest: beyond it strata are strips."""
_NEAR = 2000
"""Counts on either side that are tried one by one."""


@lru_cache(4096)
def grid_sides(count: int, dims: int) -> tuple[int, ...] | None:
    """The sides of the grid of ``count`` cells that is nearest to a cube, longest first; None if it would be strips.

    ``grid_sides(96, 2)`` is (12, 8), ``grid_sides(97, 2)`` is None.
    """
    if dims >= count.bit_length():
        # Fewer than 2^dims cells: some side is 1, so none is longer than 2.
        twos = count.bit_length() - 1
        return (2,) * twos + (1,) * (dims - twos) if count == 1 << twos else None
    best: tuple[int, ...] | None = None
    for sides in _factorizations(count, dims, count):
        if sides[0] <= LARGEST_ASPECT * sides[-1] and (best is None or sides[0] / sides[-1] < best[0] / best[-1]):
            best = sides
    return best


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


def _is_power(count: int, base: int) -> bool:
    while base > 1 and count % base == 0:
        count //= base
    return count == 1


def _is_prime(n: int) -> bool:
    return n >= 2 and all(n % divisor for divisor in range(2, math.isqrt(n) + 1))


def _root(count: int, degree: int) -> int:
    """The integer whose power ``degree`` is ``count``, or 0."""
    root = round(count ** (1 / degree))
    return next((r for r in (root - 1, root, root + 1) if r >= 0 and r**degree == count), 0)


def fibonacci_numbers(least: int) -> tuple[int, ...]:
    """The Fibonacci numbers 1, 1, 2, 3, 5, ... up to the first one that is larger than ``least``."""
    numbers = [1, 1]
    while numbers[-1] <= least:
        numbers.append(numbers[-2] + numbers[-1])
    return tuple(numbers)


def _number_in(rule: str) -> int:
    """The number that ends a rule such as ``powers-of-2``."""
    return int(rule.rpartition("-")[2])


def _rule(rule: str, dims: int) -> Callable[[int], bool]:
    if rule == "any":
        return lambda _: True
    if rule == "products":
        return lambda count: grid_sides(count, dims) is not None
    if rule.startswith("products-in-"):
        return lambda count: grid_sides(count, _number_in(rule)) is not None
    if rule == "squares":
        return lambda count: _root(count, 2) > 0
    if rule == "prime-squares":
        return lambda count: _is_prime(_root(count, 2))
    if rule == "prime-cubes":
        return lambda count: _is_prime(_root(count, 3))
    if rule == "fibonacci":
        return lambda count: count in fibonacci_numbers(count)
    if rule.startswith("exactly-"):
        return lambda count: count == _number_in(rule)
    return lambda count: _is_power(count, _number_in(rule))


def allows(rule: str, count: int, dims: int) -> bool:
    """Whether a sampler of this rule makes ``count`` points in ``dims`` dimensions."""
    return count >= 1 and _rule(rule, dims)(count)


def nearest_below(rule: str, count: int, dims: int) -> int | None:
    """The largest count below ``count`` that the rule allows; None if there is none."""
    return next((n for n in _candidates(rule, count, dims, -1) if 1 <= n < count), None)


def nearest_above(rule: str, count: int, dims: int) -> int | None:
    """The smallest count above ``count`` that the rule allows; None if there is none."""
    return next((n for n in _candidates(rule, count, dims, +1) if n > count), None)


def _candidates(rule: str, count: int, dims: int, direction: int) -> list[int]:
    """Allowed counts on one side of ``count``, nearest first: computed, where stepping by one would take for ever."""
    count = max(count, 0)
    degree = {"squares": 2, "prime-squares": 2, "prime-cubes": 3}.get(rule)
    if degree:
        root = math.floor(max(count, 1) ** (1 / degree) + 1e-9)
        roots = range(root + 1, 0, -1) if direction < 0 else range(max(root - 1, 1), 2 * root + 8)
        allowed = _is_prime if rule.startswith("prime") else lambda _: True
        return list(islice((r**degree for r in roots if (r**degree - count) * direction > 0 and allowed(r)), 1))
    if rule.startswith("powers-of-"):
        base = _number_in(rule)
        exponent = 0 if base == 1 else int(math.log(max(count, 1), base))
        powers = [base ** max(exponent + step, 0) for step in ((1, 0, -1) if direction < 0 else (-1, 0, 1, 2))]
        return [n for n in powers if (n - count) * direction > 0][:1]
    if rule == "fibonacci":
        return [n for n in fibonacci_numbers(count)[::direction] if (n - count) * direction > 0][:1]
    if rule.startswith("exactly-"):
        return [_number_in(rule)]
    test = _rule(rule, dims)
    near = range(count + direction, max(count + direction * _NEAR, 0), direction)
    found = next((n for n in near if test(n)), None)
    if found is not None or (count <= _NEAR and direction < 0):
        return [] if found is None else [found]
    return [_nearest_grid(count, dims if rule == "products" else _number_in(rule), direction)]


def _nearest_grid(count: int, dims: int, direction: int) -> int:
    """The nearest count below or above that has a grid, by branch and bound over the sides, longest first.

    For grids of many dimensions, which lie so far apart that stepping by one would take for ever, and are few.
    """
    if dims > count.bit_length():
        # Some side is 1 below 2^dims cells, so none is longer than 2.
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


def describe(rule: str) -> str:
    """The rule in words: what a sampler of this rule makes."""
    words = {
        "any": "any number",
        "products": "products of near-equal sides (a grid)",
        "squares": "squares",
        "prime-squares": "squares of primes",
        "prime-cubes": "cubes of primes",
        "fibonacci": "Fibonacci numbers",
    }
    if rule.startswith("products-in-"):
        number = _number_in(rule)
        return f"products of {'two' if number == 2 else number} near-equal sides (a grid)"
    if rule.startswith("exactly-"):
        return f"exactly {_number_in(rule)}"
    return words.get(rule) or f"powers of {_number_in(rule)}"


def check_count(name: str, rule: str, count: int, dims: int) -> None:
    """Raise unless a sampler called ``name`` makes ``count`` points.

    Raises
    ------
    UsageError
        Names the nearest counts below and above that it makes.
    """
    if count < 1:
        raise UsageError(f"count {count}: expected at least 1")
    if allows(rule, count, dims):
        return
    if rule.startswith("exactly-"):
        raise UsageError(f"{name} makes {describe(rule)} points, not {count}")
    nearest = [str(n) for n in (nearest_below(rule, count, dims), nearest_above(rule, count, dims)) if n is not None]
    where = "" if rule != "products" else f" in {dims} dimensions"
    verb = "is" if len(nearest) == 1 else "are"
    raise UsageError(f"{name} makes {describe(rule)}{where}, not {count}: the nearest {verb} {' and '.join(nearest)}")
