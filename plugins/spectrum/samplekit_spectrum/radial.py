"""The radial mean of a spectrum, and how much it varies with direction.

Ulichney 1988, "Dithering with blue noise": the mean over the ring k - 1/2 <= |m| < k + 1/2, and the anisotropy, the
variance over the ring divided by the square of its mean, in dB. R realisations of an isotropic spectrum give -10
log10 R.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.moments import ring_counts

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.frequencies import Cube
    from samplekit_spectrum.moments import Moments


_ROUNDING = 1e-12
"""Relative differences that are none."""


@dataclass(frozen=True, eq=False)
class Radial:
    """Rings 1 to the reach: all that the cube does not cut.

    Attributes
    ----------
    frequency
        Radius of each ring, in the middle.
    frequencies
        How many frequencies lie on it.
    power, standard_error
        The mean of E|S|^2 / N^2 over the ring; its standard error is that of the ring's mean over realisations, which
        knows that frequencies of one realisation are not independent. NaN for a single realisation.
    anisotropy
        In dB; -inf where the spectrum is the same in all directions.
    """

    frequency: NDArray[np.float64]
    frequencies: NDArray[np.int64]
    power: NDArray[np.float64]
    standard_error: NDArray[np.float64]
    anisotropy: NDArray[np.float64]


def radial(cube: Cube, moments: Moments) -> Radial:
    """The radial mean of the expected spectrum."""
    rings = cube.rings()
    counts = ring_counts(rings)
    mean = np.asarray(np.bincount(rings, moments.mean) / counts, np.float64)
    # Not the difference of the mean square and the square of the mean, which would cancel.
    squares = np.bincount(rings, (moments.mean - mean[rings]) ** 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        variance = squares / np.maximum(counts - 1.0, 1.0)
        anisotropy = 10.0 * np.log10(variance / mean**2)
    return Radial(
        np.asarray(np.arange(1, cube.reach + 1) * cube.step, np.float64),
        (2 * counts[1:]).astype(np.int64),
        moments.ring_mean[1:],
        moments.ring_standard_error[1:],
        np.asarray(np.where(variance <= (_ROUNDING * mean) ** 2, -np.inf, anisotropy)[1:], np.float64),
    )
