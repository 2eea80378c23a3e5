import itertools
import math

import pytest

from samplekit._errors import UsageError
from samplekit._specs.counts import allows, check_count, describe, grid_sides, nearest_above, nearest_below

RULES = [
    ("any", 2),
    ("products", 1),
    ("products", 2),
    ("products", 3),
    ("products", 5),
    ("products-in-2", 2),
    ("products-in-2", 7),
    ("squares", 2),
    ("prime-squares", 2),
    ("prime-cubes", 3),
    ("powers-of-2", 2),
    ("powers-of-3", 2),
    ("powers-of-10", 2),
    ("products-in-3", 2),
    ("fibonacci", 2),
]


def best_sides(count, dims):
    """All ways to write the count as a product of sides, longest first, whose ratio of longest to shortest is least."""
    found = [
        sides
        for sides in itertools.combinations_with_replacement([d for d in range(count, 0, -1) if count % d == 0], dims)
        if math.prod(sides) == count and sides[0] <= 2 * sides[-1]
    ]
    return {sides for sides in found if sides[0] / sides[-1] == min(s[0] / s[-1] for s in found)}


def is_allowed(rule, count, dims):
    prime = [n for n in range(2, 60) if all(n % d for d in range(2, n))]
    if rule.startswith("products"):
        return bool(best_sides(count, dims if rule == "products" else int(rule[12:])))
    if rule.startswith("powers-of-"):
        return count in {int(rule[10:]) ** k for k in range(12)}
    return {
        "any": True,
        "fibonacci": count in {1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233, 377, 610, 987},
        "squares": count in {n * n for n in range(60)},
        "prime-squares": count in {n**2 for n in prime},
        "prime-cubes": count in {n**3 for n in prime},
    }[rule]


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


@pytest.mark.parametrize(("rule", "dims"), RULES)
def test_rules_and_nearest_counts_agree_with_a_list_of_all(rule, dims):
    allowed = [n for n in range(1, 700) if is_allowed(rule, n, dims)]
    for count in range(-2, 400):
        assert allows(rule, count, dims) == (count in allowed), count
        below = [n for n in allowed if n < count]
        assert nearest_below(rule, count, dims) == (below[-1] if below else None), count
        above = [n for n in allowed if n > max(count, 0)]
        if above:  # the list may end first
            assert nearest_above(rule, count, dims) == above[0], count


@pytest.mark.parametrize(
    ("rule", "count", "below", "above"),
    [
        ("squares", 10**18 + 1, 10**18, (10**9 + 1) ** 2),
        ("squares", (2**31) ** 2, (2**31 - 1) ** 2, (2**31 + 1) ** 2),
        ("prime-squares", 1000003**2 + 1, 1000003**2, 1000033**2),
        ("prime-cubes", 997**3, 991**3, 1009**3),
        ("powers-of-2", 2**40, 2**39, 2**41),
        ("powers-of-2", 2**62 - 1, 2**61, 2**62),
        ("powers-of-3", 3**30, 3**29, 3**31),
        ("powers-of-7", 7**15 + 1, 7**15, 7**16),
        ("powers-of-1000", 10**12 - 1, 10**9, 10**12),
    ],
)
def test_nearest_of_large_counts(rule, count, below, above):
    assert nearest_below(rule, count, 2) == below
    assert nearest_above(rule, count, 2) == above


def test_nearest_grids_of_large_counts():
    for count in (10**6 + 3, 2**31 - 1, 2**32 - 5, 10**9 + 7):
        for dims in (2, 3, 4):
            below, above = nearest_below("products", count, dims), nearest_above("products", count, dims)
            assert below < count < above
            assert grid_sides(count, dims) is None
            for near in (below, above):
                sides = grid_sides(near, dims)
                assert math.prod(sides) == near
                assert sides[0] <= 2 * sides[-1]
            assert not any(allows("products", n, dims) for n in (below + 1, above - 1) if n != count)


@pytest.mark.parametrize(
    ("rule", "dims", "count", "message"),
    [
        ("products", 2, 97, r"x makes products .* in 2 dimensions, not 97: the nearest are 96 and 98"),
        ("products-in-2", 5, 3, r"products of two .* not 3: the nearest are 2 and 4"),
        ("squares", 2, 15, r"squares, not 15: the nearest are 9 and 16"),
        ("prime-squares", 2, 3, r"squares of primes, not 3: the nearest is 4"),
        ("prime-cubes", 2, 100, r"cubes of primes, not 100: the nearest are 27 and 125"),
        ("powers-of-2", 2, 1000, r"powers of 2, not 1000: the nearest are 512 and 1024"),
        ("any", 2, 0, r"count 0: expected at least 1"),
    ],
)
def test_the_error_names_the_nearest(rule, dims, count, message):
    with pytest.raises(UsageError, match=message):
        check_count("x", rule, count, dims)


def test_allowed_counts_pass():
    for rule, dims in RULES:
        for count in range(1, 200):
            if is_allowed(rule, count, dims):
                check_count("x", rule, count, dims)


def test_every_rule_has_words():
    for rule, _ in RULES:
        assert "-" not in describe(rule).replace("near-equal", "")
