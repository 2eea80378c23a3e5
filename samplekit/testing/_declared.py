"""What a declaration allows, from its words alone: brute force from the definitions, apart from the samplers' own code.

Slow and plain on purpose. ``samplekit._specs.counts`` computes the same by other means, for samplers; checks use this.
"""

from __future__ import annotations

import itertools
import math
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit._specs import SamplerSpec

_LARGEST_ASPECT = 2


def _divisors(n: int) -> list[int]:
    small = [d for d in range(1, math.isqrt(n) + 1) if n % d == 0]
    return sorted({*small, *(n // d for d in small)})


@cache
def grids(count: int, dims: int) -> tuple[tuple[int, ...], ...]:
    """All grids of ``count`` cells whose longest side over the shortest is least and at most 2, longest side first.

    More than one only where two grids are equally near to a cube; none where every grid would be strips.
    """
    found: list[tuple[int, ...]] = []

    def extend(sides: tuple[int, ...], rest: int, left: int) -> None:
        if left == 0:
            if rest == 1:
                found.append(sides)
            return
        for side in _divisors(rest):
            if not sides or (side <= sides[-1] and sides[0] <= _LARGEST_ASPECT * side):
                extend((*sides, side), rest // side, left - 1)

    extend((), count, dims)
    within = [sides for sides in found if sides[0] <= _LARGEST_ASPECT * sides[-1]]
    if not within:
        return ()
    least = min(sides[0] / sides[-1] for sides in within)
    return tuple(sides for sides in within if sides[0] / sides[-1] == least)


def _is_prime(n: int) -> bool:
    return n >= 2 and all(n % d for d in range(2, math.isqrt(n) + 1))


def is_power(n: int, base: int) -> bool:
    """Whether ``n`` is base^0, base^1, ..."""
    while n > 1 and base > 1 and n % base == 0:
        n //= base
    return n == 1


def allows(rule: str, count: int, dims: int) -> bool:
    """Whether a rule of ``SamplerSpec.counts`` allows ``count`` points in ``dims`` dimensions."""
    if count < 1:
        return False
    if rule == "any":
        return True
    if rule.startswith("products"):
        return bool(grids(count, dims if rule == "products" else int(rule.rpartition("-")[2])))
    if rule == "squares":
        return math.isqrt(count) ** 2 == count
    if rule.startswith("prime-"):
        degree = 2 if rule == "prime-squares" else 3
        roots = itertools.takewhile(lambda root: root**degree <= count, itertools.count(2))
        return any(root**degree == count and _is_prime(root) for root in roots)
    if rule == "fibonacci":
        before, number = 1, 1
        while number < count:
            before, number = number, before + number
        return number == count
    if rule.startswith("exactly-"):
        return count == int(rule.rpartition("-")[2])
    return is_power(count, int(rule.rpartition("-")[2]))


def allowed_near(
    rule: str, count: int, dims: int, largest: int = 1 << 17, makes: Callable[[int], bool] = lambda _: True
) -> int | None:
    """The allowed count nearest to ``count``; the smaller of two; None if there is none up to ``largest``.

    ``makes``: whether the sampler itself refuses none of the allowed, for what its declaration cannot say.
    """
    for distance in itertools.count():
        for candidate in (count - distance, count + distance):
            if 1 <= candidate <= largest and allows(rule, candidate, dims) and makes(candidate):
                return candidate
        if count + distance > largest and count - distance < 1:
            return None
    return None


def counts_of(
    spec: SamplerSpec, wanted: tuple[int, ...], dims: int, makes: Callable[[int], bool] = lambda _: True
) -> list[int]:
    """For each wanted count the nearest that the declaration allows, and the sampler makes, rising, each once."""
    most = spec.largest_index + 1
    near = {allowed_near(spec.counts, min(count, most), dims, makes=makes) for count in wanted}
    return sorted(count for count in near if count is not None and count <= most)


def dims_of(spec: SamplerSpec, wanted: int) -> int:
    """The number of dimensions nearest to ``wanted`` that the declaration allows."""
    least, most = spec.dimensions
    return max(least, wanted if most is None else min(wanted, most))


def most_dims(spec: SamplerSpec, limit: int) -> int:
    """The largest number of dimensions up to ``limit`` in which some count up to 4096 exists: grids need few."""
    dims = dims_of(spec, limit)
    if spec.counts == "products":
        least = spec.dimensions[0]
        while dims > least and 2**dims > 4096:
            dims -= 1
    return dims


def progressive_counts(spec: SamplerSpec, wanted: tuple[int, ...], dims: int) -> list[int]:
    """Those of the wanted counts at which a prefix is declared to be a set of its own."""
    if spec.progressive == "no":
        return []
    base = None if spec.progressive == "every-count" else int(spec.progressive.rpartition("-")[2])
    return [
        count
        for count in sorted(set(wanted))
        if allows(spec.counts, count, dims)
        and count <= spec.largest_index + 1
        and (base is None or is_power(count, base))
    ]
