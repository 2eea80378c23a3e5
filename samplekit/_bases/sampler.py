"""The sampler: what every point set and sequence is built on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import SamplekitError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations
    from samplekit._specs import SamplerSpec

    Fill = Callable[[NDArray[np.float64], Realizations, int, int], None]


class Sampler:
    """Base of all samplers. Options arrive by keyword, parsed; dashes in their names are underscores here.

    A sampler defines one of two methods:

    - ``fill(out, realizations, count, start)`` writes points of the sets directly, with NumPy or a kernel;
    - ``draw(count, dims, rng)`` makes one set as a whole: slower, and enough for a first try.

    Values may depend on nothing but the options, the realisation (its key, or its pixel and the seed; the blocks of its
    dimensions), the index, the dimension, and, where the sampler is not progressive, the count and the number of
    dimensions.

    Examples
    --------
    >>> import samplekit
    >>> class Mine(samplekit.Sampler):
    ...     def draw(self, count, dims, rng):
    ...         return rng.random((count, dims))
    """

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points start to start + n of sets of ``count`` points.

        Parameters
        ----------
        out
            float64[R, D, n], C order: receives values in [0, 1), dimension by dimension.
        realizations
            The R sets that are asked for.
        count
            Number of points of a whole set.
        start
            Index of the first point that is written.
        """
        dims, points = out.shape[1:]
        for row, key in enumerate(realizations.keys):
            # Seeded by a sequence: a generator that cannot spawn others is refused by libraries that do.
            rng = np.random.Generator(np.random.Philox(np.random.SeedSequence(int(key))))
            drawn = np.asarray(self.draw(count, dims, rng), np.float64)
            if drawn.shape != (count, dims):
                raise SamplekitError(f"draw gave shape {drawn.shape}, expected {(count, dims)}")
            out[row] = drawn[start : start + points].T

    def draw(self, count: int, dims: int, rng: np.random.Generator) -> NDArray[np.float64]:
        """One set of ``count`` points, float64[count, dims] in [0, 1), made with ``rng`` alone."""
        raise NotImplementedError(f"{type(self).__name__} defines neither fill nor draw")

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """Raise :class:`samplekit.UsageError` if there are no such sets for a reason that the declaration cannot say.

        ``blocks``: as in :class:`Realizations`; empty where nothing is known of them.
        """

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None]) -> None:
        """Make what all sets of this kind share (tables, a bank of sets), called once before many are filled.

        ``progress`` takes the numbers of steps done and to do. Without this call ``fill`` gives the same points.
        """

    def notes(self, count: int, dims: int) -> list[str]:
        """Return sentences that a user of these sets should read, for example that they come from a bank."""
        return []

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """The declaration as the options of this instance change it."""
        return spec

    def bases(self, dims: int) -> tuple[int, ...]:
        """The base of the digits in which each dimension is built: what a digital randomizer scrambles."""
        return (2,) * dims

    def fused(self, randomizer: str) -> Fill | None:
        """A faster ``fill`` that gives the points of this sampler followed by the randomizer; None: there is none."""
        return None

    @property
    def streams(self) -> bool:
        """True if a part of a set takes a part of the time of the whole: with ``fill``, but not with ``draw``."""
        return type(self).fill is not Sampler.fill
