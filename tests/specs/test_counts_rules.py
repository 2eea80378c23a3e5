import itertools
import math

import pytest

from samplekit._errors import UsageError
from samplekit._specs import SamplerSpec
from samplekit._specs.counts import allows, check_count, describe, fibonacci_numbers, nearest_above, nearest_below

RULES = ("any", "products", "products-in-2", "products-in-3", "squares", "prime-squares", "prime-cubes", "fibonacci",
         "powers-of-2", "powers-of-3", "exactly-100")  # fmt: skip


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("dims", [1, 2, 3])
def test_the_nearest_are_what_a_search_finds(rule, dims):
    allowed = [n for n in range(1, 3000) if allows(rule, n, dims)]
    for count in (1, 2, 3, 4, 5, 8, 9, 90, 97, 99, 100, 101, 500, 610, 1331):
        assert nearest_below(rule, count, dims) == max((n for n in allowed if n < count), default=None)
        assert nearest_above(rule, count, dims) == min((n for n in allowed if n > count), default=None)


def test_fibonacci_numbers():
    assert fibonacci_numbers(0) == (1, 1)
    assert fibonacci_numbers(10) == (1, 1, 2, 3, 5, 8, 13)
    assert fibonacci_numbers(13) == (1, 1, 2, 3, 5, 8, 13, 21)
    assert nearest_below("fibonacci", 10**18, 2) == 679891637638612258
    assert nearest_above("fibonacci", 10**18, 2) == 1100087778366101931


@pytest.mark.parametrize("rule", ["squares", "prime-squares", "prime-cubes", "fibonacci", "powers-of-2", "exactly-7"])
def test_large_counts_are_computed_not_searched(rule):
    check = [nearest_below(rule, 2**40 + 1, 2), nearest_above(rule, 2**40 + 1, 2)]
    assert all(n is None or allows(rule, n, 2) for n in check)


@pytest.mark.parametrize(
    ("rule", "count", "message"),
    [
        ("fibonacci", 100, "x makes Fibonacci numbers, not 100: the nearest are 89 and 144"),
        ("exactly-100", 64, "x makes exactly 100 points, not 64"),
        ("exactly-100", 128, "x makes exactly 100 points, not 128"),
        ("prime-squares", 1, "x makes squares of primes, not 1: the nearest is 4"),
        ("products-in-3", 97, "x makes products of 3 near-equal sides (a grid), not 97: the nearest are 96 and 100"),
        ("any", 0, "count 0: expected at least 1"),
    ],
)
def test_errors_name_what_is_possible(rule, count, message):
    with pytest.raises(UsageError) as error:
        check_count("x", rule, count, 2)
    assert str(error.value) == message


@pytest.mark.parametrize("rule", RULES)
def test_declarations_take_every_rule_and_it_has_words(rule):
    assert SamplerSpec("x", "a:B", "", counts=rule).counts == rule
    assert describe(rule)


@pytest.mark.parametrize("rule", ["fibonacci-2", "exactly-0", "exactly", "products-in-0", "powers", ""])
def test_declarations_refuse_other_rules(rule):
    with pytest.raises(ValueError, match="unknown counts"):
        SamplerSpec("x", "a:B", "", counts=rule)


@pytest.mark.parametrize(
    ("count", "dims"), [(2**31 - 1, 30), (2**31 - 1, 31), (2**31 - 1, 5000), (2**20 - 1, 10), (10**9 + 7, 15)]
)
def test_the_nearest_grids_of_many_dimensions_are_found_at_once(count, dims):
    """Against all products of sides from s to 2 s, for every s that can matter; sides of 1 add nothing."""
    most = min(dims, 32)
    root = int(count ** (1 / most))
    products = {
        math.prod(sides)
        for s in range(max(root // 2, 1), root + 2)
        for sides in itertools.combinations_with_replacement(range(s, 2 * s + 1), most)
    }
    assert nearest_below("products", count, dims) == max(n for n in products if n < count)
    assert nearest_above("products", count, dims) == min(n for n in products if n > count)
