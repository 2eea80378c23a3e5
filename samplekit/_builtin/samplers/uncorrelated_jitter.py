"""Uncorrelated jitter: every block of dimensions jittered on a grid of its own, the blocks combined in random order.

Cook, Porter, Carpenter 1984, "Distributed ray tracing": pixel, lens and time are stratified each on their own, for a
grid over all dimensions would need too many samples; sample i takes cell i of the pixel and a cell of the lens and of
the time that a random permutation gives it, so that no part of the lens belongs to a part of the pixel.

The blocks are those that the scene declares, such as (2, 2, 1); where nothing is known of them, pairs of dimensions and
a last odd one alone. A block of k dimensions has the grid of near-equal sides in k dimensions, a block of one N
intervals. Block 0 keeps its order, which is as random as any while all others are permuted: its points do not depend on
what follows, and in two dimensions this is the sampler ``jittered``.
"""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Products, Sampler, UsageError, grid_sides
from samplekit._builtin.samplers.jittered_blocks import fill_jittered_blocks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_FARTHEST = 100_000
"""Counts that are tried on either side in search of one that fits."""


def block_sizes(dims: int, blocks: tuple[int, ...]) -> list[int]:
    """The sizes of the blocks that ``dims`` dimensions form: those given, cut or continued by pairs to fit."""
    sizes: list[int] = []
    for size in (*blocks, *(2 for _ in range(dims))):
        left = dims - sum(sizes)
        if left > 0:
            sizes.append(min(size, left))
    return sizes


def _fits(count: int, sizes: set[int]) -> bool:
    return all(grid_sides(count, size) is not None for size in sizes)


class UncorrelatedJitter(Sampler):
    """Jittered blocks of dimensions, combined at random."""

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """Raise unless the points form a grid in every block.

        Raises
        ------
        UsageError
            A block of three dimensions or more has no such grid: names the nearest counts for which all blocks have.
        """
        sizes = set(block_sizes(dims, blocks)) | {2}
        if _fits(count, sizes):
            return
        size = max(size for size in sizes if not Products(size).allows(count, dims))
        below = next((n for n in range(count - 1, max(count - _FARTHEST, 0), -1) if _fits(n, sizes)), None)
        above = next((n for n in range(count + 1, count + _FARTHEST) if _fits(n, sizes)), None)
        nearest = " and ".join(str(n) for n in (below, above) if n is not None) or "far away"
        raise UsageError(
            f"uncorrelated-jitter makes {Products(size).describe()} for a block of {size} dimensions,"
            f" not {count}: the nearest for blocks of {', '.join(map(str, sorted(sizes)))} are {nearest}"
        )

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        dims = out.shape[1]
        sizes = block_sizes(dims, realizations.blocks)
        block, sides, strides = [], [], []
        for first, size in zip(accumulate(sizes, initial=0), sizes, strict=False):
            grid = grid_sides(count, size)
            if grid is None:
                raise UsageError(f"{count} points do not form a grid of near-equal sides in {size} dimensions")
            block += [first] * size
            sides += list(grid)
            strides += list(accumulate(grid[:-1], lambda a, b: a * b, initial=1))
        fill_jittered_blocks(out, realizations.keys, np.array(block), np.array(sides), np.array(strides), count, start)
