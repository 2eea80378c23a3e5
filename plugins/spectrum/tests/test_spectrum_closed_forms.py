"""Expected spectra against their closed forms, at every frequency and over every ring."""

import math

import numpy as np
import pytest
from samplekit_spectrum import power
from scipy.stats import norm

import samplekit
from samplekit import grid_sides

FALSE_ALARM = 1e-3


def sinc2(x):
    return np.sinc(x) ** 2


def random(m1, m2, n):
    return np.full(m1.shape, 1.0 / n)


def jittered(m1, m2, n):
    n1, n2 = grid_sides(n, 2)
    return (1.0 - sinc2(m1 / n1) * sinc2(m2 / n2)) / n


def latin_hypercube(m1, m2, n):
    product = np.ones(m1.shape)
    for m in (m1, m2):
        product *= np.where(m != 0, -sinc2(m / n) / (n - 1), 1.0)
    return (1.0 + (n - 1) * product) / n


def multi_jittered(m1, m2, count):
    """Chiu, Shirley, Wang 1994 with N = n^2: independent shuffles of the n strips of every column and row."""
    n = math.isqrt(count)

    def a(m):
        return (n * sinc2(m / n) - sinc2(m / count)) / (n - 1)

    def d(m):
        return n**2 * (m % n == 0) - n

    s1, s2 = sinc2(m1 / n), sinc2(m2 / n)
    return (count + n * a(m1) * d(m2) * s2 + n * a(m2) * d(m1) * s1 + d(m1) * d(m2) * s1 * s2) / count**2


CASES = [
    ("random", random, 64),
    ("jittered", jittered, 64),
    ("jittered", jittered, 96),
    ("latin-hypercube", latin_hypercube, 64),
    ("n-rooks", latin_hypercube, 37),
    ("multi-jittered", multi_jittered, 64),
]


@pytest.mark.slow
@pytest.mark.parametrize(("sampler", "form", "count"), CASES)
def test_every_frequency_is_within_its_standard_errors(sampler, form, count):
    """The limit is that of a normal deviate at all frequencies at once with a false alarm of 1e-3: about 5.1.

    The mean of 4000 powers, exponential each, is a little skewed: the limit is widened by a tenth for that.
    """
    reach, realizations = 20, 4000
    spectrum = power(sampler, count, realizations=realizations, max_frequency=reach, seed=17)
    m2, m1 = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    expected = form(m1, m2, count)
    limit = 1.1 * norm.isf(FALSE_ALARM / 2 / (spectrum.mean.size // 2))
    deviation = np.abs(spectrum.mean - expected)
    deviation[reach, reach] = 0.0
    # Where the power is certain, rounding is all that is left.
    assert np.all(deviation <= limit * spectrum.standard_error + 1e-12)
    scores = deviation / np.maximum(spectrum.standard_error, 1e-12)
    assert scores.max() > 2.0, "errors this small are no errors"


def test_the_regular_grid_is_a_comb():
    spectrum = power("regular", 96, max_frequency=40)
    m2, m1 = np.mgrid[-40:41, -40:41]
    n1, n2 = grid_sides(96, 2)
    comb = ((m1 % n1 == 0) & (m2 % n2 == 0)).astype(float)
    np.testing.assert_allclose(spectrum.mean, comb, atol=1e-12)
    assert spectrum.mean[comb == 0.0].max() < 1e-20


def test_radial_power_and_bias_are_those_of_the_mean_over_points():
    """S(m) = (1/N) sum exp(-2 pi i m . x): 1 at the 4 of 32 frequencies of ring 4 where a grid of 4 x 4 is in phase."""
    grid = power("regular", 16, max_frequency=4)
    np.testing.assert_allclose(grid.radial.power, [0.0, 0.0, 0.0, 4 / 32], atol=1e-12)
    assert grid.bias.amplitude == pytest.approx(1.0, abs=1e-12)
    sets = samplekit.points("random", 16, realizations=20, seed=5)
    ring = np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (0, 0)])
    amplitudes = np.exp(-2j * np.pi * sets @ ring.T).mean(axis=1)
    found = power("random", 16, realizations=20, max_frequency=1, seed=5)
    assert found.radial.power[0] == pytest.approx((np.abs(amplitudes) ** 2).mean(), rel=1e-9)
    # 1/N, not 1: 160 nearly exponential powers, half of them independent, within 5 standard errors.
    assert 16 * found.radial.power[0] == pytest.approx(1.0, abs=5 / math.sqrt(80))


