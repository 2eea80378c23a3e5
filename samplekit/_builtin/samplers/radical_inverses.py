"""Van der Corput, Halton and Hammersley points: radical inverses of the index in prime bases.

Halton 1960, "On the efficiency of certain quasi-random sequences of points in evaluating multi-dimensional
integrals"; Hammersley 1960, "Monte Carlo methods for solving multivariable problems". Indices start at 0, so that no
coordinate is 1.

While the index i is below the bases b and b', points are (i / b, i / b'): in the dimensions of 7907 and 7919 the first
256 points lie on a line. Scrambled digits end that. ``digits`` takes one random permutation of the digits for each
place (Owen 2017). ``owen`` takes one for each place and all digits before it (Owen 1995), which also makes the variance
fall faster.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from samplekit import Net, Realizations, Sampler, SamplerSpec
from samplekit.kernels import PERMUTED, PLAIN, SHIFTED, fill_mirrored, fill_nested, primes

Array = NDArray[np.float64]
Fill = Callable[[Array, Realizations, int, int], None]

_SCRAMBLE = np.uint64(0x9159015A3070DD17)


class RadicalInverses(Sampler):
    """Base of the samplers that give the same points in every realisation unless a randomizer changes them."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        fill_mirrored(out[:1], np.zeros(1, np.uint64), self._bases(out), start, PLAIN)
        out[1:] = out[0]

    def fused(self, randomizer: str) -> Fill | None:
        """Return the fill that makes shifted or scrambled points at once."""
        return {"xor": self._fill_shifted, "owen": self._fill_scrambled}.get(randomizer)

    def _fill_shifted(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        fill_mirrored(out, realizations.keys, self._bases(out), start, SHIFTED)

    def _fill_scrambled(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        fill_nested(out, realizations.keys, self._bases(out), start)

    def _bases(self, out: Array) -> NDArray[np.int64]:
        return np.array(self.bases(out.shape[1]), np.int64)


class Halton(RadicalInverses):
    """Dimension d is the radical inverse of the index in the (d + 1)-th prime.

    Parameters
    ----------
    scramble
        ``none``, ``digits`` (a random permutation for each place) or ``owen`` (nested scrambling).
    """

    def __init__(self, scramble: str = "none") -> None:
        self._scramble = scramble

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare that scrambled points are random and unbiased."""
        if self._scramble == "none":
            return spec
        return replace(spec, randomized=True, unbiased=True, largest_index=2**32 - 1)

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        if self._scramble == "none":
            super().fill(out, realizations, count, start)
            return
        # The randomizer ``owen`` may scramble these points once more: its hashes must differ from these.
        keys = realizations.keys ^ _SCRAMBLE
        if self._scramble == "owen":
            fill_nested(out, keys, self._bases(out), start)
        else:
            fill_mirrored(out, keys, self._bases(out), start, PERMUTED)

    def fused(self, randomizer: str) -> Fill | None:
        """Return the fused fill of unscrambled points; scrambled points have none."""
        return super().fused(randomizer) if self._scramble == "none" else None

    def bases(self, dims: int) -> tuple[int, ...]:
        """Return the first ``dims`` primes."""
        return primes(dims)


class VanDerCorput(RadicalInverses):
    """The radical inverse of the index in one base.

    Parameters
    ----------
    base
        Base of the digits, 2 to 1000.
    """

    def __init__(self, base: int = 2) -> None:
        self.base = base

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare nets in the base."""
        return replace(spec, promises=(Net(dims=(0,), base=self.base),))

    def fused(self, randomizer: str) -> Fill | None:
        """Return the fused fill, but leave Owen's scrambling in a composite base to the randomizer."""
        is_prime = self.base in primes(168)  # all up to 1000
        return super().fused(randomizer) if is_prime or randomizer != "owen" else None

    def bases(self, dims: int) -> tuple[int, ...]:
        """Return the base of the one dimension."""
        return (self.base,) * dims


class Hammersley(RadicalInverses):
    """Dimension 0 is index / count, dimension d the radical inverse in the d-th prime.

    In dimension 0 and the dimension of the prime b, b^m points are a (0, m, 2)-net in base b. Only the net in base 2 is
    declared, since dimension 0 can be scrambled in one base only.
    """

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        out[0, 0] = np.arange(start, start + out.shape[2]) / count
        bases = self._bases(out)[1:]
        if bases.size:
            fill_mirrored(out[:1, 1:], np.zeros(1, np.uint64), bases, start, PLAIN)
        out[1:] = out[0]

    def fused(self, randomizer: str) -> Fill | None:
        """Return None: index / count depends on the count."""
        return None

    def bases(self, dims: int) -> tuple[int, ...]:
        """Return base 2 for index / count, then the primes."""
        return (2, *primes(dims - 1))
