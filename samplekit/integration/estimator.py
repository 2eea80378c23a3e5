"""Points -> scene -> mean of a pixel: the one core that rendering and studies share.

Works in tiles of about 256 KB of points, so that memory does not grow with the number of samples. Sums are taken in blocks
of at most 1024 samples and combined pairwise: no result depends on the tile.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.summation import BLOCK, PairwiseSum, lane_sum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from samplekit.integration.configured import ConfiguredScene
    from samplekit.sampling.configured import ConfiguredSampler
    from samplekit.sampling.realizations import Realizations

TILE_BYTES = 256 * 1024
UNIT_SQUARE = (0.0, 1.0, 0.0, 1.0)


@dataclass
class Seconds:
    """Time spent on points and on the scene, summed over threads."""

    points: float = 0.0
    scene: float = 0.0


@dataclass(frozen=True)
class Estimator:
    """The mean of a scene over pixels, with ``count`` samples each.

    Parameters
    ----------
    scene, sampler, count
        What is integrated, with which points, how many of them.
    tile_bytes
        Size of a tile of points; results do not depend on it.
    """

    scene: ConfiguredScene
    sampler: ConfiguredSampler
    count: int
    tile_bytes: int = TILE_BYTES

    @property
    def pixels_per_tile(self) -> int:
        """Number of pixels whose points fill a tile."""
        points = min(self.count, BLOCK) if self.sampler.streams else self.count
        return max(1, self.tile_bytes // (8 * self.scene.dims * points))

    def means(
        self,
        realizations: Realizations,
        boxes: NDArray[np.float64],
        seconds: Seconds,
        tick: Callable[[int], None] = lambda _: None,
    ) -> NDArray[np.float64]:
        """The estimates float64[P] for P pixels.

        Parameters
        ----------
        realizations
            One for each pixel.
        boxes
            float64[4, P]: left edge, width, top edge, height.
        seconds
            Receives the time spent.
        tick
            Called now and then with the number of samples done since the last call.
        """
        means = np.empty(len(realizations))
        for first in range(0, means.size, self.pixels_per_tile):
            pixels = slice(first, min(first + self.pixels_per_tile, means.size))
            box = np.ascontiguousarray(boxes[:, pixels])
            total = PairwiseSum()
            for tile in self._tiles(realizations[pixels], seconds):
                began = time.perf_counter()
                block_sums = np.empty(box.shape[1])
                self.scene.sums(tile, box, block_sums)
                total.add(block_sums)
                seconds.scene += time.perf_counter() - began
                tick(tile.shape[0] * tile.shape[2])
            means[pixels] = total.total() / self.count
        return means

    def invalid_samples(self, realizations: Realizations, boxes: NDArray[np.float64]) -> int:
        """The number of samples at which the scene is not finite, over the given pixels."""
        invalid = 0
        for pixel in range(len(realizations)):
            for tile in self._tiles(realizations[pixel : pixel + 1], Seconds()):
                # Each sample as a pixel of its own: a sum of one value is that value.
                single = np.ascontiguousarray(tile[0].T[:, :, None])
                values = np.empty(single.shape[0])
                self.scene.sums(single, np.repeat(boxes[:, pixel : pixel + 1], values.size, axis=1), values)
                invalid += int(np.count_nonzero(~np.isfinite(values)))
        return invalid

    def mean_of_constant(self, value: float) -> float:
        """The estimate that ``count`` samples of one value give, in the same order of summation."""
        total = PairwiseSum()
        for start in range(0, self.count, BLOCK):
            length = min(BLOCK, self.count - start)
            total.add(np.array([lane_sum(np.full(length, value), length)]))
        return float(total.total()[0] / self.count)

    def _tiles(self, realizations: Realizations, seconds: Seconds) -> Iterator[NDArray[np.float64]]:
        """The points of some pixels, block after block: float64[P, D, n], n <= 1024."""
        pixels, dims = len(realizations), self.scene.dims
        whole: NDArray[np.float64] | None = None
        buffer = np.empty(pixels * dims * min(self.count, BLOCK))
        for start in range(0, self.count, BLOCK):
            began = time.perf_counter()
            length = min(BLOCK, self.count - start)
            tile = buffer[: pixels * dims * length].reshape(pixels, dims, length)
            if self.sampler.streams:
                self.sampler.fill(tile, realizations, self.count, start)
            else:
                if whole is None:
                    whole = np.empty((pixels, dims, self.count))
                    self.sampler.fill(whole, realizations, self.count, 0)
                tile[:] = whole[:, :, start : start + length]
            seconds.points += time.perf_counter() - began
            yield tile
