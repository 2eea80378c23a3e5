"""The test for bias: for an unbiased sampler, the mean of S(m) is zero at every integer m except 0.

S(m) = (1/N) sum exp(-2 pi i m . x) over the N points x of a set.
The mean of an estimate is the sum of f(m) conj E S(m). It equals the integral for every integrand if and only if
E S(m) = 0 for all m other than 0 (Subr, Kautz 2013). Between the integers E S(m) is then the transform of the unit
square.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.frequencies import Cube, Frequencies

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.moments import Moments

FALSE_ALARM = 1e-3
_FEWEST = 16
"""Smallest number of realisations for which the test is made."""
_ZERO = 1e-9
"""Amplitudes up to this size are caused by rounding."""


@dataclass(frozen=True)
class Bias:
    """The frequency at which |E S(m)| is most significant.

    Attributes
    ----------
    verdict
        ``"none found"``, ``"biased"``, or ``"too few realizations"``.
    frequency, amplitude, standard_error
        That frequency, |E S(m)| at it, and its standard error, which is 0 for a sampler that is not random.
    score, threshold
        |E S(m)|^2 over its expectation for an unbiased sampler; and the value that the largest score of an unbiased
        sampler exceeds with a probability of at most 1e-3: a quantile of the square of Student's t, for the number of
        frequencies.
    root_mean_square
        Root of the mean of |E S(m)|^2 over all frequencies, less the part that random errors contribute.

    Between integer frequencies, |E S(m)| stands for the difference of E S(m) from the transform of the unit square.
    """

    verdict: str
    frequency: tuple[float, ...]
    amplitude: float
    standard_error: float
    score: float
    threshold: float
    root_mean_square: float


def find_bias(frequencies: Frequencies, moments: Moments, *, randomized: bool) -> Bias:
    """Find the frequency other than DC at which the mean amplitude is most significant."""
    from scipy.stats import f as fisher

    freedom = moments.realizations - 1
    if randomized and moments.realizations < _FEWEST:
        return Bias("too few realizations", (0.0,) * frequencies.dims, np.nan, np.nan, np.nan, np.nan, np.nan)
    start = 1 if isinstance(frequencies, Cube) else 0
    amplitude = moments.amplitude[start:]
    squared = np.abs(amplitude - _unit_square_transform(frequencies)[start:]) ** 2
    if randomized:
        variance = np.maximum(moments.mean[start:] - np.abs(amplitude) ** 2, 0.0) / freedom
        # On the zeros of a net both are 0 up to rounding, and rounding must not look significant.
        noise = _ZERO**2
        score = np.where(squared <= noise, 0.0, squared / np.maximum(variance, noise * 1e-6))
        worst = int(np.argmax(score))
        # A real S(m) has a heavier tail than a complex one: that of the square of Student's t.
        threshold = float(fisher.isf(FALSE_ALARM / squared.size, 1, freedom))
    else:
        variance = np.zeros(squared.size)
        score = np.where(np.sqrt(squared) > _ZERO, np.inf, 0.0)
        worst = int(np.argmax(squared))
        threshold = 0.0
    return Bias(
        "biased" if score[worst] > threshold else "none found",
        tuple(frequencies.values(worst + start, worst + start + 1)[0].tolist()),
        float(np.sqrt(squared[worst])),
        float(np.sqrt(variance[worst])),
        float(score[worst]),
        threshold,
        float(np.sqrt(max(float((squared - variance).mean()), 0.0))),
    )


def _unit_square_transform(frequencies: Frequencies) -> NDArray[np.complex128]:
    """Return the integral of exp(-2 pi i m.x) over the unit square (or cube): 0 at all integers other than 0."""
    if isinstance(frequencies, Cube) and frequencies.step.is_integer():
        # DC, which is entry 0, is not tested.
        return np.zeros(frequencies.half, np.complex128)
    vectors = frequencies.values(0, frequencies.half)
    return np.asarray(np.prod(np.sinc(vectors) * np.exp(-1j * np.pi * np.fmod(vectors, 2.0)), axis=1), np.complex128)
