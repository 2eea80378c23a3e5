"""The mutant: a sampler of ours with one thing broken."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

import samplekit
from samplekit import Sampler

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from samplekit import Realizations, SamplerSpec

    Array = NDArray[np.float64]

ALMOST_ONE = 1.0 - 2.0**-53
"""The largest float64 below 1."""
MUTANTS: list[type[Mutant]] = []
"""All of them, in the order of their definition."""


class Mutant(Sampler):
    """One of our samplers with one thing broken; subclasses say what, and which check must see it."""

    base: ClassVar[str]
    caught_by: ClassVar[str]
    declares: ClassVar[Mapping[str, object]] = {}

    def __init_subclass__(cls) -> None:
        if not cls.__name__.startswith("_"):
            MUTANTS.append(cls)

    def __init__(self) -> None:
        self.inner = samplekit.sampler(self.base)

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write the base's points, then spoil them."""
        self.inner.fill(out, realizations, count, start)
        self.spoil(out, realizations, count, start)

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Break something in ``out`` float64[R, D, n]."""

    @classmethod
    def spec(cls) -> SamplerSpec:
        """The declaration: the base's, and what the mutant claims beyond it."""
        name = "".join("-" + c.lower() if c.isupper() else c for c in cls.__name__).strip("-")
        base = samplekit.sampler(cls.base).spec
        target = f"{cls.__module__}:{cls.__name__}"
        # Python drops docstrings if it is asked to (-OO).
        summary = next(iter((cls.__doc__ or name).strip().splitlines()))
        return replace(base, name=name, target=target, summary=summary, options=(), **cls.declares)  # type: ignore[arg-type]


def indices(out: Array, start: int) -> NDArray[np.int64]:
    """Indices of the points in ``out`` float64[R, D, n]."""
    return np.arange(start, start + out.shape[2])


def per_key(realizations: Realizations, dims: int = 1) -> Array:
    """Give a random number for each realisation and dimension, float64[R, dims]."""
    return (realizations.random_words(dims) >> np.uint64(11)).astype(float) * 2.0**-53
