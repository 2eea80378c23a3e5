"""Variances, rates and expected spectra of the samplers against closed forms.

Scenes: the disk of radius 0.3 and the Gaussian of sigma 0.1, both around (0.4523, 0.5317). The Gaussian is 4e-5 at
the nearest edge of the square, so that it counts as periodic.
"""

import math

import numpy as np
import pytest
from scipy import special

import samplekit

CX, CY, RADIUS, SIGMA = 0.4523, 0.5317, 0.3, 0.1
DISK, GAUSSIAN = "disk", "gaussian"


def bell_integrals(cells, sigma):
    """Integrals of the bell over each cell of a grid, [cells, cells]."""
    edges = np.arange(cells + 1) / cells
    x, y = (
        np.diff(special.erf((edges - c) / (sigma * math.sqrt(2)))) * sigma * math.sqrt(math.pi / 2) for c in (CX, CY)
    )
    return np.multiply.outer(y, x)


def disk_integrals(cells, steps=2000):
    """Areas of the disk in each cell of a grid: midpoint rule over chords, within 1e-7."""
    edges = np.arange(cells + 1) / cells
    x = ((np.arange(cells * steps) + 0.5) / (cells * steps)).reshape(cells, steps)
    half = np.sqrt(np.maximum(RADIUS**2 - (x - CX) ** 2, 0.0))
    below = np.clip(edges[:, None, None], CY - half, CY + half)
    return np.diff(below, axis=0).mean(axis=2) / cells


def variance_of_random(scene, count):
    """(I_2 - I^2) / N."""
    if scene == DISK:
        area = math.pi * RADIUS**2
        return (area - area**2) / count
    return (bell_integrals(1, SIGMA / math.sqrt(2)).sum() - bell_integrals(1, SIGMA).sum() ** 2) / count


def variance_of_jittered(scene, cells):
    """The sum over cells of the variance of one sample each, N = cells^2: sum (I_2 - N I^2) / N over the cells."""
    first = disk_integrals(cells) if scene == DISK else bell_integrals(cells, SIGMA)
    second = first if scene == DISK else bell_integrals(cells, SIGMA / math.sqrt(2))
    count = cells**2
    return ((second - count * first**2) / count).sum()


def variance_of_shifted_jittered(scene, cells, largest=400):
    """The sum over integer frequencies of the scene's power times the sampler's, the rest of the power at white 1/N."""
    count = cells**2
    m = np.arange(-largest, largest + 1)
    squared = m[:, None] ** 2 + m**2
    radius = np.sqrt(squared)
    radius[largest, largest] = 1.0
    if scene == DISK:
        power = (RADIUS * special.j1(2 * math.pi * RADIUS * radius) / radius) ** 2
        total = math.pi * RADIUS**2 - (math.pi * RADIUS**2) ** 2
    else:
        power = (2 * math.pi * SIGMA**2 * np.exp(-2 * (math.pi * SIGMA) ** 2 * squared)) ** 2
        total = math.pi * SIGMA**2 - (2 * math.pi * SIGMA**2) ** 2
    power[largest, largest] = 0.0
    line = np.sinc(m / cells) ** 2
    return ((power * (1 - line[:, None] * line)).sum() + total - power.sum()) / count


def variance_of(scene, sampler, count, realizations, seed=1):
    return samplekit.estimate(scene, sampler, count, realizations=realizations, seed=seed).var(ddof=1)


# 20000 estimates, each near normal: a variance has standard error 1 %; 4.5 of them, false alarms 7e-6 a test.
REALIZATIONS, TOLERANCE = 20000, 0.045


@pytest.mark.parametrize("scene", [DISK, GAUSSIAN])
def test_variance_of_random(scene):
    expected = variance_of_random(scene, 256)
    assert expected * 256 == pytest.approx({DISK: 0.202800, GAUSSIAN: 0.0274681}[scene], rel=1e-4)
    assert variance_of(scene, "random", 256, REALIZATIONS) == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize("cells", [4, 16])
@pytest.mark.parametrize("scene", [DISK, GAUSSIAN])
def test_variance_of_jittered(scene, cells):
    found = variance_of(scene, "jittered", cells**2, REALIZATIONS)
    assert found == pytest.approx(variance_of_jittered(scene, cells), rel=TOLERANCE)


@pytest.mark.parametrize("cells", [4, 16])
@pytest.mark.parametrize("scene", [DISK, GAUSSIAN])
def test_variance_of_shifted_jittered(scene, cells):
    found = variance_of(scene, "jittered+shift", cells**2, REALIZATIONS)
    assert found == pytest.approx(variance_of_shifted_jittered(scene, cells), rel=TOLERANCE)


def test_variance_of_jittered_at_many_samples():
    """Perimeter times 0.165968 N^-3/2 for the disk, pi/12 N^-2 for the bell: 4000 estimates, 4.5 errors of 2.2 %."""
    for scene, expected in ((DISK, 0.31284 * 4096**-1.5), (GAUSSIAN, math.pi / 12 / 4096**2)):
        assert variance_of(scene, "jittered+shift", 4096, 4000) == pytest.approx(expected, rel=0.10 + 0.01)


