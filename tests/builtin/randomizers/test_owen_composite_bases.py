"""Owen's scrambling where the base is no prime: each node of the tree of digits still permutes."""

import numpy as np
import pytest

import samplekit


@pytest.mark.parametrize("base", [4, 6, 8, 9, 10, 12, 100])
def test_owen_keeps_the_strata_of_composite_bases(base):
    points = samplekit.points(f"van-der-corput:base={base}+owen", base, 1, realizations=1000)[:, :, 0]
    assert (np.sort(np.floor(points * base), axis=1) == np.arange(base)).all()


@pytest.mark.parametrize("base", [4, 6, 9, 10])
def test_owen_in_composite_bases_has_the_variance_of_strata(base):
    n = base**2
    estimates = samplekit.points(f"van-der-corput:base={base}+owen", n, 1, realizations=5000)[:, :, 0].mean(axis=1)
    assert estimates.var() == pytest.approx(1 / (12 * n**3), rel=0.1)
