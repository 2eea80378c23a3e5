"""Every sampler that is random, plain and under every randomizer: points uniform in the square, estimates unbiased.

One point of each realisation, its index drawn evenly, is uniform and independent of all others, so that the chi-square
statistic has its textbook law, whatever the structure of a set. 961 cells of 61 points each; false alarms 1e-3 for all
combinations together, with a fixed seed.
"""

import numpy as np
import pytest
from scipy import stats

import samplekit
from samplekit._builtin import samplekit_randomizers, samplekit_samplers

CHOICES = [
    text
    for spec in samplekit_samplers()
    if not any(option.required for option in spec.options)
    for text in (spec.name, *(f"{spec.name}+{randomizer.name}" for randomizer in samplekit_randomizers()))
    if samplekit.sampler(text).spec.unbiased and samplekit.sampler(text).spec.randomized
]
REALIZATIONS = 61 * 961


@pytest.mark.parametrize("text", CHOICES)
def test_points_are_uniform(text):
    sampler = samplekit.sampler(text)
    count = 25 if sampler.spec.counts == samplekit.PrimePowers(2) else 4
    dims = min(2, sampler.spec.dimensions[1] or 2)
    realizations = REALIZATIONS if dims == 2 else REALIZATIONS // 31
    points = np.empty((realizations, dims))
    # Index i for realisations i, i + count, ...
    for index in range(count):
        x = np.arange(index, realizations, count)
        out = np.empty((x.size, dims, 1))
        # Pixels that share a sequence are not independent: one of each block.
        apart = x * (sampler.spec.screen_block or 1)
        sampler.fill(out, samplekit.Realizations.of_pixels(apart, np.zeros_like(x), 2024), count, index)
        points[index::count] = out[:, :, 0]
    cells = np.floor(points * 31).astype(int) @ 31 ** np.arange(dims)
    assert stats.chisquare(np.bincount(cells, minlength=31**dims)).pvalue > 1e-3 / len(CHOICES)


@pytest.mark.parametrize("text", CHOICES)
def test_estimates_are_unbiased(text):
    """x + y, x y and a corner's triangle over 4000 sets: within 4.5 standard errors, false alarms 1e-3 for all."""
    sampler = samplekit.sampler(text)
    count = 25 if sampler.spec.counts == samplekit.PrimePowers(2) else 8
    dims = min(2, sampler.spec.dimensions[1] or 2)
    points = sampler.points(count, dims, realizations=4000, seed=77)
    x, y = points[:, :, 0], points[:, :, -1] if dims == 2 else 0.5
    for values, integral in (
        (x + y, 1.0),
        (x * y, 0.25),
        (((x + y) < 0.75).astype(float), 0.28125 if dims == 2 else 0.25),
    ):
        estimates = values.mean(axis=1)
        error = max(estimates.std() / np.sqrt(4000), 1e-12)
        assert abs(estimates.mean() - integral) < 4.5 * error
