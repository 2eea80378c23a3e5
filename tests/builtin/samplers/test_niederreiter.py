"""Niederreiter's sequence against its definition by Laurent series."""

import numpy as np
import pytest

import samplekit
from samplekit._builtin.samplers.niederreiter import irreducible_polynomials


def times(a, b):
    return [sum(a[i] * b[k - i] for i in range(len(a)) if 0 <= k - i < len(b)) % 2 for k in range(len(a) + len(b) - 1)]


def laurent(u, denominator, terms):
    """Coefficients of x^-1, x^-2, ... of x^u / denominator, by long division; polynomials are lists, lowest first."""
    degree = len(denominator) - 1
    remainder = [int(k == u) for k in range(degree)]
    coefficients = []
    for _ in range(terms):
        remainder = [0, *remainder]
        leading = remainder.pop()
        coefficients.append(leading)
        if leading:
            remainder = [(r + d) % 2 for r, d in zip(remainder, denominator, strict=False)]
    return coefficients


def coordinate(index, polynomial, digits=20):
    bits = [index >> k & 1 for k in range(20)]
    degree = len(polynomial) - 1
    value, power = 0, [1]
    for digit in range(digits):
        if digit % degree == 0:
            power = times(power, polynomial)
        series = laurent(digit % degree, power, 20)
        value = 2 * value + sum(a * b for a, b in zip(series, bits, strict=True)) % 2
    return value / 2**digits


def test_points_are_those_of_the_definition():
    points = samplekit.points("niederreiter", 200, 12)[0]
    for dimension, word in enumerate(irreducible_polynomials(12)):
        polynomial = [word >> k & 1 for k in range(word.bit_length())]
        expected = np.array([coordinate(index, polynomial) for index in range(200)])
        assert np.abs(points[:, dimension] - expected).max() < 2**-20


def test_polynomials_have_no_factors():
    words = irreducible_polynomials(41)
    assert words[:8] == (2, 3, 7, 11, 13, 19, 25, 31)
    products = set()
    for a in range(2, 128):
        for b in range(2, 128):
            word = 0
            for k in range(7):
                word ^= (a << k) * (b >> k & 1)
            products.add(word)
    assert list(words) == [word for word in range(2, 256) if word not in products][:41]


@pytest.mark.parametrize("dims", [1, 412])
def test_least_and_most_dimensions(dims):
    points = samplekit.points("niederreiter", 64, dims)[0]
    assert points.shape == (64, dims)
    assert (points[0] == 0.0).all()
