"""Sets that are made as a whole, and banks: a few sets that all pixels share, each under its own shift and symmetry.

A random shift on the torus and one of the eight symmetries of the square keep every distance and the expected power
spectrum, and make any set unbiased; fresh sets get them for that reason. A bank depends on the sampler, its options and
the count, not on the seed: it is made once, and kept across runs.
"""

import os
import threading
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit.files import cached_array
from samplekit.kernels import below, hash_index, kernel, mix64, second_key, unit

Array = NDArray[np.float64]

VERSION = 1
"""Part of a bank's key: raise it when the points of any sampler here change."""
MOST_POINTS = 2**20
"""Largest number of points in a bank, 16 MB: with more than 16 384 points per set, a bank has fewer than 64 sets."""

_U64 = np.uint64
_PLACE = _U64(0x510E527FADE682D1)
_X, _Y = 0x33061B50, 0xFCADEBD4
"""Set k of a bank is that of the pixel (k ^ _X, _Y) under seed 0."""
_FRESH_POINTS = 2**16
_MOST_BANKS = 4

_lock = threading.Lock()
_banks: OrderedDict[str, Array] = OrderedDict()


@kernel("void(float64[:,:,::1], float64[:,:,::1], uint64[::1], int64, boolean)")
def _place(out: Array, sets: Array, keys: NDArray[np.uint64], start: int, shared: bool) -> None:
    """Write points of set r, or with ``shared`` of a random set, under the shift and symmetry of realisation r.

    ``sets`` float64[S, 2, N].
    """
    realizations, _, points = out.shape
    for r in range(realizations):
        key = mix64(keys[r] ^ _PLACE)
        second = second_key(key)
        chosen = np.int64(below(hash_index(key, second, _U64(0)), _U64(sets.shape[0]))) if shared else r
        symmetry = np.int64(hash_index(key, second, _U64(1)) & _U64(7))
        shift_x = unit(hash_index(key, second, _U64(2)))
        shift_y = unit(hash_index(key, second, _U64(3)))
        for i in range(points):
            x = sets[chosen, 0, start + i]
            y = sets[chosen, 1, start + i]
            if symmetry & 4:
                x, y = y, x
            # Multiples of 2^-53 below 1: the difference is exact, and so is its sum with 1.
            x = shift_x - x if symmetry & 1 else x - shift_x
            y = shift_y - y if symmetry & 2 else y - shift_y
            out[r, 0, i] = x + 1.0 if x < 0.0 else x
            out[r, 1, i] = y + 1.0 if y < 0.0 else y


class WholeSets(Sampler):
    """Base of the samplers that make a set as a whole, in two dimensions.

    Parameters
    ----------
    name
        The sampler and its options: all that a bank depends on, apart from the count.
    bank
        Number of sets in the bank; 0 makes every realisation afresh.
    """

    def __init__(self, name: str, bank: int) -> None:
        self._name = name
        self._bank = bank

    def make(self, sets: Array, realizations: Realizations) -> None:
        """Write whole sets to ``sets`` float64[R, 2, N], coordinates in [0, 1) that are multiples of 2^-53."""
        raise NotImplementedError

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        if self._bank:
            _place(out, self._sets(count), realizations.keys, start, True)
            return
        rows = max(1, _FRESH_POINTS // count)
        for first in range(0, len(realizations), rows):
            some = realizations[first : first + rows]
            sets = np.empty((len(some), 2, count))
            self.make(sets, some)
            _place(out[first : first + rows], sets, some.keys, start, False)

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None]) -> None:
        """Make or load the bank; see :meth:`samplekit.Sampler.prepare`."""
        if self._bank:
            self._sets(count, progress)

    def notes(self, count: int, dims: int) -> list[str]:
        """Say that the sets come from a bank; see :meth:`samplekit.Sampler.notes`."""
        if not self._bank:
            return []
        size = self._size(count)
        plural = "s" if count > 1 else ""
        return [f"one of {size} sets of {count} point{plural}, under a random shift and symmetry"]

    @property
    def streams(self) -> bool:
        """Return False: a set is made as a whole, even if only a part is wanted."""
        return False

    def _size(self, count: int) -> int:
        return max(1, min(self._bank, MOST_POINTS // count))

    def _sets(self, count: int, progress: Callable[[int, int], None] = lambda _, __: None) -> Array:
        """Return the bank, float64[B, 2, N]: the first thread that asks makes it while others wait."""
        shape = (self._size(count), 2, count)
        key = f"{self._name} bluenoise={VERSION} sets={shape[0]} count={count}"
        with _lock:
            if key not in _banks:
                name = f"{self._name.partition(' ')[0]}-{count}"
                _banks[key] = cached_array(name, key, lambda: self._make_bank(shape, progress), _is_bank(shape))
                if len(_banks) > _MOST_BANKS:
                    _banks.popitem(last=False)
            _banks.move_to_end(key)
            return _banks[key]

    def _make_bank(self, shape: tuple[int, int, int], progress: Callable[[int, int], None]) -> Array:
        sets = np.empty(shape)
        realizations = Realizations.of_pixels(np.arange(shape[0]) ^ _X, np.full(shape[0], _Y), 0)
        progress(0, shape[0])
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            made = pool.map(lambda k: self.make(sets[k : k + 1], realizations[k : k + 1]), range(shape[0]))
            for done, _ in enumerate(made, 1):
                progress(done, shape[0])
        return sets


def _is_bank(shape: tuple[int, ...]) -> Callable[[Array], bool]:
    return lambda sets: bool(
        sets.shape == shape and sets.dtype == np.float64 and sets.min() >= 0.0 and sets.max() < 1.0
    )
