"""Running means of power and amplitude over realisations: Welford's updates, and merges in a fixed order.

Welford 1962, "Note on a method for calculating corrected sums of squares and products"; the merge is that of
Chan, Golub, LeVeque 1979, "Updating formulae and a pairwise algorithm for computing sample variances".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import kernel

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray


class Moments:
    """Means over realisations at each frequency of a half, and of the mean over each ring.

    Attributes
    ----------
    realizations
        How many have been added.
    mean, squares
        float64[half]: the mean of |S|^2 / N^2, and the sum of its squared deviations.
    amplitude
        complex128[half]: the mean of S / N.
    ring_mean, ring_squares
        float64[rings + 1]: the same of each ring's mean; entry 0 has no meaning.
    totals
        For each realisation the sum of weights times power over the half, if there are weights.
    """

    def __init__(self, rings: NDArray[np.int32], weights: NDArray[np.float64] | None = None) -> None:
        half = rings.size
        self._rings = rings
        self._counts = ring_counts(rings)
        self._weights = np.empty(0) if weights is None else weights
        self.realizations = 0
        self.mean = np.zeros(half)
        self.squares = np.zeros(half)
        self.amplitude = np.zeros(half, np.complex128)
        self.ring_mean = np.zeros(self._counts.size)
        self.ring_squares = np.zeros(self._counts.size)
        self.totals: list[float] = []

    def add_pair(self, mixed: NDArray[np.complex128], members: int, count: int) -> None:
        """Add two realisations from one transform with strengths 1 and i, ``mixed`` complex128[side^dims]; or one."""
        sums, totals = np.zeros((2, self.ring_mean.size)), np.zeros(2)
        before = self.realizations
        _add_pair(
            mixed, 1.0 / count, before, members, self.mean, self.squares, self.amplitude,
            self._rings, sums, self._weights, totals,
        )  # fmt: skip
        self._finish(sums[:members], totals[:members])

    def add(
        self,
        parts: Iterable[tuple[int, NDArray[np.complex128]]],
        members: int,
        count: int,
        *,
        exact_dc: bool = True,
    ) -> None:
        """Add realisations whose S is given in parts: (first entry, complex128[members, entries]).

        ``exact_dc``: entry 0 is DC, where the sum of N ones is N, and not what a transform gives.
        """
        sums, totals = np.zeros((members, self.ring_mean.size)), np.zeros(members)
        for start, amplitudes in parts:
            stop = start + amplitudes.shape[1]
            weights = self._weights[start:stop] if self._weights.size else self._weights
            _add(
                np.ascontiguousarray(amplitudes), exact_dc and start == 0, 1.0 / count, self.realizations,
                self.mean[start:stop], self.squares[start:stop], self.amplitude[start:stop],
                self._rings[start:stop], sums, weights, totals,
            )  # fmt: skip
        self._finish(sums, totals)

    def _finish(self, sums: NDArray[np.float64], totals: NDArray[np.float64]) -> None:
        for ring_sums, total in zip(sums, totals, strict=True):
            self.realizations += 1
            means = ring_sums / self._counts
            deviations = means - self.ring_mean
            self.ring_mean += deviations / self.realizations
            self.ring_squares += deviations * (means - self.ring_mean)
            if self._weights.size:
                self.totals.append(float(total))

    def merge(self, other: Moments) -> None:
        """Add the realisations of another, which come after these."""
        ours, theirs = self.realizations, other.realizations
        if theirs == 0:
            return
        both = ours + theirs
        for mean, squares, their_mean, their_squares in (
            (self.mean, self.squares, other.mean, other.squares),
            (self.ring_mean, self.ring_squares, other.ring_mean, other.ring_squares),
        ):
            difference = their_mean - mean
            squares += their_squares + difference * difference * (ours * theirs / both)
            mean += difference * (theirs / both)
        self.amplitude += (other.amplitude - self.amplitude) * (theirs / both)
        self.realizations = both
        self.totals += other.totals

    @property
    def standard_error(self) -> NDArray[np.float64]:
        """Standard error of the mean power at each frequency, float64[half]; NaN with a single realisation."""
        return _standard_error(self.squares, self.realizations)

    @property
    def ring_standard_error(self) -> NDArray[np.float64]:
        """Standard error of the mean power of each ring, float64[rings]; NaN with a single realisation."""
        return _standard_error(self.ring_squares, self.realizations)


def ring_counts(rings: NDArray[np.int32]) -> NDArray[np.float64]:
    """Number of the half's frequencies on each ring; 1 where there is none, so that it may divide."""
    return np.maximum(np.bincount(rings, minlength=1), 1).astype(np.float64)


