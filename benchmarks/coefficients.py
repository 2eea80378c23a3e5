"""Fit the coefficients of the polynomials in samplekit.kernels, bit for bit: ``python benchmarks/coefficients.py``.

The coefficients are fitted one after the other in mpmath at 70 digits. Each comes from a least-squares fit at 80
Chebyshev points, in which those before it are already rounded to float64 (the idea of fpminimax: Brisebarre and
Chevillard 2007, "Efficient polynomial L-infinity approximations", ARITH 18).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import mpmath

if TYPE_CHECKING:
    from collections.abc import Callable

DIGITS, POINTS = 70, 80

Interval = tuple[Any, Any]


def fit(function: Callable[[Any], Any], interval: Interval, degree: int, known: tuple[float, ...] = ()) -> list[float]:
    """Fit c0 + c1 x + ... + c_degree x^degree to a function on an interval; ``known`` are the first coefficients.

    Returns
    -------
    The coefficients of x^0 to x^degree as float64, those that are known included.
    """
    low, high = interval
    nodes = [mpmath.cos(mpmath.pi * (2 * i + 1) / (2 * POINTS)) for i in range(POINTS)]
    x = [low + (high - low) * (1 - node) / 2 for node in nodes]
    coefficients = list(known)
    while len(coefficients) <= degree:
        rest = mpmath.matrix([function(at) - value(coefficients, at) for at in x])
        powers = mpmath.matrix([[at**power for power in range(len(coefficients), degree + 1)] for at in x])
        solution = mpmath.lu_solve(powers.T * powers, powers.T * rest)
        coefficients.append(float(solution[0]))
    return coefficients


def value(coefficients: list[float], x: Any) -> Any:
    """Return c0 + c1 x + c2 x^2 + ..., at the precision of mpmath."""
    return mpmath.fsum(mpmath.mpf(coefficient) * x**power for power, coefficient in enumerate(coefficients))


def largest_error(function: Callable[[Any], Any], interval: Interval, coefficients: list[float]) -> float:
    """Return the largest error of the rounded polynomial over 2001 points of the interval."""
    points = mpmath.linspace(*interval, 2001)
    return float(max(abs(function(x) - value(coefficients, x)) for x in points))


def tables() -> dict[str, tuple[Callable[[Any], Any], Interval, list[float]]]:
    """Return function, interval and coefficients of each polynomial; call it at 70 digits."""
    pi, half = mpmath.pi, mpmath.log(2) / 2

    def cosine_of_turns(z: Any) -> Any:
        return mpmath.cos(2 * pi * mpmath.sqrt(z))

    def cosine(z: Any) -> Any:
        return mpmath.cos(pi / 4 * mpmath.sqrt(z))

    def sine(z: Any) -> Any:
        return mpmath.sin(pi / 4 * mpmath.sqrt(z)) / mpmath.sqrt(z) if z else pi / 4

    turns, unit = (mpmath.mpf(0), mpmath.mpf(1) / 4), (mpmath.mpf(0), mpmath.mpf(1))
    # The rounding to a whole power of two may end a little beyond half of ln 2.
    wide = (-half * mpmath.mpf("1.0001"), half * mpmath.mpf("1.0001"))
    return {
        "_COSINE_OF_TURNS: cos(2 pi t), z = t^2": (cosine_of_turns, turns, fit(cosine_of_turns, turns, 10, (1.0,))),
        "_EXPONENTIAL: exp(r)": (mpmath.exp, wide, fit(mpmath.exp, wide, 11, (1.0, 1.0))),
        "_COSINE: cos(pi/4 t), z = t^2": (cosine, unit, fit(cosine, unit, 6, (1.0,))),
        "_SINE: sin(pi/4 t) / t, z = t^2": (sine, unit, fit(sine, unit, 6)),
    }


if __name__ == "__main__":
    with mpmath.workdps(DIGITS):
        for name, (function, interval, coefficients) in tables().items():
            print(f"{name}, largest error {largest_error(function, interval, coefficients):.2g}")
            for power, coefficient in enumerate(coefficients):
                print(f"  c{power} = {coefficient!r}")
