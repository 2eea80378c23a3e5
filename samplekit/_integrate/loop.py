"""Points -> scene -> mean of a pixel: the one core that rendering and studies share.

Works in tiles of about 512 KB of points, so that memory does not grow with the number of samples. Sums are taken in
blocks of at most 1024 samples and combined pairwise: no result depends on the tile.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.samples import sample_values
from samplekit.kernels._sums import BLOCK, PairwiseSum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations
    from samplekit._chosen.sampler import ConfiguredSampler
    from samplekit._chosen.scene import ConfiguredScene

TILE_BYTES = 512 * 1024
_scratch = threading.local()
UNIT_SQUARE = (0.0, 1.0, 0.0, 1.0)
"""The box of the unit square as one pixel."""


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

    @cached_property
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
        sums = np.empty(len(realizations))
        buffer = self._buffer(min(sums.size, self.pixels_per_tile))
        for first in range(0, sums.size, self.pixels_per_tile):
            pixels = slice(first, first + self.pixels_per_tile)
            self._sum(realizations[pixels], boxes[:, pixels].copy(), buffer, sums[pixels], seconds, tick)
        return sums / self.count

    def _sum(
        self,
        realizations: Realizations,
        boxes: NDArray[np.float64],
        buffer: NDArray[np.float64],
        out: NDArray[np.float64],
        seconds: Seconds,
        tick: Callable[[int], None],
    ) -> None:
        """Write the sums over all samples of a tile's pixels into ``out``."""
        total = PairwiseSum()
        block_sums = out
        for start in range(0, self.count, BLOCK):
            began = time.perf_counter()
            tile = self._tile(realizations, start, buffer)
            filled = time.perf_counter()
            self.scene.sums(tile, boxes, block_sums)
            seconds.points += filled - began
            seconds.scene += time.perf_counter() - filled
            tick(tile.shape[0] * tile.shape[2])
            # Where one block is the whole set its sums are the result: nothing to combine.
            if self.count > BLOCK:
                total.add(block_sums)
        if self.count > BLOCK:
            out[:] = total.total()

    def blocks(self, realizations: Realizations) -> Iterator[NDArray[np.float64]]:
        """The points, block by block: float64[P, D, n] with n <= 1024, to be used before the next is asked for."""
        buffer = self._buffer(len(realizations))
        for start in range(0, self.count, BLOCK):
            yield self._tile(realizations, start, buffer)

    def invalid_samples(self, realizations: Realizations, boxes: NDArray[np.float64]) -> int:
        """The number of samples at which the scene is not finite, over the given pixels."""
        invalid = 0
        buffer = self._buffer(1)
        for pixel in range(len(realizations)):
            single_pixel = realizations[pixel : pixel + 1]
            for start in range(0, self.count, BLOCK):
                tile = self._tile(single_pixel, start, buffer)
                values = sample_values(self.scene, tile, boxes[:, pixel : pixel + 1])
                invalid += int(np.count_nonzero(~np.isfinite(values)))
        return invalid

    def mean_of_constant(self, value: float) -> float:
        """The estimate that ``count`` samples of one value give, in the same order of summation."""
        from samplekit.kernels._row_sums import row_sums

        def block_sum(samples: int) -> NDArray[np.float64]:
            out = np.empty(1)
            row_sums(np.full((1, samples), value), out)
            return out

        blocks, rest = divmod(self.count, BLOCK)
        total = PairwiseSum.of_equal(block_sum(BLOCK), blocks)
        if rest:
            total.add(block_sum(rest))
        return float(total.total()[0] / self.count)

    def _buffer(self, pixels: int) -> NDArray[np.float64]:
        """Scratch memory of this thread, kept from call to call: fresh pages cost as much as filling them."""
        size = pixels * self.scene.dims * min(self.count, BLOCK)
        buffer: NDArray[np.float64] | None = getattr(_scratch, "buffer", None)
        if buffer is None or buffer.size < size:
            buffer = _scratch.buffer = np.empty(size)
        return buffer

    def _tile(self, realizations: Realizations, start: int, buffer: NDArray[np.float64]) -> NDArray[np.float64]:
        """The block of points from ``start`` on, float64[P, D, n] with n <= 1024, in ``buffer``."""
        pixels, dims = len(realizations), self.scene.dims
        length = min(BLOCK, self.count - start)
        if not self.sampler.streams and self.count > BLOCK:
            return np.ascontiguousarray(self._whole(realizations)[:, :, start : start + length])
        tile = buffer[: pixels * dims * length].reshape(pixels, dims, length)
        self.sampler.fill(tile, realizations, self.count, start)
        return tile

    def _whole(self, realizations: Realizations) -> NDArray[np.float64]:
        """The whole sets float64[P, D, N] of a sampler that makes no parts, kept while their blocks are used."""
        kept: tuple[Realizations, NDArray[np.float64]] | None = getattr(_scratch, "whole", None)
        if kept is None or kept[0] is not realizations:
            whole = np.empty((len(realizations), self.scene.dims, self.count))
            self.sampler.fill(whole, realizations, self.count, 0)
            kept = _scratch.whole = (realizations, whole)
        return kept[1]
