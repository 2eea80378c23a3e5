from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings, strategies

from samplekit.kernels import _double_double as dd

U = Fraction(1, 2**53)

unhurried = settings(deadline=None)  # The first call of each compiles it.

# Away from overflow, and products away from the subnormal range: where the transformations promise to be exact.
numbers = strategies.floats(-1e120, 1e120).filter(lambda x: x == 0 or abs(x) > 1e-120)
scales = strategies.integers(-110, -50)


def exact(pair):
    return Fraction(float(pair[0])) + Fraction(float(pair[1]))


def double_double(high, ratio, exponent):
    """A double-double whose low part is far below, just below, or exactly half an ulp of the high one."""
    return dd.quick_two_sum(high, high * ratio * 2.0**exponent)


doubles = strategies.builds(double_double, numbers, strategies.floats(-1, 1), scales)


@unhurried
@given(numbers, numbers)
def test_two_sum_is_exact(a, b):
    pair = dd.two_sum(a, b)
    assert pair[0] == a + b
    assert exact(pair) == Fraction(a) + Fraction(b)


@unhurried
@given(numbers, numbers)
def test_two_difference_is_exact(a, b):
    pair = dd.two_difference(a, b)
    assert pair[0] == a - b
    assert exact(pair) == Fraction(a) - Fraction(b)


@unhurried
@given(numbers, numbers)
def test_quick_two_sum_is_exact_for_ordered_numbers(a, b):
    a, b = (a, b) if abs(a) >= abs(b) else (b, a)
    assert exact(dd.quick_two_sum(a, b)) == Fraction(a) + Fraction(b)
    assert exact(dd.quick_two_sum(0.0, b)) == Fraction(b)


@unhurried
@given(numbers, numbers)
def test_two_product_is_exact(a, b):
    pair = dd.two_product(a, b)
    assert pair[0] == a * b
    assert exact(pair) == Fraction(a) * Fraction(b)


@unhurried
@given(doubles, doubles)
def test_add_within_its_bound(a, b):
    true = exact(a) + exact(b)
    assert abs(exact(dd.dd_add(*a, *b)) - true) <= (3 * U**2 + 13 * U**3) * abs(true)


@unhurried
@given(doubles, strategies.integers(-3, 3))
def test_add_keeps_its_digits_when_it_cancels(a, ulps):
    b = (-a[0] * (1 + ulps * 2.0**-52), a[1])
    true = exact(a) + exact(b)
    assert abs(exact(dd.dd_add(*a, *b)) - true) <= (3 * U**2 + 13 * U**3) * abs(true)


@unhurried
@given(doubles, numbers)
def test_scale_within_its_bound(a, factor):
    true = exact(a) * Fraction(factor)
    assert abs(exact(dd.dd_scale(*a, factor)) - true) <= 2 * U**2 * abs(true)


@unhurried
@given(doubles, doubles)
def test_multiply_within_its_bound(a, b):
    true = exact(a) * exact(b)
    assert abs(exact(dd.dd_multiply(*a, *b)) - true) <= 5 * U**2 * abs(true)


@pytest.mark.parametrize("count", [0, 1, 2, 3, 8, 14, 40])
def test_expansion_sum_keeps_its_digits_however_much_cancels(count):
    random = np.random.default_rng(count)
    for trial in range(200):
        terms = random.standard_normal(count) * 2.0 ** random.integers(-200, 200, count)
        if trial % 2:  # All but the last bits cancel.
            half = count // 2
            terms[half : 2 * half] = -terms[:half] * (1 + 2.0**-52 * random.integers(-1, 2, half))
            random.shuffle(terms)
        true = sum((Fraction(float(term)) for term in terms), Fraction(0))
        assert abs(Fraction(float(dd.expansion_sum(terms.copy(), count))) - true) <= 2 * U * abs(true)


def test_expansion_sum_leaves_the_terms_past_the_count():
    terms = np.array([1e100, 1.0, -1e100, 7.0])
    assert dd.expansion_sum(terms, 3) == 1.0
    assert terms[3] == 7.0
