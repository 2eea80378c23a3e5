from itertools import pairwise

import numpy as np
import pytest

import samplekit
from samplekit import FibonacciNumbers

REALIZATIONS = 100


def numerators(points, count):
    """The integers m of points (m + r) / count, exactly."""
    return np.array([(x.as_integer_ratio()[0] * count) // x.as_integer_ratio()[1] for x in points.ravel().tolist()])


@pytest.mark.parametrize("count", [1, 2, 3, 5, 8, 21, 89, 144])
def test_points_are_the_lattice_shifted_by_whole_steps_and_one_place_within(count):
    points = samplekit.points("fibonacci", count=count, realizations=REALIZATIONS)
    generator = FibonacciNumbers().below(count, 2) or 0
    index = np.arange(count)
    for set_ in points:
        m = numerators(set_, count).reshape(count, 2)
        assert ((m[:, 0] - m[0, 0] - index) % count == 0).all()
        assert ((m[:, 1] - m[0, 1] - index * generator) % count == 0).all()
        assert (np.sort(m, axis=0) == index[:, None]).all()
        assert np.ptp(set_ * count - m, axis=0).max() < count * 2.0**-49


def test_the_shift_is_uniform():
    points = samplekit.points("fibonacci", count=8, realizations=4000)[:, 3]
    for dim in range(2):
        bins = np.bincount((points[:, dim] * 31).astype(int), minlength=31)
        assert ((bins - 4000 / 31) ** 2).sum() / (4000 / 31) < 67


def test_points_are_as_far_apart_as_declared():
    smallest = []
    for before, count in pairwise(FibonacciNumbers().rising(0, 2)):
        if count > 5000:
            break
        index = np.arange(1, count)
        steps = np.stack([index, index * before % count])
        distance = np.sqrt((np.minimum(steps, count - steps) ** 2).sum(axis=0).min()) / count
        smallest.append(distance / np.sqrt(2 / (np.sqrt(3) * count)))
    assert min(smallest) == pytest.approx(0.7598, abs=1e-4)
    assert sorted(smallest)[1] > 0.86


@pytest.mark.parametrize("count", [144, 75025])
def test_parts_of_a_fibonacci_lattice_equal_the_whole(count):
    sampler = samplekit.sampler("fibonacci")
    whole = sampler.points(count, realizations=2, seed=5)
    for start, stop in [(0, 1), (1, 8), (count - 5, count), (7, count // 2)]:
        part = sampler.points(count, realizations=2, seed=5, start=start, stop=stop)
        assert np.array_equal(part, whole[:, start:stop])


def test_the_largest_lattice_is_exact():
    count = 2971215073
    points = samplekit.sampler("fibonacci").points(count, start=count - 100, stop=count)[0]
    m = numerators(points, count).reshape(-1, 2).astype(object)
    generator = FibonacciNumbers().below(count, 2)
    assert all((m[i, 1] - m[0, 1] - i * generator) % count == 0 for i in range(100))
    assert all((m[i, 0] - m[0, 0] - i) % count == 0 for i in range(100))


def test_other_counts_and_dimensions_are_refused():
    with pytest.raises(samplekit.UsageError, match="Fibonacci numbers, not 100: the nearest are 89 and 144"):
        samplekit.points("fibonacci", count=100)
    with pytest.raises(samplekit.UsageError, match="in 2 dimensions, not 3"):
        samplekit.points("fibonacci", count=89, dims=3)
