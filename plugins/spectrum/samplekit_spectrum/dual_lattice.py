"""The regular grid: its power is 1 on the multiples of the grid's sides, and 0 elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import grid_sides

if TYPE_CHECKING:
    from samplekit_spectrum.integrands.integrand import Integrand

_SQUARE, _AXIS = 1024, 2**18


def variance_on_grid(integrand: Integrand, count: int) -> tuple[float, float]:
    """The sum of |f(m)|^2 over the dual lattice, and what its outermost half added: about what is still missing.

    Coefficients of an integrand with jumps fall as |m|^-3 or, along the axes, as m^-2: what lies beyond a cut is
    about as much as what lies between half of it and itself.
    """
    sides = grid_sides(count, 2)
    assert sides is not None
    most = integrand.reach or 2**62
    square, axis = min(_SQUARE, most // sides[0]), min(_AXIS, most // sides[0])
    total, outer = 0.0, 0.0
    x = np.arange(-square, square + 1)
    for y in range(1, square + 1):
        # One row and its mirror image; the axis y = 0 follows.
        powers = 2.0 * integrand.power(sides[0] * x[x != 0], np.full(2 * square, sides[1] * y))
        total += float(powers.sum())
        outer += float(powers[np.abs(x[x != 0]) > square // 2].sum()) if 2 * y <= square else float(powers.sum())
    k = np.arange(1, axis + 1)
    for powers in (
        2.0 * integrand.power(sides[0] * k, np.zeros_like(k)),
        2.0 * integrand.power(np.zeros_like(k), sides[1] * k),
    ):
        total += float(powers.sum())
        outer += float(powers[axis // 2 :].sum())
    return total, outer
