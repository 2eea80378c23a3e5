"""The integration loop: points, values of the scene, sums, means of pixels. Everything that integrates calls it.

It works in tiles of about 512 KB of points, so that memory does not grow with the number of samples. Sums are taken in
blocks of at most 1024 samples, and blocks are combined pairwise: no result depends on the size of the tile.
"""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import BLOCK, PairwiseSum, row_sums

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene

    Array = NDArray[np.float64]

TILE_BYTES = 512 * 1024
_scratch = threading.local()


class Clock:
    """Seconds spent on points and on the scene, by one or several timers.

    Attributes
    ----------
    points, scene
        Seconds by each of the timers.
    """

    def __init__(self, *timers: Callable[[], float]) -> None:
        self._timers = timers or (time.perf_counter,)
        self.points = [0.0] * len(self._timers)
        self.scene = [0.0] * len(self._timers)
        self._began: list[float] = []

    def start(self) -> None:
        """Remember what the timers show now."""
        self._began = [timer() for timer in self._timers]

    def stop(self, seconds: list[float]) -> None:
        """Add the seconds since the start to ``points`` or to ``scene``."""
        for index, timer in enumerate(self._timers):
            seconds[index] += timer() - self._began[index]


def unit_square(pixels: int) -> Array:
    """Return the box of the unit square as one pixel, so many times: float64[4, pixels]."""
    return np.repeat(np.array([0.0, 1.0, 0.0, 1.0])[:, None], pixels, axis=1)


def pixels_per_tile(
    scene: ConfiguredScene, sampler: ConfiguredSampler, count: int, tile_bytes: int = TILE_BYTES
) -> int:
    """Return the number of pixels whose points fill a tile."""
    points = min(count, BLOCK) if sampler.streams else count
    return max(1, tile_bytes // (8 * scene.dims * points))


def integrate(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    counts: Sequence[int],
    realizations: Realizations,
    boxes: Array,
    *,
    clock: Clock | None = None,
    tick: Callable[[int], None] = lambda _: None,
    observe: Callable[[Array, Array], None] = lambda _, __: None,
    tile_bytes: int = TILE_BYTES,
) -> Array:
    """Estimate the mean of a scene over pixels.

    Parameters
    ----------
    scene, sampler
        The integrand, and the sampler that makes its points.
    counts
        Numbers of samples, rising. All estimates are of prefixes of one set of ``counts[-1]`` points, so several counts
        need a progressive sampler.
    realizations
        One for each of the P pixels.
    boxes
        float64[4, P]: left edge, width, top edge, height.
    clock
        Receives the seconds spent on points and on the scene; None: a clock that nobody reads.
    tick
        Called now and then with the number of samples done since the last call.
    observe
        Called before the scene with each tile of samples float64[P, D, n] and their pixels' boxes float64[4, P], of
        which it may keep neither: for sums in extended precision, and to count values.
    tile_bytes
        Size of a tile of points; no result depends on it.

    Returns
    -------
    float64[len(counts), P]
    """
    pixels, clock = len(realizations), clock or Clock()
    at_once = pixels_per_tile(scene, sampler, counts[-1], tile_bytes)
    means = np.empty((len(counts), pixels))
    # Values that are not finite are counted and reported; a warning for each would drown that.
    with np.errstate(all="ignore"):
        for first in range(0, pixels, at_once):
            part = slice(first, first + at_once)
            part_boxes, total, block, row = boxes[:, part].copy(), PairwiseSum(), np.zeros(0), 0
            for start, stop, tile in _tiles(scene, sampler, counts, realizations[part], clock):
                observe(tile, part_boxes)
                sums = np.empty(part_boxes.shape[1])
                clock.start()
                scene.sums(tile, part_boxes, sums)
                clock.stop(clock.scene)
                tick(sums.size * (stop - start))
                block = block + sums if start % BLOCK else sums
                # The end of a single count joins the tree of partial sums; a prefix leaves the tree as it is.
                joins = stop % BLOCK == 0 or len(counts) == 1
                if joins:
                    total.add(block)
                if stop == counts[row]:
                    sums = total.total() if joins else total.total() + block if stop > BLOCK else block
                    means[row, part] = sums / stop
                    row += 1
    return means


def _tiles(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    counts: Sequence[int],
    realizations: Realizations,
    clock: Clock,
) -> Iterator[tuple[int, int, Array]]:
    """Yield the points from ``start`` to ``stop`` of the sets, float64[P, D, stop - start], segment by segment.

    A tile is overwritten by the next.
    """
    pixels, count = len(realizations), counts[-1]
    clock.start()
    whole: Array | None = None
    if not sampler.streams and (count > BLOCK or len(counts) > 1):
        # A part of such a set takes as long as the set: it is made once.
        whole = np.empty((pixels, scene.dims, count))
        sampler.fill(whole, realizations, count, 0)
    buffer = _buffer(pixels * scene.dims * min(count, BLOCK))
    for start, stop in _segments(counts):
        if whole is not None:
            tile = np.ascontiguousarray(whole[:, :, start:stop])
        else:
            tile = buffer[: pixels * scene.dims * (stop - start)].reshape(pixels, scene.dims, stop - start)
            sampler.fill(tile, realizations, count, start)
        clock.stop(clock.points)
        yield start, stop, tile
        clock.start()


def _segments(counts: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Yield neighbouring ranges of indices, cut at every count and at every block."""
    start = 0
    for count in counts:
        while start < count:
            stop = min(count, (start // BLOCK + 1) * BLOCK)
            yield start, stop
            start = stop


def _buffer(size: int) -> Array:
    """Return scratch memory of this thread, kept from call to call: fresh pages cost as much as filling them."""
    buffer: Array | None = getattr(_scratch, "buffer", None)
    if buffer is None or buffer.size < size:
        buffer = _scratch.buffer = np.empty(size)
    return buffer


def count_invalid_samples(
    scene: ConfiguredScene, sampler: ConfiguredSampler, count: int, realizations: Realizations, boxes: Array
) -> int:
    """Return the number of samples at which the scene is not finite, over the given pixels."""
    invalid = 0

    def observe(tile: Array, boxes: Array) -> None:
        nonlocal invalid
        invalid += int(np.count_nonzero(~np.isfinite(scene.values(tile, boxes))))

    integrate(scene, sampler, (count,), realizations, boxes, observe=observe)
    return invalid


def mean_of_constant(value: float, count: int) -> float:
    """Return the estimate that ``count`` samples of one value give, in the same order of summation."""

    def block_sum(samples: int) -> Array:
        out = np.empty(1)
        row_sums(np.full((1, samples), value), out)
        return out

    blocks, rest = divmod(count, BLOCK)
    total = PairwiseSum.of_equal(block_sum(BLOCK), blocks)
    if rest:
        total.add(block_sum(rest))
    return float(total.total()[0] / count)
