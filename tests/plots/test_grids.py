import pytest

from samplekit import GridStrata, LatinStrata, MinimumDistance, Net, OrthogonalArray
from samplekit.plots._grids import Grid, describe_grids, grid_of


def test_a_grid_over_all_dimensions_is_projected():
    # 96 = 4 x 4 x 3 x 2, longest first.
    assert grid_of((GridStrata(),), 96, 2, (0, 1)) == Grid((12, 8))
    assert grid_of((GridStrata(),), 96, 4, (0, 3)) == Grid((4, 2))
    assert grid_of((GridStrata(),), 96, 4, (2, 3)) == Grid((3, 2))
    assert grid_of((GridStrata(),), 10, 1, (0,)) == Grid((1, 1), (10, 1))


def test_a_grid_of_blocks_is_in_each_block_and_nowhere_else():
    promises = (GridStrata(block=2), LatinStrata())
    assert grid_of(promises, 96, 5, (0, 1)) == Grid((12, 8), (96, 96))
    assert grid_of(promises, 96, 5, (2, 3)) == Grid((12, 8), (96, 96))
    assert grid_of(promises, 96, 5, (1, 2)) == Grid((1, 1), (96, 96))
    # A block that the dimensions cut short.
    assert grid_of((GridStrata(block=3),), 27, 5, (3, 4)) == Grid()
    assert grid_of((GridStrata(block=3),), 27, 6, (3, 5)) == Grid((3, 3))


def test_latin_intervals_are_on_their_own_axes():
    assert grid_of((LatinStrata(dims=(0,)),), 7, 2, (0, 1)) == Grid((1, 1), (7, 1))
    assert grid_of((LatinStrata(),), 7, 1, (0,)) == Grid((1, 1), (7, 1))


@pytest.mark.parametrize(
    ("net", "count", "cells"),
    [
        (Net(), 64, (8, 8)),
        (Net(), 32, (8, 4)),
        (Net(), 2, (2, 1)),
        (Net(), 1, (1, 1)),
        (Net(), 48, (1, 1)),
        (Net(base=3), 81, (9, 9)),
        (Net(base=3), 64, (1, 1)),
        (Net(t=2), 64, (4, 4)),
        (Net(t=9), 64, (1, 1)),
        (Net(dims=(0, 1, 2), t=1), 32, (4, 4)),
    ],
)
def test_elementary_intervals_are_as_near_to_squares_as_can_be(net, count, cells):
    assert grid_of((net,), count, 3, (0, 1)) == Grid(cells)


def test_a_net_of_other_dimensions_is_seen_on_its_axes_alone():
    net = Net(dims=(0, 1))
    assert grid_of((net,), 16, 3, (1, 2)) == Grid((1, 1), (16, 1))
    assert grid_of((net,), 16, 3, (0, 2)) == Grid((1, 1), (16, 1))
    assert grid_of((Net(dims=(1,), base=3),), 27, 3, (0, 1)) == Grid((1, 1), (1, 27))
    assert grid_of((net,), 16, 1, (0,)) == Grid((1, 1), (16, 1))


def test_orthogonal_arrays_have_a_square_grid_in_every_pair():
    assert grid_of((OrthogonalArray(),), 49, 5, (1, 4)) == Grid((7, 7))
    assert grid_of((OrthogonalArray(strength=3),), 125, 5, (0, 2)) == Grid((5, 5))
    assert grid_of((OrthogonalArray(),), 50, 5, (1, 4)) == Grid()


def test_the_finest_promise_is_shown():
    assert grid_of((Net(t=2), GridStrata()), 64, 2, (0, 1)).cells == (8, 8)


def test_nothing_promised_is_no_grid_and_no_words():
    assert grid_of((), 64, 2, (0, 1)) == Grid()
    assert grid_of((MinimumDistance(0.7),), 64, 2, (0, 1)) == Grid()
    assert describe_grids((MinimumDistance(0.7),), 64, 2) == ""
    assert describe_grids((Net(),), 63, 2) == ""


@pytest.mark.parametrize(
    ("promises", "count", "dims", "words"),
    [
        ((GridStrata(),), 96, 2, "12 x 8 cells"),
        ((GridStrata(),), 96, 4, "4 x 4 x 3 x 2 cells"),
        ((LatinStrata(), GridStrata(block=2)), 16, 2, "16 intervals of each axis; 4 x 4 cells"),
        ((GridStrata(block=2),), 16, 4, "4 x 4 cells in each block of 2 dimensions"),
        ((LatinStrata(dims=(0,)), Net()), 64, 2, "64 intervals of x0; 8 x 8 elementary intervals in base 2"),
        ((Net(),), 64, 4, "8 x 8 elementary intervals in base 2 of x0, x1"),
        ((Net(dims=(0,)), Net(dims=(1,), base=3)), 64, 2, "64 intervals of x0"),
        ((LatinStrata(),), 8, 1, "8 intervals of x0"),
        ((OrthogonalArray(),), 49, 3, "7 x 7 cells of each pair"),
        ((GridStrata(),), 1, 2, ""),
    ],
)
def test_words(promises, count, dims, words):
    assert describe_grids(promises, count, dims) == words


def test_a_net_that_another_implies_is_not_spoken_of():
    promises = (Net(dims=(0, 1)), Net(dims=(0, 2), t=1), Net(dims=(0, 1, 2), t=1), Net(dims=(2,)))
    assert describe_grids(promises, 16, 2) == "4 x 4 elementary intervals in base 2"
    assert describe_grids(promises, 16, 3) == (
        "4 x 4 elementary intervals in base 2 of x0, x1; 4 x 2 elementary intervals in base 2; 16 intervals of x2"
    )
