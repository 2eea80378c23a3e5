"""The test for bias: an unbiased sampler has a mean of S(m) of zero at every integer m except 0.

The mean of an estimate is the sum of f(m) conj E S(m): it is the integral for every integrand if and only if E S(m) = 0
for all m other than 0 (Subr, Kautz 2013). Between the integers E S(m) is then the transform of the unit square.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit_spectrum.frequencies import Frequencies, Listed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.moments import Moments

FALSE_ALARM = 1e-3
_FEWEST = 16
"""Realisations below which nothing is said."""

_ZERO = 1e-9


@dataclass(frozen=True)
class Bias:
    """The frequency at which |E S(m)| is most significant.

    Attributes
    ----------
    verdict
        ``"none found"``, ``"biased"``, or ``"too few realizations"``.
    frequency, amplitude, standard_error
        There |E S(m)| / N and its standard error; of a sampler that is not random the error is 0.
    score, threshold
        |E S(m)|^2 over its expectation for an unbiased sampler, and the value that an unbiased sampler exceeds anywhere
        with a probability of at most 1e-3: that of Student's t squared, for the number of frequencies.
    root_mean_square
        Over all frequencies: of |E S(m)| less what its errors give by themselves.

    Between integer frequencies |E S(m)| stands for what E S(m) differs by from the transform of the unit square.
    """

    verdict: str
    frequency: tuple[float, ...]
    amplitude: float
    standard_error: float
    score: float
    threshold: float
    root_mean_square: float


def find_bias(frequencies: Frequencies, moments: Moments, *, randomized: bool = True) -> Bias:
    """Look for a frequency, DC excepted, at which the mean amplitude is not zero."""
    from scipy.stats import f as fisher

    realizations = moments.realizations
    start = 0 if isinstance(frequencies, Listed) else 1
    amplitude = moments.amplitude[start:]
    squared = np.abs(amplitude - _of_square(frequencies)[start:]) ** 2
    if not randomized:
        worst = int(np.argmax(squared))
        size = float(np.sqrt(squared[worst]))
        verdict = "biased" if size > _ZERO else "none found"
        vector = _vector(frequencies, worst + start)
        rms = float(np.sqrt(squared.mean()))
        return Bias(verdict, vector, size, 0.0, np.inf if size > _ZERO else 0.0, 0.0, rms)
    if realizations < _FEWEST or squared.size == 0:
        nothing = (0.0,) * frequencies.dims
        return Bias("too few realizations", nothing, np.nan, np.nan, np.nan, np.nan, np.nan)
    variance = np.maximum(moments.mean[start:] - np.abs(amplitude) ** 2, 0.0) / (realizations - 1)
    # Where the amplitude is certain to rounding, as on the zeros of a net, rounding is all that is left of it.
    certain = _ZERO**2
    score = np.where(squared <= certain, 0.0, squared / np.maximum(variance, certain * 1e-6))
    worst = int(np.argmax(score))
    # A real S(m) has the heavier tail: Student's t squared.
    threshold = float(fisher.isf(FALSE_ALARM / squared.size, 1, realizations - 1))
    return Bias(
        "biased" if score[worst] > threshold else "none found",
        _vector(frequencies, worst + start),
        float(np.sqrt(squared[worst])),
        float(np.sqrt(variance[worst])),
        float(score[worst]),
        threshold,
        float(np.sqrt(max(float((squared - variance).mean()), 0.0))),
    )


def _of_square(frequencies: Frequencies) -> NDArray[np.complex128]:
    """The integral of exp(-2 pi i m.x) over the unit square (cube): 0 at integers but 0."""
    if isinstance(frequencies, Listed):
        vectors = np.asarray(frequencies.vectors, np.float64)
    elif float(frequencies.step).is_integer():
        total = np.zeros(frequencies.half, np.complex128)
        total[0] = 1.0
        return total
    else:
        vectors = np.asarray(frequencies.step * frequencies.vectors(0, frequencies.half), np.float64)
    return np.asarray(np.prod(np.sinc(vectors) * np.exp(-1j * np.pi * np.fmod(vectors, 2.0)), axis=1), np.complex128)


def _vector(frequencies: Frequencies, index: int) -> tuple[float, ...]:
    if isinstance(frequencies, Listed):
        return tuple(float(c) for c in frequencies.vectors[index])
    return tuple(float(c) * frequencies.step for c in frequencies.vectors(index, index + 1)[0])
