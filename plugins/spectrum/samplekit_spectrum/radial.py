"""The radial mean of a spectrum, and its anisotropy: how much the power varies with direction.

Ulichney 1988, "Dithering with blue noise": the mean over the ring k - 1/2 <= |m| < k + 1/2, and the anisotropy, which
is the variance over the ring divided by the square of its mean, in dB. The mean over R realisations of an isotropic
spectrum has an anisotropy of -10 log10 R.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.frequencies import Cube
    from samplekit_spectrum.moments import Moments

_ROUNDING = 1e-12
"""Relative differences up to this size are caused by rounding."""


@dataclass(frozen=True, eq=False)
class Radial:
    """Means over the rings from 1 to the reach: all rings that the cube of frequencies does not cut.

    Attributes
    ----------
    frequency
        Radius of the middle of each ring.
    frequencies
        Number of frequencies on each ring.
    power, standard_error
        The mean of E|S(m)|^2 over each ring, with S(m) = (1/N) sum_k exp(-2 pi i m . x_k): 1/N for random points, and 1
        where all points are in phase. Tables and plots show N times it. Of an error image: the mean of its power, which
        is 1 on average. The standard error is NaN for a single realisation. It comes from the spread of the ring's mean
        over realisations, so frequencies of one set may depend on each other.
    anisotropy
        In dB; -inf where the spectrum is the same in all directions.
    """

    frequency: NDArray[np.float64]
    frequencies: NDArray[np.int64]
    power: NDArray[np.float64]
    standard_error: NDArray[np.float64]
    anisotropy: NDArray[np.float64]


def radial(cube: Cube, moments: Moments) -> Radial:
    """Return the radial mean of the expected spectrum."""
    rings, counts = moments.rings, moments.ring_counts
    mean = np.bincount(rings, moments.mean) / counts
    # The mean square minus the square of the mean would cancel.
    variance = np.bincount(rings, (moments.mean - mean[rings]) ** 2) / np.maximum(counts - 1.0, 1.0)
    return Radial(
        np.arange(1.0, cube.reach + 1.0) * cube.step,
        (2 * counts[1:]).astype(np.int64),
        moments.ring_mean[1:],
        moments.ring_standard_error[1:],
        anisotropy(variance, mean, (_ROUNDING * mean) ** 2)[1:],
    )


def anisotropy(
    variance: NDArray[np.float64], mean: NDArray[np.float64], rounding: NDArray[np.float64] | float
) -> NDArray[np.float64]:
    """Return the anisotropy in dB; -inf where the variance over a ring is at most ``rounding``."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(variance <= rounding, -np.inf, 10.0 * np.log10(variance / mean**2))
