import mpmath
import numpy as np
import pytest

from samplekit.kernels._polynomials import cosine_of_turns

RANDOM = np.random.default_rng(1)


def errors(turns):
    with mpmath.workdps(50):
        return [float(abs(cosine_of_turns(t) - mpmath.cos(2 * mpmath.pi * mpmath.mpf(t)))) for t in turns]


@pytest.mark.parametrize(
    "turns",
    [
        RANDOM.uniform(-0.5, 0.5, 4000),
        RANDOM.uniform(-1e6, 1e6, 1000),
        10.0 ** RANDOM.uniform(-320, 0, 500),
        np.arange(-256, 257) / 512,
        np.nextafter(np.arange(-8, 9) / 16, 9),
        np.array([-0.4947819462615338, 0.49451247970296697]),  # the largest errors found in a search over 4e7 angles
    ],
    ids=["one turn", "many turns", "tiny", "grid", "beside multiples of a sixteenth", "worst found"],
)
def test_is_within_the_documented_error_of_the_cosine(turns):
    assert max(errors(turns.tolist())) <= 6.2e-16


@pytest.mark.parametrize("turns", [0.0, -0.0, 1.0, -7.0, 2.0**31, 2.0**52 + 1, 2.0**53 - 1, 1e300, 5e-324])
def test_whole_turns_give_exactly_1(turns):
    assert cosine_of_turns(turns) == 1.0


def test_half_turns_give_exactly_minus_1():
    assert [cosine_of_turns(t) for t in (0.5, -0.5, 1.5, -2.5, 2.0**30 + 0.5)] == [-1.0] * 5


def test_is_even_periodic_and_never_beyond_1():
    for t in (RANDOM.integers(0, 2**40, 1000) * 2.0**-41).tolist():
        value = cosine_of_turns(t)
        assert abs(value) <= 1.0
        assert cosine_of_turns(-t) == value
        assert cosine_of_turns(t + 37.0) == value
