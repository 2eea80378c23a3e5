"""Which cell a float64 is in, against exact fractions; promises against their definitions."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

from samplekit import GridStrata, LatinStrata, MinimumDistance, Net, OrthogonalArray
from samplekit._errors import UsageError
from samplekit._specs.point_cells import cell_of, closest_pair, find_uneven_cell
from samplekit._specs.promise import Cells

ALMOST_ONE = 1 - 2.0**-53


def nearest_float(fraction):
    """The float64 nearest to a fraction: Python divides integers with one rounding."""
    return fraction.numerator / fraction.denominator


@pytest.mark.parametrize("cells", [1, 2, 3, 5, 7, 9, 10, 27, 81, 97, 1000, 1024, 3**10, 2**20, 10**6 + 3])
def test_cell_is_the_one_whose_rounded_boundaries_hold_the_value(cells):
    rng = np.random.default_rng(cells)
    chosen = rng.integers(0, cells, 40)
    boundaries = np.array([nearest_float(Fraction(int(c), cells)) for c in chosen])
    x = np.concatenate(
        [boundaries, np.nextafter(boundaries, 1.0), np.maximum(np.nextafter(boundaries, 0.0), 0.0), rng.random(200)]
    )
    x = np.append(x, [0.0, ALMOST_ONE])
    for value, cell in zip(x, cell_of(x, cells), strict=True):
        assert nearest_float(Fraction(int(cell), cells)) <= value
        assert value < nearest_float(Fraction(int(cell) + 1, cells))


@pytest.mark.parametrize("base", [3, 5, 7])
def test_correctly_rounded_fractions_are_in_their_cells(base):
    """k/b^j rounded to float64 can lie below the fraction: it is in the cell of the fraction all the same."""
    power = base**6
    x = np.array([k / power for k in range(power)])
    for q in range(7):
        exact = np.array([k * base**q // power for k in range(power)])
        assert (cell_of(x, base**q) == exact).all()


def test_values_that_fall_short_of_a_boundary_are_told():
    short = np.nextafter(2 / 3, 0.0)
    assert cell_of(np.array([short]), 3)[0] == 1
    assert cell_of(np.array([np.nextafter(short, 1.0)]), 3)[0] == 2


def points_in_box(points, base, shape, cell):
    """By the definition, in exact arithmetic; the coordinates are multiples of a power of the base."""
    return sum(
        all(Fraction(c, base**q) <= x < Fraction(c + 1, base**q) for x, q, c in zip(point, shape, cell, strict=True))
        for point in points
    )


def is_net(points, base, t):
    m = round(np.log(len(points)) / np.log(base))
    return all(
        points_in_box(points, base, shape, cell) == base**t
        for shape in itertools.product(range(m - t + 1), repeat=len(points[0]))
        if sum(shape) == m - t
        for cell in itertools.product(*(range(base**q) for q in shape))
    )


def mirrored(index, base):
    value, weight = Fraction(0), Fraction(1, base)
    while index:
        index, digit = divmod(index, base)
        value += digit * weight
        weight /= base
    return value


@pytest.mark.parametrize(("base", "m"), [(2, 1), (2, 4), (3, 2), (3, 3), (5, 2)])
def test_nets_are_recognised_as_the_definition_has_them(base, m):
    count = base**m
    net = [(Fraction(i, count), mirrored(i, base)) for i in range(count)]
    rng = np.random.default_rng(m)
    broken = [*net[:-1], (net[-1][0], net[0][1])]
    shuffled = [(x, y) for (x, _), (_, y) in zip(net, rng.permutation(np.array(net, object)), strict=True)]
    for points in (net, broken, shuffled):
        values = np.array([[nearest_float(Fraction(x)) for x in p] for p in points])
        for t in range(m + 1):
            assert (Net(base=base, t=t).find_violation(values) is None) == is_net(points, base, t)


def test_a_broken_box_is_named():
    # Four points of which two share the left lower quarter.
    points = np.array([[0.1, 0.2, 0.6, 0.9], [0.1, 0.2, 0.6, 0.9]]).T
    found = Net().find_violation(points)
    assert found.axes == (0, 1)
    inside = [(points[:, axis] >= low) & (points[:, axis] < high) for axis, (low, high) in enumerate(found.box)]
    assert tuple(np.flatnonzero(inside[0] & inside[1])) == found.points
    assert len(found.points) > 1
    assert str(found) == (
        "the cell [0/1, 1/1) x [0/4, 1/4) of dimensions 0, 1 holds 2 points, expected 1; 1 of 4 cells are empty (net)"
    )


def test_every_shape_is_tried():
    shapes = {(0, 3), (1, 2), (2, 1), (3, 0)}
    assert {cells.sides for cells in Net().cells(8, 2)} == {(2**p, 2**q) for p, q in shapes}
    assert len(list(Net((0, 1, 2)).cells(64, 3))) == 28
    # A quarter of the points to a cell, and a net of which only two dimensions are there.
    assert {cells.sides for cells in Net((0, 1, 2), t=2).cells(16, 2)} == {(1, 4), (2, 2), (4, 1)}


def test_nothing_is_promised_of_other_counts_and_dimensions():
    for promise, count, dims in (
        (Net(), 48, 2),
        (Net(t=3), 4, 2),
        (Net((2, 3)), 16, 2),
        (LatinStrata((2,)), 16, 2),
        (GridStrata(), 97, 2),
        (GridStrata(block=3), 27, 2),
        (OrthogonalArray(), 50, 3),
        (MinimumDistance(0.7), 16, 2),
    ):
        assert list(promise.cells(count, dims)) == []
        assert promise.caption(count, dims) == ""
    assert Net().find_violation(np.full((48, 2), 0.5)) is None


def test_cells_of_strata():
    assert list(LatinStrata().cells(7, 2)) == [((0,), (7,)), ((1,), (7,))]
    assert list(GridStrata().cells(96, 4)) == [((0, 1, 2, 3), (4, 4, 3, 2))]
    assert list(GridStrata(block=2).cells(96, 5)) == [((0, 1), (12, 8)), ((2, 3), (12, 8))]
    assert list(OrthogonalArray().cells(9, 3)) == [((0, 1), (3, 3)), ((0, 2), (3, 3)), ((1, 2), (3, 3))]
    # In fewer dimensions than the strength, each cell holds several points.
    assert list(OrthogonalArray(3).cells(27, 2)) == [((0, 1), (3, 3))]


def test_strata_count_each_set_alone():
    one_a_cell = np.array([[[0.1, 0.6], [0.1, 0.6]]]).transpose(0, 2, 1)
    two_in_one = np.array([[[0.1, 0.2], [0.1, 0.6]]]).transpose(0, 2, 1)
    grid = Cells((0,), (2,))
    assert find_uneven_cell(one_a_cell, [grid], "grid") is None
    found = find_uneven_cell(np.concatenate([one_a_cell, two_in_one]), [grid], "grid")
    assert (found.realization, found.axes, found.box, found.points) == (1, (0,), ((0.0, 0.5),), (0, 1))
    assert str(found).endswith("expected 1; 1 of 2 cells are empty (grid)")
    violation = LatinStrata().find_violation(np.concatenate([one_a_cell, two_in_one]))
    assert (violation.realization, violation.points, violation.axes) == (1, (0, 1), (0,))
    assert violation.box == ((0.0, 0.5),)


def test_points_are_one_set_or_several():
    assert LatinStrata().find_violation([[0.1, 0.6], [0.6, 0.1]]) is None
    for wrong in ([0.1, 0.6], [[[[0.1]]]]):
        with pytest.raises(UsageError, match="points must be"):
            LatinStrata().find_violation(wrong)
        with pytest.raises(UsageError, match="points must be"):
            MinimumDistance(0.5).find_violation(wrong)


def test_distances_are_toroidal():
    points = np.array([[0.02, 0.5, 0.97], [0.5, 0.5, 0.5]])
    distance, i, j = closest_pair(points.T)
    assert (i, j) == (0, 2)
    assert distance == pytest.approx(0.05)
    rng = np.random.default_rng(1)
    points = rng.random((3, 40))
    images = [
        np.sqrt(((points[:, [i]] - points[:, [j]] - np.array([shift]).T) ** 2).sum())
        for i, j in itertools.combinations(range(40), 2)
        for shift in itertools.product((-1, 0, 1), repeat=3)
    ]
    assert closest_pair(points.T)[0] == pytest.approx(min(images))


def test_densest_packings():
    assert MinimumDistance(1.0).distance(7, 1) == pytest.approx(1 / 7)
    # The hexagonal lattice: 1.0746 / sqrt(N), and the face-centred cubic one: four points in a cube, sqrt(1/2) apart.
    assert MinimumDistance(1.0).distance(100, 2) == pytest.approx(0.10746, rel=1e-4)
    assert MinimumDistance(1.0).distance(4, 3) == pytest.approx(0.5**0.5)
    # D4: eight points in a cube of side 2 at distance sqrt 2... two in a unit cube, 1 apart.
    assert MinimumDistance(1.0).distance(2, 4) == pytest.approx(1.0)
    assert MinimumDistance(1.0).distance(9, 6) is None
    assert MinimumDistance(1.0).distance(1, 2) is None
    assert MinimumDistance(0.5).distance(7, 1) == pytest.approx(0.5 / 7)


def test_points_that_are_too_close_are_named():
    sets = [[[0.1, 0.5], [0.6, 0.5]], [[0.05, 0.5], [0.95, 0.5]]]
    found = MinimumDistance(0.5).find_violation(sets)
    assert (found.realization, found.points, found.box) == (1, (0, 1), ())
    assert str(found) == "two points are 0.1 apart, expected at least 0.379918"
