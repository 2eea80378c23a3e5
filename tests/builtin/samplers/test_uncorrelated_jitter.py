from collections import Counter

import numpy as np
import pytest

import samplekit
from samplekit._bases.realizations import Realizations
from samplekit._builtin.samplers.grid import block_sizes
from samplekit._specs.counts import grid_sides

REALIZATIONS = 100


def cell(x, cells):
    numerator, denominator = float(x).as_integer_ratio()
    return numerator * cells // denominator


def filled(count, dims, blocks=(), realizations=REALIZATIONS, seed=0, start=0, stop=None):
    sampler = samplekit.sampler("uncorrelated-jitter")
    out = np.empty((realizations, dims, (count if stop is None else stop) - start))
    sampler.fill(out, sampler.trials(0, realizations, seed, blocks), count, start)
    return out


@pytest.mark.parametrize(
    ("count", "dims", "blocks", "grids"),
    [
        (1, 5, (), [2, 2, 1]),
        (12, 4, (), [2, 2]),
        (96, 5, (2, 2, 1), [2, 2, 1]),
        (36, 3, (1, 2), [1, 2]),
        (100, 5, (2, 3), [2, 3]),
        (64, 4, (), [2, 2]),
        (2048, 3, (2, 1), [2, 1]),
    ],
)
def test_every_block_has_one_point_in_each_cell_of_its_grid(count, dims, blocks, grids):
    points = filled(count, dims, blocks, REALIZATIONS if count < 1000 else 3)
    for set_ in points:
        first = 0
        for size in grids:
            sides = grid_sides(count, size)
            cells = Counter(
                tuple(cell(x, side) for x, side in zip(point, sides, strict=True))
                for point in set_[first : first + size].T
            )
            assert len(cells) == count
            assert set(cells.values()) == {1}
            first += size


def test_blocks_are_the_scenes_cut_or_continued_by_pairs():
    assert block_sizes(5, ()) == [2, 2, 1]
    assert block_sizes(5, (2, 2, 1)) == [2, 2, 1]
    assert block_sizes(5, (1, 3)) == [1, 3, 1]
    assert block_sizes(4, (1, 4)) == [1, 3]
    assert block_sizes(1, (2,)) == [1]


def test_blocks_before_do_not_change_when_later_blocks_are_dropped():
    whole = filled(36, 5, (2, 2, 1))
    assert np.array_equal(whole[:, :2], filled(36, 2, (2,)))
    assert np.array_equal(whole[:, :4], filled(36, 4, (2, 2)))
    assert np.array_equal(whole[:, :2], filled(36, 2))


@pytest.mark.parametrize("count", [36, 1600])
def test_two_dimensions_are_jittered_sampling(count):
    jittered = samplekit.points("jittered", count=count, realizations=3, seed=4)
    assert np.array_equal(samplekit.points("uncorrelated-jitter", count=count, realizations=3, seed=4), jittered)


def test_orders_differ_between_blocks_and_between_realisations():
    cells = np.floor(filled(64, 6) * 8)
    orders = {tuple(cells[r, d : d + 2].ravel()) for r in range(REALIZATIONS) for d in (2, 4)}
    assert len(orders) == 2 * REALIZATIONS


def test_blocks_are_not_correlated():
    points = filled(256, 5)
    centred = points - points.mean(axis=2, keepdims=True)
    covariance = np.einsum("rin,rjn->ij", centred, centred) / (REALIZATIONS * 256)
    correlation = covariance * 12
    across = [correlation[i, j] for i in range(5) for j in range(i) if i // 2 != j // 2]
    assert np.abs(across).max() < 4 / np.sqrt(REALIZATIONS * 256)


@pytest.mark.parametrize("count", [96, 2048])
def test_slices_equal_the_whole(count):
    whole = filled(count, 5, realizations=3)
    for start, stop in [(0, 1), (1, 8), (count - 5, count), (7, count // 2)]:
        assert np.array_equal(filled(count, 5, realizations=3, start=start, stop=stop), whole[:, :, start:stop])


def test_realisations_do_not_depend_on_their_order():
    sampler = samplekit.sampler("uncorrelated-jitter")
    everything = sampler.trials(0, 7, 3)
    backwards = Realizations(everything.keys[::-1].copy(), everything.x[::-1], everything.y[::-1], 3)
    ahead, behind = np.empty((7, 5, 36)), np.empty((7, 5, 36))
    sampler.fill(ahead, everything, 36, 0)
    sampler.fill(behind, backwards, 36, 0)
    assert np.array_equal(ahead, behind[::-1])


def test_seeds_give_other_points():
    assert not np.intersect1d(filled(36, 4, seed=1), filled(36, 4, seed=2)).size


def test_a_count_that_is_no_grid_names_the_nearest():
    with pytest.raises(samplekit.UsageError, match=r"two near-equal sides .* not 97: the nearest are 96 and 98"):
        samplekit.points("uncorrelated-jitter", count=97)


def test_a_block_that_has_no_grid_names_what_fits_all_blocks():
    sampler = samplekit.sampler("uncorrelated-jitter")
    sampler.check(100, 5, (2, 3))
    with pytest.raises(samplekit.UsageError, match=r"block of 3 .* not 91: .* blocks of 2, 3 are 90 and 96"):
        sampler.check(91, 5, (2, 3))
    with pytest.raises(samplekit.UsageError, match="91 points do not form a grid"):
        filled(91, 3, (3,))
