"""What all lattices share: one uniform shift a realisation, and points that differ by the lattice alone."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from scipy import stats

import samplekit

LATTICES = [("r2", 16), ("rank1", 16), ("fibonacci", 13)]


def set_of(text, count, dims=2, seed=0, realizations=1):
    return samplekit.points(text, count, dims, realizations=realizations, seed=seed)


@pytest.mark.parametrize("dims", [1, 2, 3])
def test_a_million_points_of_r2_are_distinct(dims):
    points = set_of("r2", 10**6, dims)[0]
    for d in range(dims):
        assert np.unique(points[:, d]).size == 10**6


@pytest.mark.parametrize("start", [0, 10**6, 2**31, 2**32 - 100])
def test_r2_is_its_irrational_steps_to_the_last_digits(start):
    """In 60 decimals: the step's own rounding, 2^-64, grows with the index to 2^-32 at the last one."""
    points = samplekit.sampler("r2").points(2**32, 3, start=start, stop=start + 100)[0]
    first = samplekit.sampler("r2").points(2**32, 3, start=0, stop=1)[0, 0]
    with localcontext() as context:
        context.prec = 60
        phi = Decimal(1)
        for _ in range(300):
            phi = (1 + phi) ** (Decimal(1) / 4)
        assert abs(phi**4 - phi - 1) < Decimal("1e-55")
        for d in range(3):
            step = phi ** -(d + 1)
            for i in (0, 1, 50, 99):
                difference = Decimal(points[i, d]) - Decimal(first[d]) - (start + i) * step
                off = abs(difference - difference.to_integral_value())
                assert off <= Decimal(2) ** -52 + (start + i) * Decimal(2) ** -64


@pytest.mark.parametrize(("text", "count"), LATTICES)
def test_points_of_two_realisations_differ_by_one_vector(text, count):
    one, other, another_seed = *set_of(text, count, realizations=2), set_of(text, count, seed=1)[0]
    for moved in (other, another_seed):
        vectors = moved - one
        vectors = vectors - vectors[0]
        assert np.abs(vectors - np.rint(vectors)).max() < 2.0**-50
        assert np.abs(moved - one).min() > 1e-6


@pytest.mark.parametrize("index", [0, 7])
@pytest.mark.parametrize(("text", "count"), LATTICES)
def test_every_point_is_uniform(text, count, index):
    """Chi-square on 31 x 31 cells over 61 realisations a cell: false alarms 1e-4 each."""
    sampler = samplekit.sampler(text)
    points = sampler.points(count, 2, realizations=61 * 961, seed=4, start=index, stop=index + 1)[:, 0]
    cells = np.floor(points * 31).astype(int)
    assert stats.chisquare(np.bincount(cells[:, 0] * 31 + cells[:, 1], minlength=961)).pvalue > 1e-4


@pytest.mark.parametrize(("text", "count"), LATTICES)
def test_estimates_are_unbiased(text, count):
    """x y and a triangle over 4000 realisations, within 4.5 standard errors: false alarms 2e-5 each."""
    points = set_of(text, count, seed=5, realizations=4000)
    for values, integral in ((points.prod(axis=2), 0.25), ((points.sum(axis=2) < 0.75).astype(float), 0.28125)):
        estimates = values.mean(axis=1)
        assert abs(estimates.mean() - integral) < 4.5 * estimates.std() / np.sqrt(4000)


@pytest.mark.parametrize(("text", "count"), LATTICES)
def test_order_and_parts_do_not_matter(text, count):
    sampler = samplekit.sampler(text)
    x, y = np.array([0, 3, 2**32 - 1, 70000]), np.array([5, 0, 2**31 - 1, 2**32 - 1])
    whole, reverse = np.empty((2, 4, 2, count))
    sampler.fill(whole, samplekit.Realizations.of_pixels(x, y, 6), count, 0)
    sampler.fill(reverse, samplekit.Realizations.of_pixels(x[::-1], y[::-1], 6), count, 0)
    assert np.array_equal(whole, reverse[::-1])
    part = np.empty((1, 2, count - 4))
    sampler.fill(part, samplekit.Realizations.of_pixels(x[1:2], y[1:2], 6), count, 3)
    assert np.array_equal(part[0], whole[1, :, 3:-1])
    assert whole.min() >= 0.0
    assert whole.max() < 1.0
