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
    """Means over realisations of the power at each frequency of a half, and of the power's mean over each ring.

    Attributes
    ----------
    realizations
        Number of realisations that have been added.
    rings, ring_counts
        int32[half], float64[rings + 1]: the ring of each frequency; the number of the half's frequencies on each ring.
    mean, squares
        float64[half]: the mean of |S|^2, S(m) = (1/N) sum exp(-2 pi i m . x), and the sum of its squared deviations.
    amplitude
        complex128[half]: the mean of S.
    ring_mean, ring_squares
        float64[rings + 1]: the same for the mean over each ring; entry 0 has no meaning.
    totals
        The sum of weights times power over the half, for each realisation; empty without weights.
    """

    def __init__(self, rings: NDArray[np.int32], weights: NDArray[np.float64] | None = None) -> None:
        half = rings.size
        self.rings = rings
        # 1 where a ring is empty, so that sums can be divided by it.
        self.ring_counts = np.maximum(np.bincount(rings, minlength=1), 1).astype(np.float64)
        self._weights = np.empty(0) if weights is None else weights
        self.realizations = 0
        self.mean = np.zeros(half)
        self.squares = np.zeros(half)
        self.amplitude = np.zeros(half, np.complex128)
        self.ring_mean = np.zeros(self.ring_counts.size)
        self.ring_squares = np.zeros(self.ring_counts.size)
        self.totals: list[float] = []

    def add(
        self,
        parts: Iterable[tuple[int, NDArray[np.complex128]]],
        members: int,
        count: int,
        *,
        exact_dc: bool = True,
    ) -> None:
        """Add realisations of ``count`` points, given N S in parts: the first entry, and complex128[members, entries].

        ``exact_dc``: entry 0 is DC, where N S is exactly ``count``, whatever rounding makes of it.
        """
        ring_sums, totals = np.zeros((members, self.ring_mean.size)), np.zeros(members)
        for start, amplitudes in parts:
            part = slice(start, start + amplitudes.shape[1])
            _add(
                np.ascontiguousarray(amplitudes), exact_dc and start == 0, 1.0 / count, self.realizations,
                self.mean[part], self.squares[part], self.amplitude[part], self.rings[part], ring_sums,
                self._weights[part], totals,
            )  # fmt: skip
        for ring_means in ring_sums / self.ring_counts:
            self.realizations += 1
            deviations = ring_means - self.ring_mean
            self.ring_mean += deviations / self.realizations
            self.ring_squares += deviations * (ring_means - self.ring_mean)
        if self._weights.size:
            self.totals += totals.tolist()

    def merge(self, other: Moments) -> None:
        """Add the realisations of ``other``, which follow those of this object."""
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
        """Standard error of the mean power at each frequency, float64[half]; NaN if there is only one realisation."""
        return _standard_error(self.squares, self.realizations)

    @property
    def ring_standard_error(self) -> NDArray[np.float64]:
        """Standard error of the mean power of each ring, float64[rings + 1]; NaN if there is only one realisation."""
        return _standard_error(self.ring_squares, self.realizations)


def _standard_error(squares: NDArray[np.float64], realizations: int) -> NDArray[np.float64]:
    if realizations < 2:
        return np.full(squares.shape, np.nan)
    return np.sqrt(squares / (realizations - 1) / realizations)


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
    ring_sums: NDArray[np.float64],
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
            ring_sums[member, rings[i]] += power
            if weighted:
                totals[member] += weights[i] * power
