"""Sub-lines of multi-jittered sets too large to be shuffled: every pair of places is as likely as any other."""

import numpy as np
import pytest
from scipy import stats

import samplekit

REALIZATIONS = 65536


@pytest.mark.parametrize(("sublines", "count"), [(23, 1058), (32, 2048), (45, 2025), (64, 4096)])
def test_pairs_of_sublines_are_uniform(sublines, count):
    """Three chi-square tests for each count, each at 1e-5: a false alarm of 1.2e-4 in all."""
    sampler = samplekit.sampler("correlated-multi-jittered")

    def subline_of(row):
        index = row * (count // sublines)
        x = sampler.points(count, 2, realizations=REALIZATIONS, seed=1, start=index, stop=index + 1)[:, 0, 0]
        return np.floor(x * count).astype(int) % sublines

    first = subline_of(0)
    for row in (1, sublines // 2, sublines - 1):
        pairs = np.bincount(first * sublines + subline_of(row), minlength=sublines**2).reshape(sublines, sublines)
        assert not np.diag(pairs).any()
        assert stats.chisquare(pairs[~np.eye(sublines, dtype=bool)]).pvalue > 1e-5