@pytest.mark.parametrize("name", ["jittered", "latin-hypercube", "multi-jittered", "correlated-multi-jittered"])
def test_a_step_along_a_stratum_is_free(name):
    """x < 1/2 with 64 samples: no error at all."""
    estimates = samplekit.estimate("step:angle=0,offset=0.5", name, 64, realizations=100)
    assert (estimates == 0.5).all()


def slope(scene, sampler, counts, realizations):
    variances = [variance_of(scene, sampler, count, realizations, seed=count) for count in counts]
    return np.polyfit(np.log2(counts), np.log2(variances), 1)[0]


# Measured rates and their limits; from 16 to 4096 samples, 1000 estimates each: the fit's own standard error is 0.01.
SLOPES = [
    ("random", DISK, -1.00, 0.05),
    ("random", GAUSSIAN, -1.00, 0.05),
    ("jittered", DISK, -1.50, 0.12),
    ("jittered", GAUSSIAN, -2.00, 0.12),
    ("jittered+shift", DISK, -1.50, 0.12),
    ("jittered+shift", GAUSSIAN, -1.94, 0.12),
    ("latin-hypercube", DISK, -1.01, 0.05),
    ("latin-hypercube", GAUSSIAN, -1.01, 0.07),
    ("multi-jittered", DISK, -1.435, 0.12),
    ("multi-jittered", GAUSSIAN, -2.005, 0.12),
    ("correlated-multi-jittered", DISK, -1.508, 0.12),
    ("correlated-multi-jittered", GAUSSIAN, -3.05, 0.12),
    ("sobol+owen", DISK, -1.505, 0.12),
    ("sobol+owen", GAUSSIAN, -2.75, 0.2),
]


@pytest.mark.parametrize(("sampler", "scene", "rate", "tolerance"), SLOPES)
def test_rates_of_convergence(sampler, scene, rate, tolerance):
    assert slope(scene, sampler, [16, 64, 256, 1024, 4096], 1000) == pytest.approx(rate, abs=tolerance)


# Variance times a power of N, of samplers without a closed form: measured with other code, see the limits of each.
@pytest.mark.parametrize(
    ("sampler", "scene", "count", "expected", "tolerance"),
    [
        ("latin-hypercube", DISK, 4096, 1.79e-5, 0.15),
        ("latin-hypercube", GAUSSIAN, 4096, 3.15e-6, 0.15),
        ("multi-jittered", GAUSSIAN, 4096, 9.97e-9, 0.15),
        ("correlated-multi-jittered", DISK, 16, 2.38e-3, 0.15),
        ("correlated-multi-jittered", GAUSSIAN, 16, 2.70e-4, 0.15),
        ("correlated-multi-jittered", GAUSSIAN, 4096, 1.11e-11, 0.2),
        ("sobol+owen", GAUSSIAN, 16, 8.46e-4, 0.15),
        ("sobol+owen", DISK, 4096, 8.4e-7, 0.2),
        ("sobol+owen", GAUSSIAN, 4096, 3.80e-10, 0.2),
    ],
)
def test_variances_measured_elsewhere(sampler, scene, count, expected, tolerance):
    realizations = 8000 if count < 1000 else 2000
    assert variance_of(scene, sampler, count, realizations, seed=3) == pytest.approx(expected, rel=tolerance)


FREQUENCIES = [
    *((m, 0) for m in (1, 2, 3, 7, 8, 9, 16)),
    *((0, m) for m in (1, 2, 5, 8, 15, 16)),
    *((m, m) for m in (1, 2, 4, 8)),
    *((1, 2), (2, 1), (3, -2), (5, 7), (8, 1), (1, 8), (8, -8), (16, 3), (4, 16), (12, -5)),
]


