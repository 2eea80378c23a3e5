"""Samplers and randomizers of plugins under guard: what they give is checked, and their faults are named."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._bases.randomizer import Randomizer
from samplekit._bases.sampler import Sampler
from samplekit._specs import SamplerSpec

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations
    from samplekit._bases.sampler import Fill
    from samplekit._guard import Guard


class GuardedSampler(Sampler):
    """A plugin's sampler."""

    def __init__(self, sampler: Sampler, guard: Guard) -> None:
        self._sampler = sampler
        self._guard = guard

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; values outside [0, 1) and unwritten ones are faults."""
        self._checked(self._sampler.fill, out, realizations, count, start)

    def _checked(
        self, fill: Fill, out: NDArray[np.float64], realizations: Realizations, count: int, start: int
    ) -> None:
        # What a plugin does not write must not pass for a result.
        out.fill(np.nan)
        self._guard("failed", lambda: fill(out, realizations, count, start))
        _check_values(out, self._guard)

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """As the sampler."""
        self._guard("failed", lambda: self._sampler.check(count, dims, blocks))

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None]) -> None:
        """As the sampler."""
        self._guard("failed", lambda: self._sampler.prepare(count, dims, progress))

    def notes(self, count: int, dims: int) -> list[str]:
        """As the sampler."""
        return self._guard("cannot tell its notes", lambda: self._sampler.notes(count, dims), _is_texts, "texts")

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """As the sampler."""
        return self._guard(
            "cannot refine its declaration",
            lambda: self._sampler.refine(spec),
            lambda refined: isinstance(refined, SamplerSpec),
            "a SamplerSpec",
        )

    def bases(self, dims: int) -> tuple[int, ...]:
        """As the sampler."""
        return self._guard(
            "cannot tell the bases of its digits",
            lambda: tuple(map(operator.index, self._sampler.bases(dims))),
            lambda bases: len(bases) == dims and min(bases) >= 2,
            f"{dims} integers from 2 on",
        )

    def fused(self, randomizer: str) -> Fill | None:
        """As the sampler; what it gives is guarded as well."""
        fill = self._guard(
            "cannot be randomised",
            lambda: self._sampler.fused(randomizer),
            lambda fill: fill is None or callable(fill),
            "a function or None",
        )
        return None if fill is None else _GuardedFill(self, fill)

    @property
    def streams(self) -> bool:
        """As the sampler."""
        return self._guard(
            "cannot tell whether it makes parts of sets",
            lambda: self._sampler.streams,
            lambda streams: isinstance(streams, bool),
            "True or False",
        )


class _GuardedFill:
    """The fused form of a guarded sampler: an object, as a function of a function cannot be pickled."""

    def __init__(self, sampler: GuardedSampler, fill: Fill) -> None:
        self._sampler = sampler
        self._fill = fill

    def __call__(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        self._sampler._checked(self._fill, out, realizations, count, start)  # noqa: SLF001 - a part of it


class GuardedRandomizer(Randomizer):
    """A plugin's randomizer."""

    def __init__(self, randomizer: Randomizer, guard: Guard) -> None:
        self._randomizer = randomizer
        self._guard = guard

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Randomise the points; values outside [0, 1) are faults."""
        self._guard("failed", lambda: self._randomizer.apply(points, realizations, bases))
        _check_values(points, self._guard)


def _check_values(values: NDArray[np.float64], guard: Guard) -> None:
    low, high = values.min(), values.max()
    if not (low >= 0.0 and high < 1.0):
        wrong = "NaN or values it did not write" if np.isnan(low) else f"{float(low if low < 0 else high)!r}"
        raise guard.blame(f"gave {wrong}: expected values in [0, 1)")


def _is_texts(notes: Any) -> bool:
    return isinstance(notes, (list, tuple)) and all(isinstance(note, str) for note in notes)
