"""Owen-scrambled Sobol points in blocks of four: any number of dimensions, blocks that know nothing of each other."""

import numpy as np
import pytest

import samplekit
from samplekit.kernels._padded_sequence import group_tables


@pytest.mark.parametrize("dims", [1, 3, 4, 5, 1001])
def test_any_number_of_dimensions(dims):
    points = samplekit.points("owen-sobol", 16, dims, realizations=2)
    strata = np.sort(np.floor(points * 16).astype(int), axis=1)
    assert (strata == np.arange(16)[:, None]).all()


def test_a_prefix_is_a_set_of_its_own_and_large_indices_are_their_own_points():
    whole = samplekit.points("owen-sobol", 5000, 9, realizations=2, seed=3)
    for count in (1, 3, 64, 2048, 2049):
        assert np.array_equal(samplekit.points("owen-sobol", count, 9, realizations=2, seed=3), whole[:, :count])
    far = samplekit.sampler("owen-sobol").points(2**32, 4, start=2**32 - 5000, seed=3)[0]
    assert np.unique(np.concatenate([far, whole[0, :, :4]]), axis=0).shape[0] == 10000


def test_blocks_are_shuffled_on_their_own():
    """Points 0 and 2 of Sobol's second dimension share a half; after a shuffle by chance, and in each block its own."""
    halves = samplekit.points("owen-sobol", 4, 12, realizations=4000, seed=8) >= 0.5
    shared = halves[:, 0, 1::4] == halves[:, 2, 1::4]
    assert np.abs(shared.mean(axis=0) - 0.5).max() < 0.05
    assert abs(np.corrcoef(shared[:, 0], shared[:, 1])[0, 1]) < 0.07


def test_tables_add_up_to_the_matrices():
    rng = np.random.default_rng(0)
    columns = rng.integers(0, 2**32, (3, 32), np.uint32)
    tables = group_tables(columns)
    for index in [0, 1, 2**11, 2**22 - 1, 2**32 - 1, *rng.integers(0, 2**32, 50).tolist()]:
        for dimension in range(3):
            expected = 0
            for bit in range(32):
                expected ^= int(columns[dimension, bit]) * (index >> bit & 1)
            groups = (index & 2047, index >> 11 & 2047, index >> 22)
            found = 0
            for group, low in enumerate(groups):
                found ^= int(tables[dimension, group, low])
            assert f"{found:032b}"[::-1] == f"{expected:032b}"
