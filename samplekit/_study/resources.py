"""The scenes, samplers and references of a study: each is made once in a process and then shared."""

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


class Resources:
    """Makes what jobs name by text, and keeps it. All methods may be called from many threads."""

    def __init__(self) -> None:
        self._made: dict[Hashable, object] = {}
        self._seconds: dict[Hashable, tuple[float, float]] = {}
        self._lock = threading.RLock()

    def scene(self, text: str) -> ConfiguredScene:
        """Return the scene that is written ``text``."""
        return self.once(("scene", text), lambda: configured_scene(text))

    def sampler(self, text: str) -> ConfiguredSampler:
        """Return the sampler that is written ``text``."""
        return self.once(("sampler", text), lambda: configured_sampler(text))

    def prepare(
        self, text: str, count: int, dims: int, progress: Callable[[int, int], None] = lambda _, __: None
    ) -> None:
        """Let the sampler ``text`` make what all of its sets of ``count`` points in ``dims`` dimensions share."""
        self.once(("prepared", text, count, dims), lambda: self.sampler(text).prepare(count, dims, progress))

    def pixels(self, text: str, size: tuple[int, int]) -> Pixels:
        """Return the pixels of an image of the scene ``text``; ``size`` is (width, height)."""
        return self.once(("pixels", text, size), lambda: Pixels.whole(self.scene(text), size))

    def reference(self, text: str, size: tuple[int, int]) -> Reference:
        """Return the exact image of the scene ``text``; ``size`` is (width, height)."""
        pixels = self.pixels(text, size)
        return self.once(("reference", text, size), lambda: pixels.scene.reference(pixels.x_edges, pixels.y_edges))

    def setup_seconds(self, scene: str, sampler: str, count: int, dims: int) -> list[tuple[float, float]]:
        """Return the processor and wall-clock seconds for making the scene, the sampler and what its sets share."""
        keys = (("scene", scene), ("sampler", sampler), ("prepared", sampler, count, dims))
        return [self._seconds.get(key, (0.0, 0.0)) for key in keys]

    def once(self, key: Hashable, make: Callable[[], T]) -> T:
        """Return the result of ``make``, which is called only the first time that ``key`` is asked for."""
        # One lock for all keys: whatever takes long (a bank of sets, a reference) is made by the first that needs it.
        with self._lock:
            if key not in self._made:
                cpu, wall = time.process_time(), time.perf_counter()
                self._made[key] = make()
                self._seconds[key] = time.process_time() - cpu, time.perf_counter() - wall
            return cast("T", self._made[key])


OF_PROCESS: Resources = Resources()
"""The resources of a worker process, for all of its threads."""
