"""Which cell a float64 is in, against exact fractions; nets and strata against their definitions."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

from samplekit.testing._cells import cell_of, ulps_below
from samplekit.testing._distance import closest_pair, densest_distance
from samplekit.testing._nets import broken_box, shapes
from samplekit.testing._strata import broken_cell

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
    assert ulps_below(np.array([short]), 3)[0] == 1.0


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
        values = np.array([[[nearest_float(Fraction(p[axis])) for p in points] for axis in (0, 1)]])
        for t in range(m + 1):
            assert (broken_box(values, base, t) is None) == is_net(points, base, t)


def test_a_broken_box_is_named():
    # Four points of which two share the left lower quarter.
    points = np.array([[[0.1, 0.2, 0.6, 0.9], [0.1, 0.2, 0.6, 0.9]]])
    shape, row, cell = broken_box(points, 2, 0)
    inside = [cell_of(points[row, axis], 2 ** shape[axis]) == cell[axis] for axis in (0, 1)]
    assert int((inside[0] & inside[1]).sum()) > 1


def test_every_shape_is_tried():
    assert sorted(shapes(3, 2)) == [(0, 3), (1, 2), (2, 1), (3, 0)]
    assert len(list(shapes(6, 3))) == 28


def test_strata_count_each_set_alone():
    one_a_cell = np.array([[[0.1, 0.6], [0.1, 0.6]]])
    two_in_one = np.array([[[0.1, 0.2], [0.1, 0.6]]])
    assert broken_cell(one_a_cell, ((0,), (2,))) is None
    row, cell, inside = broken_cell(np.concatenate([one_a_cell, two_in_one]), ((0,), (2,)))
    assert (row, cell, inside.tolist()) == (1, (0,), [True, True])


def test_distances_are_toroidal():
    points = np.array([[0.02, 0.5, 0.97], [0.5, 0.5, 0.5]])
    distance, i, j = closest_pair(points)
    assert (i, j) == (0, 2)
    assert distance == pytest.approx(0.05)
    rng = np.random.default_rng(1)
    points = rng.random((3, 40))
    images = [
        np.sqrt(((points[:, [i]] - points[:, [j]] - np.array([shift]).T) ** 2).sum())
        for i, j in itertools.combinations(range(40), 2)
        for shift in itertools.product((-1, 0, 1), repeat=3)
    ]
    assert closest_pair(points)[0] == pytest.approx(min(images))


def test_densest_packings():
    assert densest_distance(7, 1) == pytest.approx(1 / 7)
    # The hexagonal lattice: 1.0746 / sqrt(N), and the face-centred cubic one: four points in a cube, sqrt(1/2) apart.
    assert densest_distance(100, 2) == pytest.approx(0.10746, rel=1e-4)
    assert densest_distance(4, 3) == pytest.approx(0.5**0.5)
    # D4: eight points in a cube of side 2 at distance sqrt 2... two in a unit cube, 1 apart.
    assert densest_distance(2, 4) == pytest.approx(1.0)
    assert densest_distance(9, 6) is None
