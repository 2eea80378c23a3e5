"""The scenes, samplers and references of a study, each made once in a process."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np

from samplekit._chosen.sampler import ConfiguredSampler, configured_sampler
from samplekit._chosen.scene import ConfiguredScene, configured_scene

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from numpy.typing import NDArray

    from samplekit._integrate.reference import Reference


T = TypeVar("T")


class Subjects:
    """What jobs name by text; may be used from many threads."""

    def __init__(self) -> None:
        self._made: dict[Hashable, object] = {}
        self._seconds: dict[Hashable, tuple[float, float]] = {}
        self._lock = threading.RLock()

    def scene(self, text: str) -> ConfiguredScene:
        """The scene that is written ``text``."""
        return self._once(("scene", text), lambda: configured_scene(text))

    def sampler(self, text: str) -> ConfiguredSampler:
        """The sampler that is written ``text``."""
        return self._once(("sampler", text), lambda: configured_sampler(text))

    def studied(self, text: str, size: tuple[int, int]) -> ConfiguredSampler:
        """The sampler that is written ``text``, as a study of such images measures it.

        Over the unit square, where the variance itself is studied, every realisation is made afresh, also by samplers
        whose images reuse sets: their text then says so.
        """
        sampler = self.sampler(text)
        return sampler.fresh() if size == (1, 1) else sampler

    def prepared(
        self, text: str, count: int, dims: int, progress: Callable[[int, int], None] = lambda _, __: None
    ) -> ConfiguredSampler:
        """The sampler, with what its sets of ``count`` points share made before."""

        def prepare() -> bool:
            self.sampler(text).prepare(count, dims, progress)
            return True

        self._once(("prepared", text, count, dims), prepare)
        return self.sampler(text)

    def reference(self, text: str, size: tuple[int, int]) -> Reference:
        """The exact image of a scene."""
        edges = _edges(size)
        return self._once(("reference", text, size), lambda: self.scene(text).reference(*edges))

    def sampled(self, text: str, size: tuple[int, int]) -> NDArray[np.int64]:
        """Flat indices of the pixels of an image of the scene that are sampled, row by row."""
        return self._once(("sampled", text, size), lambda: np.flatnonzero(np.isnan(self.constant(text, size))))

    def constant(self, text: str, size: tuple[int, int]) -> NDArray[np.float64]:
        """The values float64[P] of the pixels in which the scene is constant, NaN elsewhere."""
        edges = _edges(size)
        return self._once(("constant", text, size), lambda: self.scene(text).constant(*edges).ravel())

    def kept(self, key: Hashable, make: Callable[[], T]) -> T:
        """What ``make`` gives, made once."""
        return self._once(("kept", key), make)

    def seconds(self, key: Hashable) -> tuple[float, float]:
        """What it took to make something, by processor and wall clock."""
        return self._seconds.get(key, (0.0, 0.0))

    def _once(self, key: Hashable, make: Callable[[], T]) -> T:
        # One lock for all: what takes long (a bank of sets, a reference) is made by the first that needs it.
        with self._lock:
            if key not in self._made:
                cpu, wall = time.process_time(), time.perf_counter()
                self._made[key] = make()
                self._seconds[key] = time.process_time() - cpu, time.perf_counter() - wall
            return cast("T", self._made[key])


def _edges(size: tuple[int, int]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The edges of pixels, as renderings have them."""
    width, height = size
    return np.arange(width + 1) / width, np.arange(height + 1) / height
