"""Every rule of counts against brute force from its definition, which knows nothing of how the rules compute."""

import itertools
import math

import pytest

from samplekit._errors import CountError
from samplekit._specs.counts import (
    AnyCount,
    Exactly,
    FibonacciNumbers,
    Powers,
    PowersOf,
    PrimePowers,
    Products,
    grid_sides,
)

RULES = [
    (AnyCount(), 2),
    (Products(), 1),
    (Products(), 2),
    (Products(), 3),
    (Products(), 5),
    (Products(2), 2),
    (Products(2), 7),
    (Powers(2), 2),
    (PrimePowers(2), 2),
    (PrimePowers(3), 3),
    (PowersOf(2), 2),
    (PowersOf(3), 2),
    (PowersOf(10), 2),
    (Products(3), 2),
    (FibonacciNumbers(), 2),
    (Powers(3), 2),
    (PrimePowers(4), 2),
    (Exactly(100), 2),
]


def best_sides(count, dims):
    """All ways to write the count as a product of sides, longest first, whose ratio of longest to shortest is least."""
    found = [
        sides
        for sides in itertools.combinations_with_replacement([d for d in range(count, 0, -1) if count % d == 0], dims)
        if math.prod(sides) == count and sides[0] <= 2 * sides[-1]
    ]
    return {sides for sides in found if sides[0] / sides[-1] == min(s[0] / s[-1] for s in found)}


PRIMES = [n for n in range(2, 100) if all(n % d for d in range(2, n))]
FIBONACCI = {1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233, 377, 610, 987, 1597, 2584, 4181, 6765}


def is_allowed(rule, count, dims):
    """Brute force: lists of all, up to 10000."""
    if count < 1:
        return False
    match rule:
        case AnyCount():
            return True
        case Products(dims=block):
            return bool(best_sides(count, block or dims))
        case PrimePowers(degree=degree):
            return count in {n**degree for n in PRIMES}
        case Powers(degree=degree):
            return count in {n**degree for n in range(101)}
        case PowersOf(base=base):
            return count in {base**k for k in range(14)}
        case FibonacciNumbers():
            return count in FIBONACCI
        case Exactly(count=only):
            return count == only


@pytest.mark.parametrize("dims", [1, 2, 3, 4, 5])
def test_sides_are_the_nearest_to_a_cube(dims):
    for count in range(1, 301):
        sides, best = grid_sides(count, dims), best_sides(count, dims)
        assert (sides in best) if best else sides is None, (count, sides, best)


@pytest.mark.parametrize(
    ("count", "dims", "sides"),
    [
        (96, 2, (12, 8)),
        (97, 2, None),
        (2, 2, (2, 1)),
        (3, 2, None),
        (1, 6, (1, 1, 1, 1, 1, 1)),
        (64, 3, (4, 4, 4)),
        (2**31, 2, (2**16, 2**15)),
        (2**31 - 1, 2, None),
        ((2**16 - 1) * (2**16 + 1), 2, (2**16 + 1, 2**16 - 1)),
        (1000003**2, 2, (1000003, 1000003)),
        (2**31 - 1, 1, (2**31 - 1,)),
        (32, 5, (2, 2, 2, 2, 2)),
        (2**12, 20, (2,) * 12 + (1,) * 8),
    ],
)
def test_sides(count, dims, sides):
    assert grid_sides(count, dims) == sides


@pytest.mark.parametrize(("rule", "dims"), RULES, ids=str)
def test_rules_and_nearest_counts_agree_with_a_list_of_all(rule, dims):
    allowed = [n for n in range(1, 700) if is_allowed(rule, n, dims)]
    for count in range(-2, 400):
        assert rule.allows(count, dims) == (count in allowed), count
        below = [n for n in allowed if n < count]
        assert rule.below(count, dims) == (below[-1] if below else None), count
        above = [n for n in allowed if n > max(count, 0)]
        if above:  # the list may end first
            assert rule.above(count, dims) == above[0], count


