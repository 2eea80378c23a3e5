"""Fits: exact laws are found exactly, intervals cover the truth, and scatter about the law widens them."""

import numpy as np
import pytest

from samplekit._study.fit import fit_line

COUNTS = [2**k for k in range(4, 11)]


def influences(squares):
    mean = squares.mean(axis=-1, keepdims=True)
    return list((squares - mean) / (mean * squares.shape[-1]))


def test_exact_law():
    slope, constant, scatter = fit_line(COUNTS, [0.3 * n**-1.5 for n in COUNTS], [None] * 7)
    assert slope.estimate == pytest.approx(-1.5, abs=1e-12)
    assert constant == pytest.approx(0.3)
    assert scatter == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("shared", [False, True])
def test_slope_is_covered(shared):
    # 400 studies of 100 trials each: at a true 95 % the share has a standard deviation of 1.1 %.
    rng = np.random.default_rng(7)
    hits = 0
    for _ in range(400):
        errors = rng.standard_normal((7, 100))
        if shared:
            # As prefixes of one sequence: neighbours have half of their samples in common.
            errors[1:] = np.sqrt(0.5) * errors[:-1] + np.sqrt(0.5) * errors[1:]
        squares = errors**2 / np.array(COUNTS)[:, None]
        slope, _, _ = fit_line(COUNTS, squares.mean(axis=1), influences(squares))
        hits += slope.low <= -1.0 <= slope.high
    assert 0.90 <= hits / 400 <= 0.99


def test_wobble_widens_the_interval():
    rng = np.random.default_rng(8)
    wobble = np.exp(0.3 * np.array([1, -1, 1, -1, 1, -1, 1]))
    squares = (1.0 + 0.01 * rng.standard_normal((7, 50))) / np.array(COUNTS)[:, None] * wobble[:, None]
    slope, _, scatter = fit_line(COUNTS, squares.mean(axis=1), influences(squares))
    assert scatter == pytest.approx(0.3, rel=0.4)
    assert slope.low < -1.0 < slope.high
    assert slope.high - slope.low > 0.1


def test_two_rows_have_a_slope_and_one_has_none():
    squares = np.random.default_rng(9).chisquare(1, (2, 30)) / np.array([[1.0], [4.0]])
    slope, _, _ = fit_line([1, 4], squares.mean(axis=1), influences(squares))
    assert slope.low is not None
    slope, _, _ = fit_line([4, 16], [1.0, 0.25], [None, None])
    assert slope.low is None
    assert fit_line([4], [1.0], [None]) is None


def test_a_line_that_leaves_the_range_of_floats_has_no_constant():
    slope, constant, _ = fit_line([1000, 1024], [1e-7, 1e-22], [None, None])
    assert slope.estimate < -1000.0
    assert constant is None
