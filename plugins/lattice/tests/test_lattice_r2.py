from fractions import Fraction

import numpy as np
import pytest
from samplekit_lattice.r2 import golden_steps

import samplekit

# Far finer than a 64-bit fraction.
FINE = 2**200


def golden_ratio(dims):
    """Bounds of the root above 1 of x^(D+1) = x + 1, by bisection in rational numbers."""
    low, high = FINE, 2 * FINE
    while high - low > 1:
        middle = (low + high) // 2
        x = Fraction(middle, FINE)
        low, high = (middle, high) if x ** (dims + 1) < x + 1 else (low, middle)
    return Fraction(low, FINE), Fraction(high, FINE)


@pytest.mark.parametrize("dims", [1, 2, 3, 16, 40])
def test_steps_are_the_nearest_64_bit_fractions(dims):
    low, high = golden_ratio(dims)
    for power, step in enumerate(golden_steps(dims).tolist(), start=1):
        assert abs(step - 2**64 / high**power) <= Fraction(1, 2) + Fraction(1, 2**60)
        assert abs(step - 2**64 / low**power) <= Fraction(1, 2) + Fraction(1, 2**60)


def test_the_steps_that_roberts_gives():
    assert np.allclose(golden_steps(1) / 2**64, [0.6180339887498949], atol=1e-15)
    assert np.allclose(golden_steps(2) / 2**64, [0.7548776662466927, 0.5698402909980532], atol=1e-15)
    assert np.allclose(
        golden_steps(3) / 2**64, [0.8191725133961645, 0.6710436067037893, 0.5497004779019703], atol=1e-15
    )


@pytest.mark.parametrize("dims", [1, 2, 100, 5000])
def test_any_number_of_dimensions(dims):
    steps = golden_steps(dims)
    assert len(np.unique(steps)) == dims
    # phi^-(D+1) = 1 / (phi + 1).
    phi = 2**64 / float(steps[0])
    assert float(steps[-1]) * 2.0**-64 / phi == pytest.approx(1 / (phi + 1), rel=1e-12)
    assert samplekit.points("r2", count=3, dims=dims).shape == (1, 3, dims)


def test_points_are_multiples_of_the_steps_plus_a_shift():
    points = samplekit.points("r2", count=50, dims=3, realizations=100)
    words = (points * 2.0**53).astype(np.uint64) << np.uint64(11)
    expected = np.arange(50, dtype=np.uint64)[:, None] * golden_steps(3)
    differences = words - expected
    # The last 11 bits of a word are cut: all points of a set have the same shift to within them.
    spread = differences - differences[:, :1]
    assert (np.minimum(spread, -spread) < 2**12).all()
    assert len(np.unique(differences[:, 0])) == 300


@pytest.mark.parametrize("count", [1, 3, 100])
def test_prefixes_and_parts(count):
    whole = samplekit.points("r2", count=500, dims=3, seed=2)
    assert np.array_equal(samplekit.points("r2", count=count, dims=3, seed=2), whole[:, :count])
    assert np.array_equal(samplekit.sampler("r2").points(500, 3, seed=2, start=count, stop=400), whole[:, count:400])


def test_the_largest_index():
    sampler = samplekit.sampler("r2")
    last = sampler.points(2**32, 2, start=2**32 - 1, stop=2**32)
    first = sampler.points(1, 2)
    expected = (first + (2**32 - 1) * golden_steps(2).astype(object) % 2**64 / 2**64) % 1.0
    assert np.allclose(last.astype(float), expected.astype(float), atol=1e-14)