def _standard_error(squares: NDArray[np.float64], realizations: int) -> NDArray[np.float64]:
    if realizations < 2:
        return np.full(squares.shape, np.nan)
    return np.sqrt(squares / (realizations - 1) / realizations)


@kernel(
    "void(complex128[::1], float64, int64, int64, float64[::1], float64[::1], complex128[::1],"
    " int32[::1], float64[:,::1], float64[::1], float64[::1])"
)
def _add_pair(
    mixed: NDArray[np.complex128],
    scale: float,
    before: int,
    members: int,
    mean: NDArray[np.float64],
    squares: NDArray[np.float64],
    amplitude: NDArray[np.complex128],
    rings: NDArray[np.int32],
    sums: NDArray[np.float64],
    weights: NDArray[np.float64],
    totals: NDArray[np.float64],
) -> None:
    half = mean.size
    share, next_share = 1.0 / (before + 1.0), 1.0 / (before + 2.0)
    halved = 0.5 * scale
    weighted = weights.size > 0
    for i in range(half):
        ahead, behind = mixed[half - 1 + i], mixed[half - 1 - i]
        if members == 2:
            real, imaginary = halved * (ahead.real + behind.real), halved * (ahead.imag - behind.imag)
            next_real, next_imaginary = halved * (ahead.imag + behind.imag), halved * (behind.real - ahead.real)
        else:
            real, imaginary = scale * ahead.real, scale * ahead.imag
            next_real, next_imaginary = 0.0, 0.0
        if i == 0:
            # The sum of N ones: exact, and not as the transform gives it.
            real, imaginary, next_real, next_imaginary = 1.0, 0.0, 1.0, 0.0
        power = real * real + imaginary * imaginary
        deviation = power - mean[i]
        mean[i] += deviation * share
        squares[i] += deviation * (power - mean[i])
        amplitude[i] += (complex(real, imaginary) - amplitude[i]) * share
        sums[0, rings[i]] += power
        if weighted:
            totals[0] += weights[i] * power
        if members == 2:
            power = next_real * next_real + next_imaginary * next_imaginary
            deviation = power - mean[i]
            mean[i] += deviation * next_share
            squares[i] += deviation * (power - mean[i])
            amplitude[i] += (complex(next_real, next_imaginary) - amplitude[i]) * next_share
            sums[1, rings[i]] += power
            if weighted:
                totals[1] += weights[i] * power


@kernel(
    "void(complex128[:,::1], boolean, float64, int64, float64[::1], float64[::1], complex128[::1],"
    " int32[::1], float64[:,::1], float64[::1], float64[::1])"
)
def _add(
    amplitudes: NDArray[np.complex128],
    has_dc: bool,
    scale: float,
    before: int,
    mean: NDArray[np.float64],
    squares: NDArray[np.float64],
    amplitude: NDArray[np.complex128],
    rings: NDArray[np.int32],
    sums: NDArray[np.float64],
    weights: NDArray[np.float64],
    totals: NDArray[np.float64],
) -> None:
    weighted = weights.size > 0
    for member in range(amplitudes.shape[0]):
        share = 1.0 / (before + member + 1.0)
        for i in range(mean.size):
            real, imaginary = scale * amplitudes[member, i].real, scale * amplitudes[member, i].imag
            if has_dc and i == 0:
                real, imaginary = 1.0, 0.0
            power = real * real + imaginary * imaginary
            deviation = power - mean[i]
            mean[i] += deviation * share
            squares[i] += deviation * (power - mean[i])
            amplitude[i] += (complex(real, imaginary) - amplitude[i]) * share
            sums[member, rings[i]] += power
            if weighted:
                totals[member] += weights[i] * power
