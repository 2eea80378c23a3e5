"""Sums and means of estimates against exact ones: blocks, pairs of blocks, and data made to go wrong."""

import math
from fractions import Fraction

import numpy as np
import pytest

import samplekit
from samplekit._integrate.loop import integrate, mean_of_constant, unit_square
from samplekit._stability.extended import accumulate, distances
from samplekit.kernels._sums import BLOCK, PairwiseSum, row_sums

ROUNDOFF = Fraction(1, 2**53)
IN_A_BLOCK = 27
"""Roundings of a value before its block's sum is done: 8 in a run, 16 runs, 3 for the lanes."""


def summed(values):
    """The sum as estimates take it: in blocks, and their sums in pairs."""
    total = PairwiseSum()
    for start in range(0, values.size, BLOCK):
        block = np.empty(1)
        row_sums(values[None, start : start + BLOCK].copy(), block)
        total.add(block)
    return float(total.total()[0])


def bound(values):
    """What the sum may be off, as a fraction: roundings times the sum of magnitudes."""
    levels = math.ceil(math.log2(max(1, math.ceil(values.size / BLOCK))))
    magnitudes = sum(map(Fraction, np.abs(values).tolist()))
    return (IN_A_BLOCK + levels) * ROUNDOFF * magnitudes * (1 + Fraction(1, 2**40))


def random(count, seed=0):
    return np.random.default_rng(seed).random(count)


DATA = {
    "uniform": random(5000),
    "equal": np.full(5000, 1e-30),
    "all-equal-to-a-third": np.full(4096, 1 / 3),
    "cancelling": np.concatenate([random(3000), -random(3000)[::-1]]),
    "one-large-then-small": np.concatenate([[1e8], random(4999)]),
    "large-and-its-negative-around-small": np.concatenate([[1e16], random(4998), [-1e16]]),
    "descending": np.sort(10.0 ** (300 * random(4096) - 300))[::-1].copy(),
    "ascending": np.sort(10.0 ** (300 * random(4096) - 300)),
    "denormal": random(4096) * 2.0**-1030,
    "smallest": np.full(4095, 2.0**-1074),
    "as-large-as-may-be": np.full(2, 8e307),
    "1e300-twice-and-back": np.array([1e300, 1e300, -1e300, -1e300, 1.0]),
    "alternating": np.where(np.arange(5000) % 2 == 0, 1e12, -1e12) + random(5000),
    "harmonic": 1.0 / np.arange(1.0, 5001.0),
}


@pytest.mark.parametrize("values", DATA.values(), ids=DATA.keys())
@pytest.mark.parametrize("count", [1, 7, 8, 63, 65, 1000, 1023, 1024, 1025, 2047, 3000])
def test_sums_are_within_their_bound(values, count):
    values = values[:count]
    exact = sum(map(Fraction, values.tolist()))
    assert abs(Fraction(summed(values)) - exact) <= bound(values)


@pytest.mark.parametrize("name", ["uniform", "equal", "all-equal-to-a-third", "one-large-then-small", "harmonic"])
def test_sums_of_one_sign_lose_less_than_a_digit(name):
    values = DATA[name]
    assert abs(Fraction(summed(values)) - sum(map(Fraction, values.tolist()))) <= 10 * ROUNDOFF * Fraction(
        math.fsum(values)
    )


@pytest.mark.parametrize("values", DATA.values(), ids=DATA.keys())
def test_sums_in_extended_precision_are_exactly_rounded(values):
    """Where the sum is not 2^-50 of its terms: fsum rounds once, double-doubles keep twice the digits."""
    totals = np.zeros((1, 2))
    for start in range(0, values.size, BLOCK):
        accumulate(values[None, start : start + BLOCK].copy(), totals)
    exact = sum(map(Fraction, values.tolist()))
    magnitudes = sum(map(Fraction, np.abs(values).tolist()))
    assert abs(Fraction(float(totals[0, 0])) - exact) <= ROUNDOFF * abs(exact) + magnitudes * Fraction(1, 2**90)
    # The distance of a mean from them is not rounded away either.
    mean = float(exact / values.size)
    apart = float(distances(np.array([mean]), totals, values.size)[0])
    true = Fraction(mean) - exact / values.size
    tolerance = abs(true) * Fraction(1, 2**50) + magnitudes * Fraction(1, 2**88) + Fraction(1, 2**1074)
    assert abs(Fraction(apart) - true) <= tolerance


def test_blocks_are_added_in_the_one_order_whatever_the_tile():
    scene, sampler = samplekit.scene("gaussian"), samplekit.sampler("random")
    whole = samplekit.estimate(scene, sampler, 5000, realizations=7, seed=3)
    for rows in (1, 2, 5):
        trials, tile_bytes = sampler.trials(0, 7, 3, scene.blocks), rows * 8 * 2 * BLOCK
        (means,) = integrate(scene, sampler, (5000,), trials, unit_square(7), tile_bytes=tile_bytes)
        assert np.array_equal(means, whole)


@pytest.mark.parametrize("count", [1, 2, 3, 1000, 1025, 4097, 2**20 - 1, 2**20 + 1])
@pytest.mark.parametrize("value", [1.0, 1 / 3, 1e-30, 1e300])
def test_the_mean_of_a_constant_is_that_constant_within_a_digit(count, value):
    """As pixels that are left out have it."""
    mean = mean_of_constant(value, count)
    if value * count < 1.7e308:
        assert abs(Fraction(mean) - Fraction(value)) <= 10 * ROUNDOFF * Fraction(value)
    else:
        assert mean == math.inf


@pytest.mark.parametrize("count", [1, 16, 1000, 65537])
@pytest.mark.parametrize("text", ["gaussian", "power:a=0.4", "oscillating:family=corner-peak,d=5", "step:width=1e-3"])
def test_estimates_equal_exact_means_of_the_same_values(text, count):
    """All values of a set, one by one, summed as rational numbers."""
    scene, sampler = samplekit.scene(text), samplekit.sampler("random")
    trials = sampler.trials(0, 1, 9, scene.blocks)
    blocks = []
    integrate(
        scene,
        sampler,
        (count,),
        trials,
        unit_square(1),
        observe=lambda tile, boxes: blocks.append(scene.values(tile, boxes)[0]),
    )
    values = np.concatenate(blocks)
    exact = Fraction(math.fsum(values)) / count
    estimate = Fraction(float(samplekit.estimate(scene, sampler, count, seed=9)[0]))
    assert values.size == count
    assert abs(estimate - exact) <= 10 * ROUNDOFF * exact
