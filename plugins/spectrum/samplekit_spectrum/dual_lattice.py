"""The variance on a regular grid, whose power is 1 on the multiples of the grid's sides, and 0 elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import grid_sides

if TYPE_CHECKING:
    from samplekit_spectrum.integrands.integrand import Integrand

_SQUARE, _AXIS = 1024, 2**18


def variance_on_grid(integrand: Integrand, count: int) -> tuple[float, float]:
    """Return the sum of |f(m)|^2 over the dual lattice, and the part of its outer half: about what is still missing.

    The |f(m)|^2 of an integrand with jumps fall as |m|^-3 or, along the axes, as m^-2. So the sum beyond the largest
    frequency is about as large as the sum between half of that frequency and the frequency itself.
    """
    sides = grid_sides(count, 2)
    assert sides is not None
    most = integrand.reach or 2**62
    square, axis = min(_SQUARE, most // sides[0]), min(_AXIS, most // sides[0])
    total, outer = 0.0, 0.0
    k = np.arange(-square, square + 1)
    x = k[k != 0]
    for y in range(1, square + 1):
        # A row and its mirror image. The axes follow.
        powers = 2.0 * integrand.power(sides[0] * x, np.full_like(x, sides[1] * y))
        total += float(powers.sum())
        outer += float(powers[(2 * y > square) | (np.abs(x) > square // 2)].sum())
    k = np.arange(1, axis + 1)
    zero = np.zeros_like(k)
    for mx, my in ((sides[0] * k, zero), (zero, sides[1] * k)):
        powers = 2.0 * integrand.power(mx, my)
        total += float(powers.sum())
        outer += float(powers[axis // 2 :].sum())
    return total, outer
