"""Homogenisation: any sampler followed by one random toroidal shift of the whole set.

It leaves |S(m)| as it is, makes the mean of S(m) zero, and with it every estimate unbiased; only then is the variance
of an estimate the sum of |f(m)|^2 E|S(m)|^2 (Pilleboue et al. 2015).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from samplekit.builtin.randomizers.shift import Shift
from samplekit.sampling.configured import ConfiguredSampler

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations


class Homogenized(ConfiguredSampler):
    """A sampler with its own randomizer, and behind it a shift; the same points as ``+shift`` where there is none."""

    def __init__(self, sampler: ConfiguredSampler) -> None:
        self._inner = sampler
        self._shift = Shift()
        self.plugin = sampler.plugin
        self.text = f"{sampler.text}+shift"
        self.spec = replace(sampler.spec, randomized=True, unbiased=True)

    @property
    def streams(self) -> bool:
        """As the sampler."""
        return self._inner.streams

    def fresh(self) -> ConfiguredSampler:
        """With every realisation made afresh."""
        return Homogenized(self._inner.fresh())

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None] = lambda _, __: None) -> None:
        """As the sampler."""
        self._inner.prepare(count, dims, progress)

    def notes(self, count: int, dims: int) -> list[str]:
        """As the sampler."""
        return self._inner.notes(count, dims)

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets."""
        self._inner.fill(out, realizations, count, start)
        self._shift.apply(out, realizations, ())


def is_homogeneous(sampler: ConfiguredSampler) -> bool:
    """Whether every shift of the sampler's sets is as likely: independent points, and what has just been shifted."""
    return sampler.text.endswith("+shift") or (sampler.text == "random" and sampler.plugin.name == "samplekit")


def homogenized(sampler: ConfiguredSampler) -> ConfiguredSampler:
    """The sampler followed by a random shift, unless that changes nothing."""
    return sampler if is_homogeneous(sampler) else Homogenized(sampler)
