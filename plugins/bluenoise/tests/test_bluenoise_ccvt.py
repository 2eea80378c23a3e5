import numpy as np
import pytest
from samplekit_bluenoise.ccvt import capacity_steps
from samplekit_bluenoise.strata import scatter, split
from samplekit_bluenoise.swaps import settle
from samplekit_bluenoise.territories import cut_open, divide
from scipy.special import j1

import samplekit


def strata_of(points, count, splits=0):
    """Row and column of the stratum of each point of float64[2, n]; ``count`` strata were split ``splits`` times."""
    rows = max(1, round(count**0.5))
    firsts = np.array([row * count // rows for row in range(rows + 1)])
    row = np.searchsorted(firsts, points[1] * count, side="right") - 1
    width = np.diff(firsts)[row]
    parts = 2**splits
    line = np.floor((points[1] * count - firsts[row]) / width * parts)
    return row * parts + line, np.floor(points[0] * width * parts)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 7, 16, 97, 1000])
def test_strata_hold_one_point_each_and_split_into_four(count):
    points = np.empty((2, count))
    scatter(points, np.uint64(count))
    points = points[:, np.random.default_rng(0).permutation(count)].copy()
    for splits in range(3):
        assert points.min() >= 0.0
        assert points.max() < 1.0
        assert len(set(zip(*strata_of(points, count, splits), strict=True))) == points.shape[1] == count * 4**splits
        finer = np.empty((2, 4 * points.shape[1]))
        split(finer, points, splits, np.uint64(splits + 9))
        parents = np.repeat(np.array(strata_of(points, count, splits)), 4, axis=1)
        np.testing.assert_array_equal(parents, strata_of(finer, count, splits))
        points = finer


def test_the_torus_is_cut_open_without_losing_a_point():
    points = np.random.default_rng(1).random((2, 5000))
    opened = points.copy()
    cut_open(opened, np.uint64(3))
    assert np.abs((opened - points) - np.rint(opened - points)).max() < 1e-15
    assert 0.05 < np.mean(opened != points) < 0.6


@pytest.mark.parametrize("sites", [1, 2, 3, 13, 50])
def test_territories_are_of_equal_size_and_compact(sites):
    points = np.random.default_rng(sites).random((2, sites * 64))
    divided = points.copy()
    divide(divided, sites, np.uint64(1))
    assert set(zip(*divided, strict=True)) == set(zip(*points, strict=True))
    spread = divided.reshape(2, sites, 64).std(axis=2)
    # A square of area 1 / N has a standard deviation of 0.29 / sqrt(N) along each axis.
    assert np.median(np.hypot(*spread)) < 0.8 / sites**0.5


def settled(count, capacity, seed):
    rng = np.random.default_rng(seed)
    points = rng.random((2, count * capacity))
    divide(points, count, np.uint64(seed))
    sites = points[:, ::capacity].copy()
    given = set(zip(*points, strict=True))
    assert settle(sites, points, 500) < 500
    assert set(zip(*points, strict=True)) == given
    return sites, points


def wrapped(difference):
    return difference - np.rint(difference)


@pytest.mark.parametrize(("count", "capacity"), [(2, 8), (3, 16), (5, 7), (12, 20), (40, 9)])
def test_no_swap_of_two_points_brings_them_nearer_to_their_sites(count, capacity):
    for seed in range(5):
        sites, points = settled(count, capacity, seed)
        square = (wrapped(points[:, :, None] - sites[:, None]) ** 2).sum(0)
        owner = np.repeat(np.arange(count), capacity)
        own = square[np.arange(owner.size), owner]
        gain = own[:, None] + own - square[:, owner] - square[:, owner].T
        assert gain.max() < 1e-9 / count


@pytest.mark.parametrize(("count", "capacity"), [(1, 50), (4, 30), (30, 16)])
def test_sites_are_the_centroids_of_their_points(count, capacity):
    sites, points = settled(count, capacity, 2)
    offset = wrapped(points.reshape(2, count, capacity) - sites[:, :, None])
    if count > 1:
        assert np.abs(offset.mean(axis=2)).max() < 1e-12


