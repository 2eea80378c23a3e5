"""The point sets whose spectra are computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit import ConfiguredSampler

CHUNK = 2**20
"""Number of points of a set that are made at once."""


@dataclass(frozen=True, eq=False)
class Source:
    """Where point sets come from: the sampler, the number of points and of dimensions, and the seed."""

    sampler: ConfiguredSampler
    count: int
    dims: int
    seed: int


class PointSets:
    """The points of realisations ``start`` to ``stop``.

    They are kept for all projections, or made chunk by chunk if the sets are large and the sampler can make parts.
    """

    def __init__(self, source: Source, start: int, stop: int) -> None:
        self.source, self.members = source, stop - start
        self._realizations = source.sampler.trials(start, stop, source.seed)
        in_chunks = source.sampler.streams and source.count > CHUNK
        self._whole = None if in_chunks else self._points(0, source.count)

    def chunks(self, axes: tuple[int, ...]) -> Iterator[NDArray[np.float64]]:
        """Yield the coordinates on ``axes``, last axis first: float64[k, D, n] for each chunk of n points."""
        order = axes[::-1]
        if self._whole is not None:
            yield self._whole[:, order]
            return
        for start in range(0, self.source.count, CHUNK):
            yield self._points(start, min(CHUNK, self.source.count - start))[:, order]

    def _points(self, start: int, length: int) -> NDArray[np.float64]:
        points = np.empty((self.members, self.source.dims, length))
        self.source.sampler.fill(points, self._realizations, self.source.count, start)
        return points
