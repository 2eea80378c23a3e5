"""The scenes, samplers and references of a study, each made once in a process."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, TypeVar, cast

from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import scene as configured_scene
from samplekit._integrate.pixels import Pixels

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from samplekit._bases.reference import Reference
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene

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

    def pixels(self, text: str, size: tuple[int, int]) -> Pixels:
        """Return the pixels of an image of a scene."""
        return self._once(("pixels", text, size), lambda: Pixels.whole(self.scene(text), size))

    def reference(self, text: str, size: tuple[int, int]) -> Reference:
        """Return the exact image of a scene."""
        pixels = self.pixels(text, size)
        return self._once(("reference", text, size), lambda: pixels.scene.reference(pixels.x_edges, pixels.y_edges))

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
