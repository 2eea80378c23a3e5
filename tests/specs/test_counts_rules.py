import itertools
import math
import pickle

import pytest

from samplekit._errors import CountError, UsageError
from samplekit._specs import SamplerSpec
from samplekit._specs.counts import (
    AnyCount,
    Exactly,
    FibonacciNumbers,
    Powers,
    PowersOf,
    PrimePowers,
    Products,
)

RULES = (AnyCount(), Products(), Products(2), Products(3), Powers(2), PrimePowers(2), PrimePowers(3),
         FibonacciNumbers(), PowersOf(2), PowersOf(3), Exactly(100))  # fmt: skip


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("dims", [1, 2, 3])
def test_the_nearest_are_what_a_search_finds(rule, dims):
    allowed = [n for n in range(1, 3000) if rule.allows(n, dims)]
    for count in (1, 2, 3, 4, 5, 8, 9, 90, 97, 99, 100, 101, 500, 610, 1331):
        assert rule.below(count, dims) == max((n for n in allowed if n < count), default=None)
        assert rule.above(count, dims) == min((n for n in allowed if n > count), default=None)


def test_fibonacci_numbers():
    assert list(itertools.islice(FibonacciNumbers().rising(0, 2), 8)) == [1, 2, 3, 5, 8, 13, 21, 34]
    assert FibonacciNumbers().below(10**18, 2) == 679891637638612258
    assert FibonacciNumbers().above(10**18, 2) == 1100087778366101931


@pytest.mark.parametrize(
    "rule", [Powers(2), PrimePowers(2), PrimePowers(3), FibonacciNumbers(), PowersOf(2), Exactly(7)]
)
def test_large_counts_are_computed_not_searched(rule):
    check = [rule.below(2**40 + 1, 2), rule.above(2**40 + 1, 2)]
    assert all(n is None or rule.allows(n, 2) for n in check)


@pytest.mark.parametrize(
    ("rule", "count", "message"),
    [
        (FibonacciNumbers(), 100, "x makes Fibonacci numbers, not 100: the nearest are 89 and 144"),
        (Exactly(100), 64, "x makes exactly 100 points, not 64: the nearest is 100"),
        (Exactly(100), 128, "x makes exactly 100 points, not 128: the nearest is 100"),
        (PrimePowers(2), 1, "x makes squares of primes, not 1: the nearest is 4"),
        (Products(3), 97, "x makes products of 3 near-equal sides (a grid), not 97: the nearest are 96 and 100"),
        (AnyCount(), 0, "x makes any number, not 0: the nearest is 1"),
    ],
)
def test_errors_name_what_is_possible(rule, count, message):
    with pytest.raises(UsageError) as error:
        rule.check("x", count, 2)
    assert str(error.value) == message


def test_the_error_survives_pickling():
    with pytest.raises(CountError) as error:
        PowersOf(2).check("x", 100, 2)
    copy = pickle.loads(pickle.dumps(error.value))
    assert (str(copy), copy.count, copy.below, copy.above) == (str(error.value), 100, 64, 128)


@pytest.mark.parametrize("rule", RULES)
def test_declarations_take_every_rule_and_it_has_words(rule):
    assert SamplerSpec("x", "a:B", "", counts=rule).counts == rule
    assert rule.describe()


@pytest.mark.parametrize("rule", ["any", "powers-of-2", "", None, 2, PowersOf, SamplerSpec])
def test_declarations_refuse_other_rules(rule):
    with pytest.raises(ValueError, match=r"^x: counts must be an object such as AnyCount\(\) or PowersOf\(2\), not "):
        SamplerSpec("x", "a:B", "", counts=rule)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Exactly(0),
        lambda: Exactly("1"),
        lambda: Products(0),
        lambda: Products(2.0),
        lambda: PowersOf(1),
        lambda: PowersOf(2.5),
        lambda: PowersOf(True),
        lambda: Powers(1),
        lambda: PrimePowers(None),
    ],
)
def test_rules_refuse_numbers_that_make_no_sense(make):
    with pytest.raises(ValueError, match=r"^(Exactly|Products|PowersOf|Powers|PrimePowers): \w+ must be .* not "):
        make()


@pytest.mark.parametrize(
    ("rule", "word"),
    [
        (AnyCount(), "any"),
        (Products(), "products"),
        (Products(2), "products-in-2"),
        (Powers(2), "squares"),
        (PrimePowers(2), "prime-squares"),
        (PrimePowers(3), "prime-cubes"),
        (PowersOf(2), "powers-of-2"),
        (FibonacciNumbers(), "fibonacci"),
        (Exactly(12), "exactly-12"),
    ],
)
def test_rules_have_the_words_of_json(rule, word):
    assert str(rule) == word


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
    assert Products().below(count, dims) == max(n for n in products if n < count)
    assert Products().above(count, dims) == min(n for n in products if n > count)
