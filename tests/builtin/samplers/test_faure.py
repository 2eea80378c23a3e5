from fractions import Fraction
from math import comb

import numpy as np
import pytest

import samplekit
from samplekit import UsageError


def faure(index, base, dimension):
    """Faure's definition in rational numbers."""
    digits = []
    while index:
        index, digit = divmod(index, base)
        digits.append(digit)
    sums = [
        sum(comb(r, j) * dimension ** (r - j) * digits[r] for r in range(j, len(digits))) for j in range(len(digits))
    ]
    return float(sum((Fraction(y % base, base ** (j + 1)) for j, y in enumerate(sums)), Fraction(0)))


@pytest.mark.parametrize(("base", "dims"), [(2, 2), (3, 3), (5, 5), (31, 31), (1021, 4)])
def test_points_are_those_of_the_definition(base, dims):
    sampler = samplekit.sampler(f"faure:base={base}")
    for start in (0, base - 1, base**2, 3000, 2**31 - 5, 2**40 - 10):
        points = sampler.points(2**40, dims, start=start, stop=start + 10)[0].tolist()
        assert points == [[faure(i, base, d) for d in range(dims)] for i in range(start, start + 10)]


def test_the_first_dimension_is_haltons():
    assert np.array_equal(
        samplekit.points("faure:base=3", 3000, 1)[0, :, 0], samplekit.points("van-der-corput:base=3", 3000, 1)[0, :, 0]
    )


def test_in_base_2_it_is_sobols():
    assert np.array_equal(samplekit.points("faure:base=2", 4096), samplekit.points("sobol", 4096))


def test_a_base_that_is_no_prime_is_refused():
    with pytest.raises(UsageError, match="base=9: expected a prime: the nearest are 7 and 11"):
        samplekit.sampler("faure:base=9")
    with pytest.raises(UsageError, match="faure makes points in 1 to 5 dimensions, not 6"):
        samplekit.points("faure", 25, 6)
