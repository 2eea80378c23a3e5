"""Where the spectra are multiplied: a square of frequencies about DC in shells, and the axes far beyond it.

Integrands have most of their energy at the lowest frequencies: only there many realisations are needed, and there they
are cheap.

Latin hypercubes and nets have their dark axes out to frequency N, and integrands that jump at the edges of the unit
square, or along them, have all their slow decay there: the axes cost one dimension and are taken further.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.expectation import View
from samplekit_spectrum.frequencies import Cube

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.integrands.integrand import Integrand

LARGEST_SQUARE, LARGEST_SQUARE_OF_FIXED = 512, 1024
LARGEST_AXIS = 2**16
SHELLS = (8, 32, 128)
"""Where one shell of the square ends and the next begins."""
_ROWS = 2**21


@dataclass(frozen=True, eq=False)
class Region:
    """A view with its weights: twice |f(m)|^2 for each pair m, -m, and 0 where another region has them.

    Attributes
    ----------
    view
        The projection and the frequencies at which sets are transformed.
    weights
        float64[half].
    inner
        Largest |m|_inf that another region covers.
    """

    view: View
    weights: NDArray[np.float64]
    inner: int

    @property
    def cube(self) -> Cube:
        """The frequencies."""
        assert isinstance(self.view.frequencies, Cube)
        return self.view.frequencies

    @property
    def energy(self) -> float:
        """The sum of |f(m)|^2 over the region."""
        return float(self.weights.sum())


def square(integrand: Integrand, inner: int, reach: int) -> Region:
    """All frequencies with inner < |m|_inf <= reach."""
    cube = Cube(2, reach)
    weights = np.zeros(cube.half)
    for start in range(1, cube.half, _ROWS):
        stop = min(start + _ROWS, cube.half)
        vectors = cube.vectors(start, stop)
        powers = 2.0 * integrand.power(vectors[:, 0], vectors[:, 1])
        weights[start:stop] = np.where(np.abs(vectors).max(axis=1) > inner, powers, 0.0)
    return Region(View((0, 1), cube, weights), weights, inner)


def axis(integrand: Integrand, dimension: int, inner: int, reach: int) -> Region:
    """The frequencies on an axis with inner < |m| <= reach."""
    cube = Cube(1, reach)
    m = np.arange(inner + 1, reach + 1)
    zero = np.zeros_like(m)
    weights = np.zeros(cube.half)
    weights[inner + 1 :] = 2.0 * (integrand.power(m, zero) if dimension == 0 else integrand.power(zero, m))
    return Region(View((dimension,), cube, weights), weights, inner)


def regions(integrand: Integrand, reach: int, axis_reach: int, *, in_shells: bool) -> list[Region]:
    """The square and both axes, whole or in shells, without those where the integrand has nothing."""
    most = integrand.reach
    reach, axis_reach = (min(value, most) if most else value for value in (reach, axis_reach))
    shells = SHELLS if in_shells else ()
    inner = 0 if integrand.axes_only else reach
    found = [square(integrand, *shell) for shell in _shells(0, reach, shells)] if not integrand.axes_only else []
    for shell in _shells(inner, axis_reach, shells):
        found += [axis(integrand, dimension, *shell) for dimension in (0, 1)]
    return [region for region in found if region.energy > 1e-14 * integrand.variance]


def _shells(inner: int, outer: int, ends: tuple[int, ...]) -> list[tuple[int, int]]:
    """What lies between ``inner`` and ``outer``, divided at ``ends``."""
    return list(pairwise([inner, *(end for end in ends if inner < end < outer), outer])) if inner < outer else []


def reaches(count: int, *, fixed: bool) -> tuple[int, int]:
    """How far the square and the axes go: 16 sqrt N, most spectra being flat from a quarter of it on; 16 N for axes."""
    most = LARGEST_SQUARE_OF_FIXED if fixed else LARGEST_SQUARE
    reach = most if fixed else min(max(2 ** math.ceil(math.log2(16.0 * math.sqrt(count))), 128), most)
    return reach, min(max(16 * count, 2**12), LARGEST_AXIS)


def outer_power(region: Region, mean: NDArray[np.float64], *, off_axes: bool) -> tuple[float, float]:
    """In the outer half of a region the power weighted with the integrand's, and the largest power.

    ``off_axes``: other regions go on where a square's axes end, so that what is missing beyond it is off the axes,
    where Latin samplers are brighter.
    """
    cube = region.cube
    vectors = np.abs(cube.vectors(0, cube.half))
    outer = vectors.max(axis=1) > max(cube.reach // 2, region.inner)
    if off_axes and cube.dims == 2:
        outer &= vectors.min(axis=1) > 0
    weights = region.weights[outer]
    total = float(weights.sum())
    if total == 0.0:
        return float("nan"), float(mean[outer].max())
    return float((weights * mean[outer]).sum()) / total, float(mean[outer].max())
