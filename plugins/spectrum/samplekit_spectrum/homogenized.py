"""Homogenisation: a random toroidal shift of the whole set follows any sampler.

It leaves |S(m)| as it is and makes the mean of S(m) zero, so every estimate is unbiased. Only then is the variance of
an estimate the sum of |f(m)|^2 E|S(m)|^2 (Pilleboue et al. 2015).
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit import ConfiguredSampler, randomizer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_KEPT = 64
"""Number of sets that are kept in memory: more than threads work on."""


class _SharedSets(ConfiguredSampler):
    """A sampler that uses each set under several random shifts: realisation r is set r // shifts with shift r."""

    def __init__(self, sampler: ConfiguredSampler, shifts: int) -> None:
        super().__init__(*sampler.followed_by("shift").parts)
        self._shifts = shifts
        self._shift = randomizer("shift")
        # Realisation r is pixel r; the sets are taken from pixels as far apart as the sampler needs.
        self._apart = 1

        # Realisations of one set are often asked for in several calls, by several threads.
        @lru_cache(maxsize=_KEPT)
        def points_of_set(number: int, seed: int, dims: int, count: int) -> NDArray[np.float64]:
            points = np.empty((1, dims, count))
            sampler.fill(points, sampler.trials(number, number + 1, seed), count, 0)
            return np.asarray(points[0])

        self._points_of_set = points_of_set

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        if start or out.shape[2] != count:
            raise ValueError("sets that are shifted anew are taken whole")
        for points, number in zip(out, realizations.x // self._shifts, strict=True):
            points[:] = self._points_of_set(int(number), realizations.seed, out.shape[1], count)
        self._shift.apply(out, realizations)


def is_homogeneous(sampler: ConfiguredSampler) -> bool:
    """Return whether all shifts of a set are equally likely: they are for independent points and after a shift."""
    return sampler.text.endswith("+shift") or (sampler.text == "random" and sampler.plugin.builtin)


def homogenized(sampler: ConfiguredSampler, shifts: int = 1) -> ConfiguredSampler:
    """Return the sampler followed by a random shift, or the sampler itself if a shift would change nothing.

    With ``shifts`` above 1, so many realisations in a row use the same set with different shifts.
    """
    if shifts > 1:
        return _SharedSets(sampler, shifts)
    return sampler if is_homogeneous(sampler) else sampler.followed_by("shift")
