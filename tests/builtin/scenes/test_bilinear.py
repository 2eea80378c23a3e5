import itertools
from fractions import Fraction

import numpy as np
import pytest

from samplekit._builtin.scenes.bilinear import Bilinear


def identity_means(edges):
    """Means of x in rational arithmetic, from its integral x^2 / 2."""
    places = [Fraction(edge) for edge in edges.tolist()]
    return [(b * b - a * a) / 2 / (b - a) for a, b in itertools.pairwise(places)]


def test_exact_against_rational_arithmetic():
    rng = np.random.default_rng(1)
    start = rng.random(12)
    edges = np.unique([0.0, 1.0, *start, *(start + 1e-6), *(start + 10 ** rng.uniform(-9, -1, 12)), 1e-300, 5e-324])
    means = identity_means(edges)
    assert len(means) ** 2 >= 1000
    exact = Bilinear().exact(edges, edges)
    for j, i in np.ndindex(exact.shape):
        mean = means[j] * means[i]
        assert abs(Fraction(exact[j, i]) - mean) <= max(Fraction(1e-15) * mean, Fraction(5e-324)), (i, j)


@pytest.mark.parametrize("count", [1, 7, 64, 1024])
def test_sums_against_numpy(count, boxes_of, sums):
    edges = np.arange(6) / 5
    boxes = boxes_of(edges, edges)
    tile = np.random.default_rng(count).random((25, 2, count))
    x = boxes[0][:, None] + tile[:, 0] * boxes[1][:, None]
    y = boxes[2][:, None] + tile[:, 1] * boxes[3][:, None]
    np.testing.assert_allclose(sums(Bilinear(), tile, boxes), (x * y).sum(axis=1), rtol=1e-12)


def test_nothing_is_claimed_constant():
    edges = np.arange(5) / 4
    assert np.isnan(Bilinear().constant(edges, edges)).all()
