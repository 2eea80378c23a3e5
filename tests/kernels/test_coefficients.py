"""The coefficients of polynomials are those that the script of their fit gives, bit for bit."""

import importlib.util
from pathlib import Path

import mpmath
import pytest

from samplekit.kernels import _polynomials as polynomials

_spec = importlib.util.spec_from_file_location("coefficients", Path(__file__).parents[2] / "benchmarks/coefficients.py")
script = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(script)


@pytest.fixture(scope="module")
def tables():
    with mpmath.workdps(script.DIGITS):
        yield script.tables()


def test_fitted_coefficients_are_those_of_the_kernels(tables):
    in_use = [polynomials._COSINE_OF_TURNS, polynomials._EXPONENTIAL, polynomials._COSINE, polynomials._SINE]
    assert [tuple(reversed(coefficients)) for _, _, coefficients in tables.values()] == in_use


@pytest.mark.parametrize(("number", "bound"), [(0, 3.8e-17), (1, 5e-18), (2, 6e-17), (3, 6e-17)])
def test_rounded_polynomial_is_within_the_stated_error(tables, number, bound):
    function, interval, coefficients = list(tables.values())[number]
    assert script.largest_error(function, interval, coefficients) <= bound
