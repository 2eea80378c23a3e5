import math

import mpmath
import numpy as np
import pytest

from samplekit.kernels._polynomials import exp_of_minus

RANDOM = np.random.default_rng(1)


@pytest.mark.parametrize(
    "x",
    [
        RANDOM.uniform(0, 1, 2000),
        RANDOM.uniform(0, 745, 2000),
        RANDOM.uniform(708, 746, 500),
        10.0 ** RANDOM.uniform(-320, 2, 500),
        (np.arange(1, 1000) - 0.5) * math.log(2),
    ],
    ids=["small", "whole range", "subnormal", "all magnitudes", "where the power of two changes"],
)
def test_is_within_a_unit_in_the_last_place(x):
    with mpmath.workdps(50):
        for argument in x.tolist():
            exact = mpmath.exp(-mpmath.mpf(argument))
            assert abs(exp_of_minus(argument) - exact) <= 0.9 * math.ulp(float(exact))


def test_starts_at_1_and_underflows_to_0():
    assert exp_of_minus(0.0) == 1.0
    assert exp_of_minus(2.0**-54) == 1.0
    assert exp_of_minus(745.13) == 5e-324
    assert [exp_of_minus(x) for x in (745.14, 760.0, 1e6, 1e308)] == [0.0] * 4
