"""The point sets whose spectra are taken, in parts where the sampler can make a part of a set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit import ConfiguredSampler, Realizations
    from samplekit_spectrum.transform import Chunks

CHUNK = 2**20
"""Points of a set that are made at once."""


@dataclass(frozen=True, eq=False)
class Source:
    """The point sets: which sampler, how many points, in how many dimensions, from which seed."""

    sampler: ConfiguredSampler
    count: int
    dims: int
    seed: int


class Sets:
    """The points of some realisations, in chunks of about a million where the sampler can make a part of a set."""

    def __init__(self, source: Source, realizations: Realizations) -> None:
        self.count = source.count
        self._source, self._realizations = source, realizations
        self._whole: NDArray[np.float64] | None = None

    def of(self, axes: tuple[int, ...], member: int | None = None) -> Chunks:
        """The chunks on some axes, as often as they are asked for."""
        return lambda: self._chunks(axes, member)

    def _chunks(self, axes: tuple[int, ...], member: int | None = None) -> Iterator[NDArray[np.float64]]:
        """Coordinates on ``axes``, last axis first: float64[k, D, n]; of one member alone, if it is given."""
        rows = slice(None) if member is None else slice(member, member + 1)
        order = list(reversed(axes))
        if self._whole is not None:
            yield self._whole[rows][:, order]
            return
        source = self._source
        realizations = self._realizations[rows]
        if source.count <= CHUNK or not source.sampler.streams:
            self._whole = self._filled(self._realizations, 0, source.count)
            yield self._whole[rows][:, order]
            return
        for start in range(0, source.count, CHUNK):
            length = min(CHUNK, source.count - start)
            yield self._filled(realizations, start, length)[:, order]

    def _filled(self, realizations: Realizations, start: int, length: int) -> NDArray[np.float64]:
        points = np.empty((len(realizations), self._source.dims, length))
        self._source.sampler.fill(points, realizations, self._source.count, start)
        return points
