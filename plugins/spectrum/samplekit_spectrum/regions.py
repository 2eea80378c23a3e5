"""Where the spectra are multiplied: a square of frequencies about DC in shells, and the axes far beyond the square.

Integrands have most of their energy at the lowest frequencies. Many realisations are needed only there, where they are
cheap.

Latin hypercubes and nets have little power on the axes out to frequency N, and integrands that jump at the edges of the
unit square, or along them, decay slowly only on the axes. The axes have one dimension, so they can be summed further.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.expectation import Projection
from samplekit_spectrum.frequencies import Cube

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.integrands.integrand import Integrand

LARGEST_SQUARE, LARGEST_SQUARE_OF_FIXED = 512, 1024
LARGEST_AXIS = 2**16
SHELLS = (8, 32, 128)
"""The largest |m|_inf of each shell but the last."""
_ROWS = 2**21


@dataclass(frozen=True, eq=False)
class Region(Projection):
    """Frequencies at which the spectra are multiplied.

    Attributes
    ----------
    axes, frequencies
        The projection of the sets, and the frequencies.
    weights
        float64[half]: |f(m)|^2 + |f(-m)|^2 for each pair m, -m, and 0 at frequencies that belong to another region.
    inner
        Largest |m|_inf that belongs to another region.
    """

    frequencies: Cube
    weights: NDArray[np.float64]
    inner: int = 0

    @cached_property
    def energy(self) -> float:
        """The sum of |f(m)|^2 over the region."""
        return float(self.weights.sum())


def square(integrand: Integrand, inner: int, reach: int) -> Region:
    """Return the region of all frequencies with inner < |m|_inf <= reach."""
    cube = Cube(2, reach)
    weights = np.zeros(cube.half)
    for start in range(1, cube.half, _ROWS):
        stop = min(start + _ROWS, cube.half)
        vectors = cube.vectors(start, stop)
        powers = 2.0 * integrand.power(vectors[:, 0], vectors[:, 1])
        weights[start:stop] = np.where(np.abs(vectors).max(axis=1) > inner, powers, 0.0)
    return Region((0, 1), cube, weights, inner)


def axis(integrand: Integrand, dimension: int, inner: int, reach: int) -> Region:
    """Return the region of the frequencies on an axis with inner < |m| <= reach."""
    cube = Cube(1, reach)
    m = np.arange(inner + 1, reach + 1)
    zero = np.zeros_like(m)
    weights = np.zeros(cube.half)
    weights[inner + 1 :] = 2.0 * (integrand.power(m, zero) if dimension == 0 else integrand.power(zero, m))
    return Region((dimension,), cube, weights, inner)


def regions(integrand: Integrand, reach: int, axis_reach: int, *, in_shells: bool) -> list[Region]:
    """Return the square and both axes, whole or in shells, without regions where the integrand has no energy."""
    if integrand.reach is not None:
        reach, axis_reach = min(reach, integrand.reach), min(axis_reach, integrand.reach)
    if integrand.axes_only:
        reach = 0
    ends = SHELLS if in_shells else ()
    found = [square(integrand, *shell) for shell in _shells(0, reach, ends)]
    found += [axis(integrand, d, *shell) for shell in _shells(reach, axis_reach, ends) for d in (0, 1)]
    return [region for region in found if region.energy > 1e-14 * integrand.variance]


def _shells(inner: int, outer: int, ends: tuple[int, ...]) -> list[tuple[int, int]]:
    """Divide the range from ``inner`` to ``outer`` at ``ends``."""
    return list(pairwise([inner, *(end for end in ends if inner < end < outer), outer])) if inner < outer else []


def reaches(count: int, *, fixed: bool) -> tuple[int, int]:
    """Return the reach of the square, 16 sqrt N, and of the axes, 16 N, both within limits.

    Most spectra are flat beyond a quarter of 16 sqrt N. If all sets have one power, ``fixed``, a large square is cheap.
    """
    if fixed:
        reach = LARGEST_SQUARE_OF_FIXED
    else:
        reach = min(max(2 ** math.ceil(math.log2(16.0 * math.sqrt(count))), 128), LARGEST_SQUARE)
    return reach, min(max(16 * count, 2**12), LARGEST_AXIS)


def outer_power(region: Region, mean: NDArray[np.float64], *, off_axes: bool) -> tuple[float, float]:
    """Return the mean power in the outer half of a region, weighted with the integrand's, and the largest power there.

    The mean is NaN if the integrand has no power there. ``off_axes`` leaves out the axes of a square that other regions
    continue: what is missing beyond the square is off the axes, where Latin samplers have more power.
    """
    cube = region.frequencies
    vectors = np.abs(cube.vectors(0, cube.half))
    outer = vectors.max(axis=1) > max(cube.reach // 2, region.inner)
    if off_axes and cube.dims == 2:
        outer &= vectors.min(axis=1) > 0
    weights = region.weights[outer]
    total = float(weights.sum())
    level = float((weights * mean[outer]).sum()) / total if total else math.nan
    return level, float(mean[outer].max())
