from fractions import Fraction

import numpy as np
import pytest

from samplekit.kernels._digits import primes
from samplekit.kernels._mirrored_digits import PLAIN, fill_mirrored

BASES = sorted({*range(2, 1001), *primes(1024)})


def mirrored(index, base):
    """The radical inverse as an exact fraction."""
    numerator, denominator = 0, 1
    while index:
        index, digit = divmod(index, base)
        numerator, denominator = numerator * base + digit, denominator * base
    return Fraction(numerator, denominator)


def values(base, start, count):
    out = np.empty((1, 1, count))
    fill_mirrored(out, np.zeros(1, np.uint64), np.array([base]), start, PLAIN)
    return out[0, 0].tolist()


def exact(base, start, count):
    return [float(mirrored(index, base)) for index in range(start, start + count)]


def test_primes():
    sieve = [n for n in range(2, 8162) if all(n % divisor for divisor in range(2, int(n**0.5) + 1))]
    assert list(primes(1024)) == sieve
    for count in (0, 1, 2, 5, 6, 7, 168):
        assert list(primes(count)) == sieve[:count]


@pytest.mark.parametrize("base", [2, 3, 4, 5, 7, 10, 29, 31, 1000, 7919, 8161])
def test_values_are_the_fractions_correctly_rounded(base):
    for start in (0, 1, base - 1, base**2 - 2, base**3 - 3, 2**31 - 50, 2**32 - 50, 2**40 - 100):
        assert values(base, start, 100) == exact(base, start, 100)


def test_every_base_near_its_carries():
    for base in BASES:
        for start in (0, base - 2, base * base - 2, 2**40 - 4):
            assert values(base, start, 4) == exact(base, start, 4), base


def test_digits_that_are_all_the_largest_stay_below_one():
    for base in BASES:
        power = base
        while power * base <= 2**53 // base:
            power *= base
            [value] = values(base, power - 1, 1)
            assert value == float(1 - Fraction(1, power)) < 1.0


def test_any_slice_is_the_same_numbers():
    whole = values(3, 0, 1000)
    for start, stop in ((0, 1), (1, 28), (26, 29), (242, 245), (700, 1000)):
        assert values(3, start, stop - start) == whole[start:stop]


def test_the_largest_index():
    for base in (2, 3, 5, 8161):
        assert values(base, 2**40 - 1, 1) == exact(base, 2**40 - 1, 1)