def test_a_capacity_is_reached_by_factors_of_four():
    assert [capacity_steps(c) for c in (1, 8, 31, 32, 97, 100, 256)] == [
        (1, 0), (8, 0), (31, 0), (8, 1), (97, 0), (25, 1), (16, 2)
    ]  # fmt: skip


def disk_variance(power, count, radius=0.3):
    """Variance of the estimate of a disk, sum over m of |f^(m)|^2 P(m), and the tail of f^ where P is 1 / N."""
    largest = power.shape[0] // 2
    m = np.arange(-largest, largest + 1)
    rho = np.hypot(m[:, None], m)
    rho[largest, largest] = 1.0
    coefficients = (radius * j1(2 * np.pi * radius * rho) / rho) ** 2
    coefficients[largest, largest] = 0.0
    area = np.pi * radius**2
    return ((coefficients * power).sum() + area - area**2 - coefficients.sum()) / count


def gaussian_variance(power, count, sigma=0.1):
    largest = power.shape[0] // 2
    m = np.arange(-largest, largest + 1)
    coefficients = (2 * np.pi * sigma**2 * np.exp(-2 * (np.pi * sigma) ** 2 * (m[:, None] ** 2 + m**2))) ** 2
    coefficients[largest, largest] = 0.0
    return (coefficients * power).sum() / count


@pytest.fixture(scope="module")
def powers(spectrum):
    return {
        count: spectrum(samplekit.points("ccvt:bank=0", count, 2, realizations=sets, seed=4), largest)
        for count, sets, largest in ((64, 120, 24), (256, 30, 40))
    }


def test_low_frequencies_are_empty(powers, radial):
    """An order of magnitude above what 30 to 60 sets gave: 8e-5 and 5e-6."""
    assert radial(powers[64])[1] < 8e-4
    assert radial(powers[256])[1] < 5e-5


def test_power_rises_with_the_fourth_power_of_the_frequency(powers, radial):
    rings = radial(powers[256])
    # 2^4 = 16 from 4 to 8; a plateau gives 1, rho^2 gives 4. 25 and 50 frequencies of 30 sets: 5 % standard error.
    assert 12.0 < rings[8] / rings[4] < 35.0


def test_the_variance_of_a_disk(powers):
    """2.77e-4 and 3.45e-5 with 60 and 30 sets, 2 % standard error; jittered points have 6.1e-4 and 7.6e-5."""
    assert disk_variance(powers[64], 64) == pytest.approx(2.77e-4, rel=0.1)
    assert disk_variance(powers[256], 256) == pytest.approx(3.45e-5, rel=0.1)


def test_the_variance_of_a_smooth_scene_falls_with_the_cube_of_the_count(powers):
    fall = gaussian_variance(powers[64], 64) / gaussian_variance(powers[256], 256)
    # 4^3 = 64 and a little more; a floor of the background would give at most 16.
    assert np.log(fall) / np.log(4) > 2.6


def test_no_direction_is_favoured(powers, radial):
    """The axes against the whole ring: 1.36 for a torus cut open along the sides of the square.

    2 x 4 independent frequencies of 120 sets: 3.2 % standard error, so 0.16 is five.
    """
    power = powers[64]
    axes = np.concatenate([power[24 + 7 : 24 + 11, 24], power[24, 24 + 7 : 24 + 11]]).mean()
    assert axes == pytest.approx(radial(power)[7:11].mean(), rel=0.16)


def test_a_background_that_is_too_coarse_shows():
    """The option has its effect: variance of the mean of a wave of frequency (1, 1) over 200 sets."""

    def spread(capacity):
        points = samplekit.points(f"ccvt:bank=0,capacity={capacity}", 32, 2, realizations=200)
        return np.cos(2 * np.pi * points.sum(axis=2)).mean(axis=1).var()

    assert spread(2) > 5 * spread(64)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 7, 97])
def test_any_count_and_prime_capacities(count):
    sampler = samplekit.sampler("ccvt:bank=0,capacity=37")
    out = np.empty((4, 2, count))
    sampler.fill(out, sampler.trials(0, 4, 0), count, 0)
    assert all(len(np.unique(row)) == count for row in out.reshape(8, count))
