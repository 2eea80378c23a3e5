from itertools import combinations

import numpy as np
import pytest

import samplekit
from samplekit import LatinStrata, OrthogonalArray, PrimePowers

REALIZATIONS = 100
STYLES = ("jittered", "multi-jittered", "correlated")


def text(strength, offset):
    return f"orthogonal-array:strength={strength},offset={offset}"


def cell(x, cells):
    numerator, denominator = float(x).as_integer_ratio()
    return numerator * cells // denominator


def cells_of(points, cells):
    return np.array([cell(x, cells) for x in points.ravel()]).reshape(points.shape)


@pytest.mark.parametrize("offset", STYLES)
@pytest.mark.parametrize(("strength", "s", "dims"), [(2, 2, 3), (2, 3, 4), (2, 5, 6), (3, 2, 3), (3, 3, 4)])
def test_all_cells_of_all_projections_hold_one_point(strength, s, dims, offset):
    count = s**strength
    points = samplekit.points(text(strength, offset), count=count, dims=dims, realizations=REALIZATIONS)
    assert points.min() >= 0.0
    assert points.max() < 1.0
    for set_ in points:
        cells = cells_of(set_, s)
        for axes in combinations(range(dims), strength):
            assert len({tuple(row) for row in cells[:, axes]}) == count
        if offset != "jittered":
            assert (np.sort(cells_of(set_, count), axis=0) == np.arange(count)[:, None]).all()


@pytest.mark.parametrize("offset", STYLES)
@pytest.mark.parametrize(("strength", "s", "dims"), [(2, 37, 38), (2, 1009, 3), (3, 11, 12), (3, 67, 4)])
def test_large_arrays_as_well(strength, s, dims, offset):
    # Beyond 1024 points, and beyond 4096 sub-strata, permutations are computed, not looked up.
    count = s**strength
    points = samplekit.points(text(strength, offset), count=count, dims=dims, seed=3)[0]
    cells = np.floor(points * s).astype(np.int64)
    for axes in [*combinations(range(min(dims, 4)), strength), tuple(range(dims - strength, dims))]:
        assert np.bincount(cells[:, axes] @ s ** np.arange(strength)).tolist() == [1] * count
    if offset != "jittered":
        assert (np.sort(np.floor(points * count), axis=0) == np.arange(count)[:, None]).all()


@pytest.mark.parametrize("strength", [2, 3])
def test_a_pair_or_triple_shares_its_offsets_if_correlated(strength):
    s = {2: 7, 3: 5}[strength]
    count = s**strength
    for offset, shared in (("correlated", True), ("multi-jittered", False)):
        points = samplekit.points(text(strength, offset), count=count, dims=2 * strength, seed=1)[0]
        cells, fine = np.floor(points * s).astype(int), np.floor(points * count).astype(int) % s ** (strength - 1)
        for first in (0, strength):
            others = tuple(range(first + 1, first + strength))
            found = {}
            for row in range(count):
                found.setdefault(tuple(cells[row, others]), set()).add(fine[row, first])
            assert all(len(offsets) == 1 for offsets in found.values()) == shared


def test_the_first_dimensions_do_not_depend_on_their_number():
    for offset in STYLES:
        whole = samplekit.points(text(2, offset), count=49, dims=8, realizations=5)
        assert np.array_equal(samplekit.points(text(2, offset), count=49, dims=3, realizations=5), whole[:, :, :3])


@pytest.mark.parametrize("offset", STYLES)
@pytest.mark.parametrize(("strength", "count"), [(2, 49), (2, 1369), (3, 125), (3, 1331)])
def test_slices_equal_whole_arrays(strength, count, offset):
    sampler = samplekit.sampler(text(strength, offset))
    whole = sampler.points(count, 5, realizations=2, seed=9)
    for start, stop in [(0, 1), (1, 8), (count - 5, count), (7, count // 2)]:
        part = sampler.points(count, 5, realizations=2, seed=9, start=start, stop=stop)
        assert np.array_equal(part, whole[:, start:stop])


def test_sets_do_not_depend_on_the_order_in_which_they_are_asked_for():
    sampler = samplekit.sampler("orthogonal-array")
    everything = sampler.trials(0, 7, 3)
    whole = np.empty((7, 4, 49))
    sampler.fill(whole, everything, 49, 0)
    for first in range(7):
        alone = np.empty((1, 4, 49))
        sampler.fill(alone, everything[first : first + 1], 49, 0)
        assert np.array_equal(alone[0], whole[first])


def test_every_place_is_as_likely_as_any_other():
    # 31 bins are no multiple of 7: chi-square with 30 degrees of freedom, beyond 67 with probability 1e-4.
    for offset in STYLES:
        points = samplekit.points(text(2, offset), count=49, dims=4, realizations=2000, seed=6)
        for index in (0, 24, 48):
            for dim in range(4):
                bins = np.bincount((points[:, index, dim] * 31).astype(int), minlength=31)
                assert ((bins - 2000 / 31) ** 2).sum() / (2000 / 31) < 67


def test_correlated_pairs_integrate_smooth_functions_as_the_cube_of_the_count():
    def variance(count):
        points = samplekit.points("orthogonal-array", count=count, realizations=400, seed=5)
        return np.exp(-((points - 0.5) ** 2).sum(axis=2) / 0.045).mean(axis=1).var(ddof=1)

    slope = np.log(variance(1369) / variance(49)) / np.log(1369 / 49)
    assert -3.2 < slope < -2.8


def test_declarations_follow_the_options():
    assert samplekit.sampler("orthogonal-array").spec.promises == (OrthogonalArray(2), LatinStrata())
    three = samplekit.sampler("orthogonal-array:strength=3,offset=jittered").spec
    assert three.promises == (OrthogonalArray(3),)
    assert three.counts == PrimePowers(3)


@pytest.mark.parametrize(
    ("options", "count", "dims", "message"),
    [
        ("", 50, 2, "squares of primes, not 50: the nearest are 49 and 121"),
        ("", 1, 2, "not 1: the nearest is 4"),
        ("", 64, 2, "the nearest are 49 and 121"),
        (":strength=3", 49, 2, "cubes of primes, not 49: the nearest are 27 and 125"),
        ("", 49, 9, r"49 = 7\^2 points has at most 8 dimensions, not 9: .* at least 121 points"),
        (":strength=3", 27, 20, r"27 = 3\^3 points has at most 4 dimensions, not 20: .* at least 6859 points"),
        ("", 49, 1, "at least 2 dimensions, not 1"),
        (":strength=4", 49, 2, "from 2 to 3"),
        (":offset=centred", 49, 2, "jittered or multi-jittered or correlated"),
    ],
)
def test_what_there_is_no_array_for_is_named(options, count, dims, message):
    with pytest.raises(samplekit.UsageError, match=message):
        samplekit.points("orthogonal-array" + options, count=count, dims=dims)


def test_the_largest_dimension_works():
    assert samplekit.points("orthogonal-array", count=49, dims=8).shape == (1, 49, 8)
