"""Permutations as the Latin hypercube shows them: the cells of its points in one dimension."""

import itertools
import math

import numpy as np
import pytest
from scipy import stats

import samplekit
from samplekit.kernels._permutation import permutation_bits, permute, permute_in_lines, permute_range

LATIN = samplekit.sampler("latin-hypercube")


def permutations(count, realizations, seed=0, start=0, stop=None):
    points = LATIN.points(count, 1, realizations=realizations, seed=seed, start=start, stop=stop)[:, :, 0]
    return np.floor(points * count).astype(np.int64)


COUNTS = [1, 2, 3, 4, 5, 31, 32, 33, 1000, 1023, 1024, 1025, 1026, 2047, 2048, 2049, 2**16 - 1, 2**16, 2**16 + 1]


@pytest.mark.parametrize("count", COUNTS)
def test_every_element_once(count):
    found = np.sort(permutations(count, 5, seed=count), axis=1)
    assert np.array_equal(found, np.broadcast_to(np.arange(count), (5, count)))


def test_every_element_once_for_any_count():
    rng = np.random.default_rng(0)
    for count in [*range(1, 200), *rng.integers(1025, 5000, 100).tolist()]:
        assert np.array_equal(np.sort(permutations(count, 1)[0]), np.arange(count)), count


@pytest.mark.parametrize("count", [7, 1024, 1025, 3000])
def test_any_index_on_its_own(count):
    whole = permutations(count, 3, seed=9)
    for index in (0, 1, count // 2, count - 1):
        assert np.array_equal(permutations(count, 3, seed=9, start=index, stop=index + 1)[:, 0], whole[:, index])


def test_large_counts_by_parts():
    for count in (10**6 + 3, 2**31 + 11, 2**32):
        for start in (0, count // 2, count - 2000):
            cells = permutations(count, 2, start=start, stop=start + 2000)
            assert cells.min() >= 0
            assert cells.max() < count
            assert all(np.unique(row).size == 2000 for row in cells)
    assert np.unique(permutations(10**6 + 3, 1)).size == 10**6 + 3


@pytest.mark.parametrize(("count", "realizations"), [(2, 4000), (3, 12000), (4, 24000), (5, 60000)])
def test_all_permutations_are_equally_likely(count, realizations):
    """False alarms 1e-4 each; the seed is fixed."""
    found = permutations(count, realizations, seed=1)
    codes = found @ count ** np.arange(count)
    observed = [np.count_nonzero(codes == np.dot(p, count ** np.arange(count))) for p in all_orders(count)]
    assert sum(observed) == realizations
    assert stats.chisquare(observed).pvalue > 1e-4


def all_orders(count):
    return [np.array(order) for order in itertools.permutations(range(count))]


def pair_expectation(count, groups):
    """Probability that two distinct elements, drawn uniformly, fall into each pair of groups."""
    sizes = np.bincount(np.arange(count) * groups // count, minlength=groups).astype(float)
    return (np.outer(sizes, sizes) - np.diag(sizes)) / (count * (count - 1.0))


def pair_pvalue(first, second, count, groups):
    codes = (first * groups // count) * groups + second * groups // count
    expected = pair_expectation(count, groups).ravel()
    observed = np.bincount(codes, minlength=expected.size)
    possible = expected > 0
    assert not observed[~possible].any()
    return stats.chisquare(observed[possible], expected[possible] * first.size).pvalue


@pytest.mark.parametrize("count", [8, 13, 1000, 1024, 1025, 1500, 2048, 3000, 4096, 65537, 2**20])
def test_pairs_are_uniform(count):
    """Where index 0 and another go, jointly: 16 x 16 groups (all pairs for small counts), false alarms 1e-4 a count."""
    realizations = 20000 if count <= 1024 else 65536
    others = sorted({1, 2, count // 4, count // 2, count - 1} - {0})
    if count <= 1024:
        found = permutations(count, realizations // max(1, count // 100), seed=2)
        places = {i: found[:, i] for i in (0, *others)}
    else:
        places = {i: permutations(count, realizations, seed=2, start=i, stop=i + 1)[:, 0] for i in (0, *others)}
    for i in others:
        assert pair_pvalue(places[0], places[i], count, min(count, 16)) > 1e-4 / len(others), i


@pytest.mark.parametrize("count", [1025, 4096])
def test_neighbours_lie_at_any_distance(count):
    """The difference of two neighbours' places, modulo the count, is uniform: false alarms 1e-4."""
    first, second = (permutations(count, 2**17, seed=3, start=i, stop=i + 1)[:, 0] for i in (10, 11))
    observed = np.bincount((second - first) % count, minlength=count)[1:]
    assert stats.chisquare(observed).pvalue > 1e-4


@pytest.mark.parametrize("count", [1000, 3000])
def test_permutations_of_other_realisations_dimensions_and_seeds_are_independent(count):
    """Correlations of 3000 places, three of them, within 4 standard errors: false alarms 2e-4."""
    one = LATIN.points(count, 2, realizations=2, seed=4)
    other = LATIN.points(count, 2, realizations=2, seed=5)
    for a, b in ((one[0, :, 0], one[1, :, 0]), (one[0, :, 0], one[0, :, 1]), (one[0, :, 0], other[0, :, 0])):
        assert abs(np.corrcoef(a, b)[0, 1]) < 4 / math.sqrt(count)


def test_fixed_points_and_cycles_are_those_of_random_permutations():
    """On average 1 fixed point and harmonic(N) cycles: means of 400, within 5 standard errors (false alarms 2e-6)."""
    for count in (1000, 1500):
        found = permutations(count, 400, seed=6)
        fixed = (found == np.arange(count)).sum(axis=1)
        assert abs(fixed.mean() - 1.0) < 5 / 20
        harmonic = sum(1 / k for k in range(1, count + 1))
        assert abs(np.mean([cycles(row) for row in found.tolist()]) - harmonic) < 5 * math.sqrt(harmonic) / 20


def cycles(places):
    seen = bytearray(len(places))
    found = 0
    for first in range(len(places)):
        if not seen[first]:
            found += 1
            place = first
            while not seen[place]:
                seen[place] = 1
                place = places[place]
    return found


@pytest.mark.parametrize("count", [3, 1025, 2048, 5000])
def test_many_at_a_time_go_where_each_goes_alone(count):
    bits, key = permutation_bits(count), np.uint64(2**63 + 12345)
    start = min(7, count - 3)
    place = np.empty(min(700, count - start), np.int64)
    permute_range(place, start, count, bits, key)
    assert place.tolist() == [permute(start + i, count, bits, key) for i in range(place.size)]
    lines = np.arange(place.size) % 3
    keys = np.array([5, 2**64 - 1, 77], np.uint64)
    within = (np.arange(place.size) + start) % count
    expected = [permute(i, count, bits, keys[line]) for i, line in zip(within, lines, strict=True)]
    permute_in_lines(within, lines, count, bits, keys)
    assert within.tolist() == expected
