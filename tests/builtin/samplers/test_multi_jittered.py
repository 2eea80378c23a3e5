import numpy as np
import pytest
from scipy import stats

import samplekit


def lines(name, columns, rows, realizations, seed=0):
    """The sub-columns [R, row, column] and sub-rows [R, row, column] of the points, within their cells."""
    count = columns * rows
    points = samplekit.points(name, count, realizations=realizations, seed=seed)
    cells = np.floor(points * count).astype(int).reshape(realizations, rows, columns, 2)
    column, row = np.arange(columns), np.arange(rows)[:, None]
    sub_columns, sub_rows = cells[..., 0] - column * rows, cells[..., 1] - row * columns
    assert sub_columns.min() == 0
    assert sub_columns.max() == rows - 1
    assert sub_rows.min() == 0
    assert sub_rows.max() == columns - 1
    return sub_columns, sub_rows


SHAPES = [(1, 1), (2, 1), (3, 2), (8, 8), (12, 8), (32, 32), (33, 32), (45, 45), (53, 47), (64, 32)]


@pytest.mark.parametrize(("columns", "rows"), SHAPES)
def test_correlated_lines_share_one_permutation(columns, rows):
    sub_columns, sub_rows = lines("correlated-multi-jittered", columns, rows, 20)
    assert (sub_columns == sub_columns[:, :, :1]).all()
    assert (sub_rows == sub_rows[:, :1, :]).all()
    assert (np.sort(sub_columns[:, :, 0], axis=1) == np.arange(rows)).all()
    assert (np.sort(sub_rows[:, 0, :], axis=1) == np.arange(columns)).all()


@pytest.mark.parametrize(("columns", "rows"), SHAPES)
def test_uncorrelated_lines_are_permuted_on_their_own(columns, rows):
    sub_columns, sub_rows = lines("multi-jittered", columns, rows, 20)
    assert (np.sort(sub_columns, axis=1) == np.arange(rows)[:, None]).all()
    assert (np.sort(sub_rows, axis=2) == np.arange(columns)).all()
    if rows > 7:
        orders = {tuple(one[:, column]) for one in sub_columns for column in range(columns)}
        assert len(orders) == 20 * columns


@pytest.mark.parametrize("name", ["multi-jittered", "correlated-multi-jittered"])
def test_permutations_within_lines_are_uniform(name):
    """Where rows 0 and 1 of a column go, jointly, for 8 x 8 points: false alarms 1e-4 each."""
    sub_columns, sub_rows = lines(name, 8, 8, 20000, seed=1)
    for first, second in ((sub_columns[:, 0, 3], sub_columns[:, 1, 3]), (sub_rows[:, 2, 0], sub_rows[:, 2, 5])):
        pairs = np.bincount(first * 8 + second, minlength=64).reshape(8, 8)
        assert stats.chisquare(pairs[~np.eye(8, dtype=bool)]).pvalue > 1e-4


def test_sub_columns_and_sub_rows_are_independent():
    """Joint counts of a point's sub-column and sub-row, and of sub-columns of two columns: false alarms 1e-4 each."""
    sub_columns, sub_rows = lines("multi-jittered", 8, 8, 20000, seed=2)
    for first, second in (
        (sub_columns[:, 2, 3], sub_rows[:, 2, 3]),
        (sub_columns[:, 3, 3], sub_rows[:, 3, 3]),
        (sub_columns[:, 0, 0], sub_columns[:, 0, 1]),
        (sub_columns[:, 0, 0], sub_columns[:, 5, 7]),
    ):
        assert stats.chisquare(np.bincount(first * 8 + second, minlength=64)).pvalue > 1e-4


@pytest.mark.parametrize("count", [64, 1056])
@pytest.mark.parametrize("name", ["multi-jittered", "correlated-multi-jittered"])
def test_pairs_of_dimensions_are_visited_in_orders_of_their_own(name, count):
    """Correlations across pairs of dimensions, 480 of them, within 4.5 standard errors: false alarms 3e-3 each."""
    realizations = 40
    points = samplekit.points(name, count, 6, realizations=realizations, seed=3)
    correlations = [
        np.corrcoef(one[:, a], one[:, b])[0, 1]
        for one in points
        for a in range(6)
        for b in range(a + 1, 6)
        if a // 2 != b // 2
    ]
    assert np.abs(correlations).max() < 4.5 / np.sqrt(count)
    again = samplekit.points(name, count, 2, realizations=realizations, seed=3)
    assert np.array_equal(again, points[:, :, :2])
