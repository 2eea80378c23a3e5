import mpmath
import numpy as np
import pytest

from samplekit.kernels._polynomials import disk_point


def in_mpmath(u, v):
    with mpmath.workdps(40):
        a, b = 2 * mpmath.mpf(u) - 1, 2 * mpmath.mpf(v) - 1
        if a == 0 and b == 0:
            return 0, 0
        if abs(a) > abs(b):
            return a * mpmath.cos(mpmath.pi / 4 * b / a), a * mpmath.sin(mpmath.pi / 4 * b / a)
        return b * mpmath.sin(mpmath.pi / 4 * a / b), b * mpmath.cos(mpmath.pi / 4 * a / b)


def test_against_40_digits():
    rng = np.random.default_rng(1)
    points = [*rng.random((2000, 2)).tolist(), (0.5, 0.5), (0.0, 0.0), (0.5, 0.0), (0.25, 0.75), (1 - 2**-53, 0.0)]
    for u, v in points:
        x, y = disk_point(u, v)
        true_x, true_y = in_mpmath(u, v)
        assert abs(x - true_x) <= 3e-16, (u, v)
        assert abs(y - true_y) <= 3e-16, (u, v)
        assert x * x + y * y <= 1.0 + 2.0**-50


def test_equal_areas_and_squares_become_circles():
    # The square of side s about the middle goes to the disk of radius s: the area's share is s^2 in both.
    for side in (0.1, 0.5, 0.9):
        for along in np.linspace(-1, 1, 9):
            x, y = disk_point(0.5 + 0.5 * side, 0.5 + 0.5 * side * along)
            assert np.hypot(x, y) == pytest.approx(side, rel=1e-15)
            # The angle grows evenly along the side: equal areas within a ring.
            assert np.arctan2(y, x) == pytest.approx(np.pi / 4 * along, abs=1e-15)
