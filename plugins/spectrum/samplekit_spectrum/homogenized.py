"""Homogenisation: any sampler followed by one random toroidal shift of the whole set.

It leaves |S(m)| as it is, makes the mean of S(m) zero, and with it every estimate unbiased; only then is the variance
of an estimate the sum of |f(m)|^2 E|S(m)|^2 (Pilleboue et al. 2015).
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import numpy as np

from samplekit import ConfiguredSampler, Realizations, randomizer

if TYPE_CHECKING:
    from numpy.typing import NDArray


class _Reshifted(ConfiguredSampler):
    """Each set under several random shifts: realisation r is set r // shifts under the shift r."""

    def __init__(self, sampler: ConfiguredSampler, shifts: int) -> None:
        super().__init__(*sampler.followed_by("shift").parts)
        self._inner = sampler
        self._shifts = shifts
        self._shift = randomizer("shift")
        self._kept = threading.local()

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        numbers = realizations.x // self._shifts
        if start or out.shape[2] != count:
            raise ValueError("sets that are shifted anew are taken whole")
        first = int(numbers[0])
        sets = self._sets(first, int(numbers[-1]) + 1, realizations.seed, out.shape[1], count)
        out[:] = sets[numbers - first]
        self._shift.apply(out, realizations)

    def _sets(self, first: int, stop: int, seed: int, dims: int, count: int) -> NDArray[np.float64]:
        """Sets first to stop; the last is kept, since the next ones asked for often begin with it."""
        last, seed_of_last, kept = getattr(self._kept, "last", (-1, -1, np.empty(0)))
        have = int(last == first and seed_of_last == seed and kept.shape == (dims, count))
        sets = np.empty((stop - first, dims, count))
        if have:
            sets[0] = kept
        if stop - first > have:
            self._inner.fill(sets[have:], Realizations.of_trials(first + have, stop, seed), count, 0)
        self._kept.last = (stop - 1, seed, sets[-1].copy())
        return sets


def is_homogeneous(sampler: ConfiguredSampler) -> bool:
    """Return whether all shifts of a set are equally likely: for independent points, and after a random shift."""
    return sampler.text.endswith("+shift") or (sampler.text == "random" and sampler.plugin.builtin)


def homogenized(sampler: ConfiguredSampler, shifts: int = 1) -> ConfiguredSampler:
    """The sampler followed by a random shift, unless that changes nothing; by so many shifts of each set in a row."""
    if shifts > 1:
        return _Reshifted(sampler, shifts)
    return sampler if is_homogeneous(sampler) else sampler.followed_by("shift")
