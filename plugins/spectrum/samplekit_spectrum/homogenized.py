"""Homogenisation: any sampler followed by one random toroidal shift of the whole set.

It leaves |S(m)| as it is, makes the mean of S(m) zero, and with it every estimate unbiased; only then is the variance
of an estimate the sum of |f(m)|^2 E|S(m)|^2 (Pilleboue et al. 2015).
"""

from __future__ import annotations

from dataclasses import replace

from samplekit.builtin.randomizers.shift import Shift
from samplekit.sampling.configured import ConfiguredSampler
from samplekit.sampling.randomizer import RandomizedSampler


class Homogenized(ConfiguredSampler):
    """A sampler with its own randomizer, and behind it a shift; the same points as ``+shift`` where there is none."""

    def __init__(self, sampler: ConfiguredSampler) -> None:
        # Everything as the sampler has it, but for the points.
        vars(self).update(vars(sampler))
        self._inner = sampler
        self._sampler = RandomizedSampler(self._sampler, Shift(), "shift")
        self.text = f"{sampler.text}+shift"
        self.spec = replace(sampler.spec, randomized=True, unbiased=True, promises=())

    def fresh(self) -> ConfiguredSampler:
        """With every realisation made afresh."""
        inner = self._inner.fresh()
        return self if inner is self._inner else Homogenized(inner)


def is_homogeneous(sampler: ConfiguredSampler) -> bool:
    """Whether every shift of the sampler's sets is as likely: independent points, and what has just been shifted."""
    return sampler.text.endswith("+shift") or (sampler.text == "random" and sampler.plugin.name == "samplekit")


def homogenized(sampler: ConfiguredSampler) -> ConfiguredSampler:
    """The sampler followed by a random shift, unless that changes nothing."""
    return sampler if is_homogeneous(sampler) else Homogenized(sampler)
