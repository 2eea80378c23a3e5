"""Realisations: which point sets are asked for. A realisation is a pixel.

The key of a pixel is mix64((x | y << 32) ^ w) + b. The words w and b are bijections of the seed, and b is 0 for seed 0.
Within a seed no two pixels have the same key. Pixels of two seeds have the same key with a probability of 2^-64.
Without b, two seeds whose w differ in the last bit would have the same image with neighbouring pixels swapped; now the
keys of such pixels differ by the difference of the two b, which is never 0. Among a million seeds that were chosen to
be alike, no image of at most 64 x 64 pixels is a permutation of another (``tests/test_realizations.py``).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit._arguments import LARGEST_SEED
from samplekit._errors import UsageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

LARGEST_COORDINATE = 2**32 - 1


def _mix64(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """The bijection of :func:`samplekit.kernels.mix64` on whole arrays, without importing numba."""
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return x ^ (x >> np.uint64(31))


@dataclass(frozen=True, eq=False)
class Realizations:
    """A batch of R realisations: one point set each.

    Sets of different pixels are independent, unless the sampler declares a ``screen_block``;
    :meth:`ConfiguredSampler.trials` returns realisations that are independent in any case.

    Attributes
    ----------
    keys
        uint64[R]. Within one seed no two pixels have the same key: the key is a bijection of (x, y).
    x, y
        int64[R]. Pixel coordinates.
    seed
        The seed, for samplers that share something between all pixels.
    blocks
        Sizes of the blocks that the dimensions form by purpose, such as (2, 2, 1) for pixel, lens and time; empty when
        nothing is known of them.

    Examples
    --------
    >>> import numpy as np
    >>> from samplekit import Realizations
    >>> len(Realizations.of_pixels(np.arange(5), np.zeros(5, np.int64), seed=7).keys)
    5
    """

    keys: NDArray[np.uint64]
    x: NDArray[np.int64]
    y: NDArray[np.int64]
    seed: int
    blocks: tuple[int, ...] = ()

    @classmethod
    def of_pixels(
        cls, x: NDArray[np.int64], y: NDArray[np.int64], seed: int, blocks: tuple[int, ...] = ()
    ) -> Realizations:
        """Realisations of the pixels (x, y), each coordinate from 0 to 2^32 - 1.

        Raises
        ------
        UsageError
            The seed is not from 0 to 2^64 - 1, or a coordinate is out of range.
        """
        check_seed(seed)
        x = np.ascontiguousarray(x, np.int64)
        y = np.ascontiguousarray(y, np.int64)
        for coordinate in (x, y):
            if coordinate.size and (coordinate.min() < 0 or coordinate.max() > LARGEST_COORDINATE):
                raise UsageError(f"pixel coordinates must be from 0 to {LARGEST_COORDINATE}")
        code = x.astype(np.uint64) | (y.astype(np.uint64) << np.uint64(32))
        word, offset = seed_words(seed)
        return cls(_mix64(code ^ word) + offset, x, y, seed, blocks)

    def random_words(self, dims: int) -> NDArray[np.uint64]:
        """64 random bits for each realisation and dimension, uint64[R, dims]: for shifts and the like, in NumPy.

        A word depends on key and dimension alone.
        """
        dimension = np.arange(1, dims + 1, dtype=np.uint64) * np.uint64(0xD1342543DE82EF95)
        return _mix64(_mix64(self.keys[:, None] ^ dimension) + np.uint64(0x9E3779B97F4A7C15))

    def __len__(self) -> int:
        return int(self.keys.size)

    def __getitem__(self, rows: slice) -> Realizations:
        keys = np.ascontiguousarray(self.keys[rows])
        x, y = np.ascontiguousarray(self.x[rows]), np.ascontiguousarray(self.y[rows])
        return Realizations(keys, x, y, self.seed, self.blocks)


@lru_cache
def seed_words(seed: int) -> tuple[np.uint64, np.uint64]:
    """Return the two words that the seed contributes to every key, as :func:`samplekit.kernels.pixel_key` takes them.

    Each is a bijection of the seed; the second of seed 0 is 0.

    Examples
    --------
    >>> from samplekit import seed_words
    >>> int(seed_words(0)[1]), int(seed_words(1)[1]) > 0
    (0, True)
    """
    seeds = np.array([seed], np.uint64)
    return _mix64(seeds ^ np.uint64(0x9E3779B97F4A7C15))[0], _mix64(seeds)[0]


def check_seed(seed: object) -> int:
    """Return the seed as an int.

    Raises
    ------
    UsageError
        It is not an integer from 0 to 2^64 - 1.

    Examples
    --------
    >>> from samplekit import check_seed
    >>> check_seed(7)
    7
    """
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or not 0 <= int(seed) <= LARGEST_SEED:
        raise UsageError(f"seed {seed}: expected an integer from 0 to {LARGEST_SEED}")
    return int(seed)