def transforms(sampler, count, realizations):
    """The spectrum of each realisation at the frequencies, complex[F, R]: direct sums."""
    parts = []
    for seed in range(realizations // 1000):
        points = samplekit.points(sampler, count, realizations=1000, seed=seed)
        x, y = (np.exp(-2j * np.pi * points[:, :, d]) for d in range(2))
        x_powers, y_powers = {0: np.ones_like(x)}, {0: np.ones_like(y)}
        for m in range(1, 17):
            x_powers[m], y_powers[m] = x_powers[m - 1] * x, y_powers[m - 1] * y
        for m in range(1, 9):
            y_powers[-m] = y_powers[m].conj()
        parts.append([np.einsum("rn,rn->r", x_powers[a], y_powers[b]) / count for a, b in FREQUENCIES])
    return np.concatenate(parts, axis=1)


def sinc2(m, n):
    return float(np.sinc(m / n)) ** 2


def power_of_random(a, b, count):
    return 1 / count


def power_of_jittered(a, b, count):
    n = math.isqrt(count)
    return (1 - sinc2(a, n) * sinc2(b, n)) / count


def power_of_latin_hypercube(a, b, count):
    product = math.prod(-sinc2(m, count) / (count - 1) for m in (a, b) if m)
    return (1 + (count - 1) * product) / count


def power_of_multi_jittered(a, b, count):
    n = math.isqrt(count)

    def alike(m):
        """Mean over two points of one column."""
        return (n * sinc2(m, n) - sinc2(m, count)) / (n - 1) if m else 1.0

    def differing(m):
        """Sum over pairs of columns."""
        return (n * n if m % n == 0 else 0) - n

    sa, sb = sinc2(a, n), sinc2(b, n)
    pairs = n * alike(a) * differing(b) * sb + n * alike(b) * differing(a) * sa + differing(a) * differing(b) * sa * sb
    return (count + pairs) / count**2


@pytest.mark.parametrize(
    ("sampler", "count", "power"),
    [
        ("random", 16, power_of_random),
        ("jittered", 64, power_of_jittered),
        ("latin-hypercube", 16, power_of_latin_hypercube),
        ("latin-hypercube", 13, power_of_latin_hypercube),
        ("multi-jittered", 64, power_of_multi_jittered),
        ("multi-jittered", 16, power_of_multi_jittered),
        ("jittered+shift", 16, power_of_jittered),
        ("latin-hypercube+shift", 16, power_of_latin_hypercube),
        ("multi-jittered+shift", 16, power_of_multi_jittered),
    ],
)
def test_expected_spectra(sampler, count, power):
    """27 frequencies, 20000 realisations: within 5 standard errors, false alarms 2e-5 a sampler."""
    realizations = 20000
    found = np.abs(transforms(sampler, count, realizations)) ** 2
    for (a, b), powers in zip(FREQUENCIES, found, strict=True):
        error = powers.std() / math.sqrt(realizations)
        assert abs(powers.mean() - power(a, b, count)) < 5 * error + 1e-15, (a, b)


@pytest.mark.parametrize(("sampler", "count"), [("jittered", 16), ("multi-jittered", 16), ("latin-hypercube", 13)])
def test_spectra_have_mean_zero_without_a_shift(sampler, count):
    """Which is to be unbiased for waves: real and imaginary parts within 5 standard errors, false alarms 4e-5."""
    found = transforms(sampler, count, 4000)
    for part in (found.real, found.imag):
        error = part.std(axis=1) / math.sqrt(4000)
        assert (np.abs(part.mean(axis=1)) < 5 * error + 1e-15).all()


def neighbours(images):
    """Correlations of each image [K, H, W] with itself moved by one pixel and by others."""
    for dy, dx in ((0, 1), (1, 0), (1, 1), (0, 2), (16, 0), (0, 64)):
        height, width = images.shape[1] - dy, images.shape[2] - dx
        for image in images:
            yield np.corrcoef(image[dy:, dx:].ravel(), image[:height, :width].ravel())[0, 1]


@pytest.mark.parametrize("sampler", ["random", "jittered", "latin-hypercube", "correlated-multi-jittered", "halton+xor",
                                     "sobol+owen", "sobol+shift", "hammersley+owen"])  # fmt: skip
def test_pixels_and_dimensions_are_independent(sampler):
    """Points 0 and 9 of 16 in 4 dimensions, over 100 x 100 pixels: 48 + 28 correlations below 4.5 / sqrt(n).

    False alarms 5e-4 a sampler.
    """
    y, x = (grid.ravel() for grid in np.mgrid[:100, :100])
    out = np.empty((10000, 4, 16))
    samplekit.sampler(sampler).fill(out, samplekit.Realizations.of_pixels(x, y, 5), 16, 0)
    coordinates = out[:, :, [0, 9]]
    images = coordinates.reshape(10000, 8).T.reshape(8, 100, 100)
    for correlation in neighbours(images):
        assert abs(correlation) < 4.5 / 84  # at least 84 x 84 pairs
    for point in (0, 1):
        between = np.corrcoef(coordinates[:, :, point].T)[np.triu_indices(4, 1)]
        assert np.abs(between).max() < 4.5 / 100


@pytest.mark.parametrize("sampler", ["random", "jittered", "correlated-multi-jittered", "sobol+owen", "sobol+xor"])
def test_errors_of_neighbouring_pixels_are_independent(sampler):
    """Estimates of the disk by 100 x 100 pixels: 6 correlations below 4.5 / sqrt(n), false alarms 4e-5 a sampler."""
    y, x = (grid.ravel() for grid in np.mgrid[:100, :100])
    out = np.empty((10000, 2, 16))
    samplekit.sampler(sampler).fill(out, samplekit.Realizations.of_pixels(x, y, 6), 16, 0)
    inside = (out[:, 0] - CX) ** 2 + (out[:, 1] - CY) ** 2 < RADIUS**2
    for correlation in neighbours(inside.mean(axis=1).reshape(1, 100, 100)):
        assert abs(correlation) < 4.5 / 84
