"""The randomizer: makes a random realisation of any point set, by changing the points' coordinates alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._bases.sampler import Sampler

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations


class Randomizer:
    """Base of all randomizers. Options arrive by keyword."""

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Randomise ``points`` float64[R, D, n] in place: by coordinate, key and dimension alone.

        ``bases``: the base in which each dimension's digits were built.
        """
        raise NotImplementedError(f"{type(self).__name__} defines no apply")


class RandomizedSampler(Sampler):
    """A sampler followed by a randomizer; where the sampler has a fused form, that is used."""

    def __init__(self, sampler: Sampler, randomizer: Randomizer, name: str) -> None:
        self._sampler = sampler
        self._randomizer = randomizer
        self._fused = sampler.fused(name)

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        if self._fused is not None:
            self._fused(out, realizations, count, start)
            return
        self._sampler.fill(out, realizations, count, start)
        self._randomizer.apply(out, realizations, self.bases(out.shape[1]))

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """As the sampler."""
        self._sampler.check(count, dims, blocks)

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None]) -> None:
        """As the sampler."""
        self._sampler.prepare(count, dims, progress)

    def notes(self, count: int, dims: int) -> list[str]:
        """As the sampler."""
        return self._sampler.notes(count, dims)

    def bases(self, dims: int) -> tuple[int, ...]:
        """The bases of the sampler."""
        return self._sampler.bases(dims)

    @property
    def streams(self) -> bool:
        """As the sampler."""
        return self._sampler.streams