@pytest.mark.parametrize("count", [16, 1024])
def test_white_noise_is_1_over_every_ring(count):
    """Rings are nearly independent: 1e-3 over all of them."""
    spectrum = power("random", count, realizations=600, max_frequency=40, seed=5)
    scores = (count * spectrum.radial.power - 1.0) / (count * spectrum.radial.standard_error)
    assert np.abs(scores).max() < norm.isf(FALSE_ALARM / 2 / 40) * 1.05
    # And the errors are what they should be: N P has a standard deviation of 1 at each of half the frequencies.
    wanted = np.sqrt(2.0 / spectrum.radial.frequencies / 600)
    ratio = count * spectrum.radial.standard_error / wanted
    assert np.all((ratio > 0.8) & (ratio < 1.25))


def test_anisotropy_of_white_noise_is_that_of_its_realizations():
    spectrum = power("random", 256, realizations=200, max_frequency=48)
    # A ring has at least 140 frequencies from 23 on: a relative standard deviation of 12 % at most, 0.5 dB.
    assert np.abs(spectrum.radial.anisotropy[22:] + 10.0 * math.log10(200)).max() < 2.5


def test_jitter_has_a_dark_centre_that_rises_as_rho_squared():
    spectrum = power("jittered", 1024, realizations=300, max_frequency=64)
    radial = 1024 * spectrum.radial.power
    # (pi rho)^2 / 3n^2 per axis at the centre: 1 - sinc^2 sinc^2 ~ (pi^2 / 3) rho^2 / N.
    assert radial[0] == pytest.approx(math.pi**2 / 3 / 1024 * 1.5, rel=0.15)  # ring 1 holds |m|^2 = 1 and 2
    slope = math.log(radial[7] / radial[1]) / math.log(8 / 2)
    assert 1.7 < slope < 2.1
    assert 0.97 < radial[-10:].mean() < 1.0


@pytest.mark.parametrize("sampler", ["n-rooks", "multi-jittered"])
def test_rooks_and_multi_jitter_have_a_dark_cross(sampler):
    spectrum = power(sampler, 256, realizations=200, max_frequency=48)
    normalized = spectrum.normalized
    m = np.arange(1, 49)
    cross = np.concatenate([normalized[48, 48 + m], normalized[48 + m, 48]])
    wanted = np.tile(1.0 - sinc2(m / 256), 2)
    assert np.abs(cross - wanted).max() < 0.05
    off = normalized[48 + 25 :, 48 + 25 :]
    assert off.mean() == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(("dims", "reach"), [(1, 12), (3, 6)])
def test_jitter_in_one_and_three_dimensions(dims, reach):
    spectrum = power("jittered", 64, realizations=2000, max_frequency=reach, dims=dims, seed=3)
    sides = grid_sides(64, dims)
    components = np.meshgrid(*[np.arange(-reach, reach + 1)] * dims, indexing="ij")
    product = np.prod([sinc2(m / n) for m, n in zip(components, sides, strict=True)], axis=0)
    scores = (spectrum.mean - (1.0 - product) / 64) / np.maximum(spectrum.standard_error, 1e-12)
    scores[(reach,) * dims] = 0.0
    assert np.abs(scores).max() < 1.15 * norm.isf(FALSE_ALARM / spectrum.mean.size)


def bluenoise(name):
    pytest.importorskip("samplekit_bluenoise")
    if name not in {spec.name for spec in samplekit.samplers()}:
        pytest.skip(f"no sampler {name}")


def test_poisson_disks_have_a_ring_and_a_plateau():
    bluenoise("poisson-disk")
    spectrum = power("poisson-disk", 256, realizations=40, max_frequency=48)
    radial = 256 * spectrum.radial.power
    assert 0.03 < radial[1:5].mean() < 0.15
    assert abs(int(np.argmax(radial)) + 1 - 16 * 1.0) <= 5
    assert radial.max() > 1.1


def test_capacity_constrained_sets_rise_as_rho_to_the_fourth():
    bluenoise("ccvt")
    spectrum = power("ccvt", 256, realizations=4, max_frequency=48)
    radial = 256 * spectrum.radial.power
    assert radial[0] < 1e-3
    assert radial[7] / radial[3] > 8.0
