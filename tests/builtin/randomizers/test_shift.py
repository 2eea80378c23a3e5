import itertools

import numpy as np
import pytest

import samplekit


def wrapped(difference):
    return np.abs(difference - np.rint(difference))


@pytest.mark.parametrize("name", ["sobol", "regular", "jittered", "halton", "random", "latin-hypercube"])
def test_all_points_of_a_set_move_by_the_same_vector(name):
    plain = samplekit.points(name, 64, 3, realizations=20, seed=1)
    moved = samplekit.points(f"{name}+shift", 64, 3, realizations=20, seed=1)
    vectors = moved - plain
    assert wrapped(vectors - vectors[:, :1]).max() <= 2.0**-52
    assert np.unique(vectors[:, 0]).size == 60


def test_the_vector_depends_on_realisation_and_dimension_alone():
    """Not on the sampler, the count or the number of dimensions."""
    vectors = [
        samplekit.points(f"{name}+shift", count, dims, realizations=5, seed=2)[:, 0, :2]
        for name, count, dims in (("sobol", 16, 2), ("sobol", 64, 5), ("halton", 7, 2), ("hammersley", 100, 3))
    ]
    assert all(np.array_equal(one, other) for one, other in itertools.combinations(vectors, 2))


def test_vectors_are_uniform_and_independent():
    """Point 0 of Sobol' is 0, so that its image is the vector: 20000 of them, 5 standard errors (false alarms 2e-5)."""
    vectors = samplekit.points("sobol+shift", 1, 8, realizations=20000, seed=3)[:, 0]
    assert np.abs(vectors.mean(axis=0) - 0.5).max() < 5 * np.sqrt(1 / 12 / 20000)
    assert np.abs((vectors**2).mean(axis=0) - 1 / 3).max() < 5 * np.sqrt(4 / 45 / 20000)
    correlations = np.corrcoef(vectors.T)[np.triu_indices(8, 1)]
    assert np.abs(correlations).max() < 5 / np.sqrt(20000)


def test_a_coordinate_that_reaches_one_wraps_to_the_left():
    """Where x + shift is just below, at or above 1, nothing but [0, 1) comes out."""
    from samplekit._builtin.randomizers.shift import Shift

    realizations = samplekit.sampler("random").trials(0, 500, 4)
    zero = np.zeros((500, 1, 1))
    Shift().apply(zero, realizations, (2,))
    shift = zero[:, 0, 0]
    for steps in (-3, -2, -1, 0, 1, 2, 3):
        points = np.clip((1.0 - shift) + steps * 2.0**-53, 0.0, np.nextafter(1.0, 0.0))[:, None, None].copy()
        Shift().apply(points, realizations, (2,))
        assert points.min() >= 0.0
        assert points.max() < 1.0
        assert wrapped(points).max() < 2.0**-50
    largest = np.full((500, 1, 1), np.nextafter(1.0, 0.0))
    Shift().apply(largest, realizations, (2,))
    assert largest.max() < 1.0
    assert wrapped(largest[:, 0, 0] - shift).max() <= 2.0**-52


def test_a_shifted_grid_keeps_its_spectrum_and_is_unbiased():
    """A comb: frequencies that the grid sees keep power 1 and have random phase, the others vanish."""
    points = samplekit.points("regular+shift", 64, realizations=2000, seed=5)
    seen = np.exp(-2j * np.pi * 8 * points[:, :, 0]).mean(axis=1)
    unseen = np.exp(-2j * np.pi * 3 * points[:, :, 1]).mean(axis=1)
    assert np.abs(np.abs(seen) - 1.0).max() < 1e-12
    assert np.abs(unseen).max() < 1e-14
    assert abs(seen.mean()) < 5 / np.sqrt(2000)
