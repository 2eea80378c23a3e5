import numpy as np
import pytest
from scipy import stats

import samplekit


@pytest.mark.parametrize("count", [1, 16, 97, 2000])
def test_n_rooks_is_the_latin_hypercube_in_two_dimensions(count):
    rooks = samplekit.points("n-rooks", count, realizations=3, seed=4)
    assert np.array_equal(rooks, samplekit.points("latin-hypercube", count, realizations=3, seed=4))


def test_cells_and_places_are_uniform():
    """The cell of point 0 against the cell of point 1, and the place in the cell: false alarms 1e-4 each."""
    points = samplekit.points("latin-hypercube", 16, 1, realizations=30000, seed=1)[:, :, 0] * 16
    cells = np.floor(points).astype(int)
    pairs = np.bincount(cells[:, 0] * 16 + cells[:, 1], minlength=256).reshape(16, 16)
    assert not pairs.diagonal().any()
    assert stats.chisquare(pairs[~np.eye(16, dtype=bool)]).pvalue > 1e-4
    assert stats.kstest((points - cells)[:, 3], "uniform").pvalue > 1e-4


@pytest.mark.parametrize("count", [100, 2000])
def test_dimensions_are_permuted_on_their_own(count):
    """Correlations of all pairs of 8 dimensions over 20 sets: within 4.5 standard errors, false alarms 4e-3."""
    points = samplekit.points("latin-hypercube", count, 8, realizations=20, seed=2)
    correlations = [np.corrcoef(one.T)[np.triu_indices(8, 1)] for one in points]
    assert np.abs(correlations).max() < 4.5 / np.sqrt(count)


def test_the_variance_of_an_additive_integrand():
    """Strata in each dimension: f = x + y + z has variance 3 / (12 N^3); 10000 estimates, 5 standard errors."""
    estimates = samplekit.points("latin-hypercube", 20, 3, realizations=10000).sum(axis=2).mean(axis=1)
    assert estimates.var() * 4 * 20**3 == pytest.approx(1.0, abs=5 * np.sqrt(2 / 10000))


def test_the_variance_of_a_product():
    """Only the part that is no sum of functions of one coordinate remains: xy leaves 1/144 / N, and a little of 1/N^2.

    20000 estimates of variance, 5 standard errors of 1 % and the second term, below 2 / N.
    """
    count = 100
    estimates = samplekit.points("latin-hypercube", count, 2, realizations=20000, seed=5).prod(axis=2).mean(axis=1)
    assert estimates.var() * 144 * count == pytest.approx(1.0, abs=0.05 + 2 / count)
