"""Whether a sampler is unbiased, that is whether the mean of S(m) is zero at every m.

The mean of an estimate is the sum of f(m) conj E S(m): it is the integral for every integrand if and only if E S(m) = 0
for all m other than 0 (Subr, Kautz 2013).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from samplekit_spectrum.frequencies import Frequencies
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
    start = 1 if not _is_listed(frequencies) else 0
    squared = np.abs(moments.amplitude[start:]) ** 2
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
    variance = np.maximum(moments.mean[start:] - squared, 0.0) / (realizations - 1)
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


def _is_listed(frequencies: Frequencies) -> bool:
    from samplekit_spectrum.frequencies import Listed

    return isinstance(frequencies, Listed)


def _vector(frequencies: Frequencies, index: int) -> tuple[float, ...]:
    from samplekit_spectrum.frequencies import Listed

    if isinstance(frequencies, Listed):
        return tuple(float(c) for c in frequencies.vectors[index])
    return tuple(float(c) * frequencies.step for c in frequencies.vectors(index, index + 1)[0])
