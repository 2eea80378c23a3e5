"""Estimates of all prefixes of a set from one draw of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.loop import TILE_BYTES
from samplekit.kernels._sums import BLOCK, PairwiseSum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations
    from samplekit._chosen.sampler import ConfiguredSampler
    from samplekit._chosen.scene import ConfiguredScene


def prefix_means(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    counts: Sequence[int],
    realizations: Realizations,
    boxes: NDArray[np.float64],
    tick: Callable[[int], None] = lambda _: None,
) -> NDArray[np.float64]:
    """The estimates of the first ``counts`` (rising) points of the sets of ``counts[-1]`` points.

    Parameters
    ----------
    scene, sampler
        What is integrated, with which points: progressive ones.
    realizations, boxes
        As in :meth:`samplekit._integrate.loop.Estimator.means`.
    tick
        Called now and then with the number of samples done since the last call.

    Returns
    -------
    float64[len(counts), P]
    """
    last = counts[-1]
    block = min(last, BLOCK)
    means = np.empty((len(counts), len(realizations)))
    at_once = min(len(realizations), max(1, TILE_BYTES // (8 * scene.dims * block)))
    # One buffer for all tiles: fresh pages cost as much as filling them.
    buffer = np.empty(at_once * scene.dims * block)
    for first in range(0, len(realizations), at_once):
        pixels = slice(first, first + at_once)
        part, part_boxes = realizations[pixels], boxes[:, pixels].copy()
        shape = len(part), scene.dims
        total, block_sum, row = PairwiseSum(), np.zeros(len(part)), 0
        for start, stop in _segments(counts):
            tile = buffer[: shape[0] * shape[1] * (stop - start)].reshape(*shape, stop - start)
            sampler.fill(tile, part, last, start)
            sums = np.empty(len(part))
            scene.sums(tile, part_boxes, sums)
            tick(len(part) * (stop - start))
            block_sum = sums if start % BLOCK == 0 else block_sum + sums
            if stop % BLOCK == 0:
                total.add(block_sum)
            if stop == counts[row]:
                means[row, pixels] = _prefix(total, block_sum, stop) / stop
                row += 1
    return means


def _segments(counts: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Neighbouring ranges of indices, cut at every count and at every block."""
    start = 0
    for count in counts:
        while start < count:
            stop = min(count, (start // BLOCK + 1) * BLOCK)
            yield start, stop
            start = stop


def _prefix(total: PairwiseSum, block_sum: NDArray[np.float64], stop: int) -> NDArray[np.float64]:
    """The sum of the first ``stop`` samples: whole blocks pairwise, as everywhere, and the one that it ends in."""
    if stop % BLOCK == 0:
        return total.total()
    return block_sum if stop < BLOCK else total.total() + block_sum