@pytest.mark.parametrize(
    "rule",
    [AnyCount(), Products(), Products(2), Powers(2), PrimePowers(2), PrimePowers(3), PowersOf(2), PowersOf(3)],
    ids=str,
)
def test_the_same_counts_are_allowed(rule):
    for dims in (1, 2, 3, 4):
        for count in [*range(700), 1024, 2187, 4096, 6561, 9409]:
            assert rule.allows(count, dims) == is_allowed(rule, count, dims), (dims, count)


@pytest.mark.parametrize(("rule", "dims"), RULES, ids=str)
def test_nearest_and_rising_follow_from_above_and_below(rule, dims):
    for count in (1, 4, 97, 100, 128):
        if rule.allows(count, dims):
            assert rule.nearest(count, dims) == [count]
        else:
            near = [rule.below(count, dims), rule.above(count, dims)]
            assert rule.nearest(count, dims) == [n for n in near if n is not None]
    first = list(itertools.islice(rule.rising(50, dims), 3))
    assert first == sorted(first)
    assert all(n > 50 and rule.allows(n, dims) for n in first)
    # None is left out.
    assert not any(rule.allows(n, dims) for n in range(51, first[-1]) if n not in first)


@pytest.mark.parametrize(
    ("rule", "count", "below", "above"),
    [
        (Powers(2), 10**18 + 1, 10**18, (10**9 + 1) ** 2),
        (Powers(2), (2**31) ** 2, (2**31 - 1) ** 2, (2**31 + 1) ** 2),
        (PrimePowers(2), 1000003**2 + 1, 1000003**2, 1000033**2),
        (PrimePowers(3), 997**3, 991**3, 1009**3),
        (PowersOf(2), 2**40, 2**39, 2**41),
        (PowersOf(2), 2**62 - 1, 2**61, 2**62),
        (PowersOf(3), 3**30, 3**29, 3**31),
        (PowersOf(7), 7**15 + 1, 7**15, 7**16),
        (PowersOf(1000), 10**12 - 1, 10**9, 10**12),
    ],
)
def test_nearest_of_large_counts(rule, count, below, above):
    assert rule.below(count, 2) == below
    assert rule.above(count, 2) == above


def test_nearest_grids_of_large_counts():
    for count in (10**6 + 3, 2**31 - 1, 2**32 - 5, 10**9 + 7):
        for dims in (2, 3, 4):
            below, above = Products().below(count, dims), Products().above(count, dims)
            assert below < count < above
            assert grid_sides(count, dims) is None
            for near in (below, above):
                sides = grid_sides(near, dims)
                assert math.prod(sides) == near
                assert sides[0] <= 2 * sides[-1]
            assert not any(Products().allows(n, dims) for n in (below + 1, above - 1) if n != count)


@pytest.mark.parametrize(
    ("rule", "dims", "count", "message"),
    [
        (Products(), 2, 97, r"x makes products .* in 2 dimensions, not 97: the nearest are 96 and 98"),
        (Products(2), 5, 3, r"products of two .* not 3: the nearest are 2 and 4"),
        (Powers(2), 2, 15, r"squares, not 15: the nearest are 9 and 16"),
        (PrimePowers(2), 2, 3, r"squares of primes, not 3: the nearest is 4"),
        (PrimePowers(3), 2, 100, r"cubes of primes, not 100: the nearest are 27 and 125"),
        (PowersOf(2), 2, 1000, r"powers of 2, not 1000: the nearest are 512 and 1024"),
        (AnyCount(), 2, 0, r"x makes any number, not 0: the nearest is 1"),
    ],
)
def test_the_error_names_the_nearest(rule, dims, count, message):
    with pytest.raises(CountError, match=message) as error:
        rule.check("x", count, dims)
    assert error.value.count == count
    assert (error.value.below, error.value.above) == (rule.below(count, dims), rule.above(count, dims))


def test_allowed_counts_pass():
    for rule, dims in RULES:
        for count in range(1, 200):
            if is_allowed(rule, count, dims):
                rule.check("x", count, dims)


def test_every_rule_has_words():
    for rule, _ in RULES:
        assert "-" not in rule.describe().replace("near-equal", "")
        assert rule.short()
