"""A sampler as a user chose it: name, options and randomizers, checked against what they declare."""

from __future__ import annotations

import operator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit._arguments import as_integer, check_positive
from samplekit._bases.realizations import LARGEST_COORDINATE, Realizations, check_seed
from samplekit._bases.sampler import Sampler
from samplekit._configured.configured import Configured, find_choice
from samplekit._configured.randomizer import ConfiguredRandomizer, randomizer
from samplekit._errors import CountError, DimensionsError, UsageError
from samplekit._memory import check_memory
from samplekit._specs import SamplerSpec

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from samplekit._bases.sampler import Fill
    from samplekit._registry import Registration
    from samplekit._specs import RandomizerSpec


class ConfiguredSampler(Configured):
    """A sampler with its options, followed by randomizers, as :func:`samplekit.sampler` returns it.

    The text, the options and the plugin are those of :class:`Configured`; ``spec`` is the declaration of the whole: the
    sampler's, as its options and the randomizers change it.

    Attributes
    ----------
    streams
        Whether a part of a set costs a part of the time of the whole set.

    Examples
    --------
    >>> import samplekit
    >>> sampler = samplekit.sampler("sobol+owen")
    >>> sampler.text, sampler.points(4, dims=2).shape
    ('sobol+owen', (1, 4, 2))
    """

    spec: SamplerSpec

    def __init__(
        self,
        registration: Registration,
        options: Mapping[str, object],
        randomizers: tuple[ConfiguredRandomizer, ...] = (),
    ) -> None:
        super().__init__("sampler", registration, options)
        self.parts = registration, dict(options), randomizers
        """The arguments of the class that make this sampler."""
        self._sampler: Sampler = self._create(self.options, lambda made: isinstance(made, Sampler), "a Sampler")
        self.spec = self._boundary.call(
            "cannot refine its declaration",
            lambda: self._sampler.refine(self.spec),
            lambda refined: isinstance(refined, SamplerSpec),
            "a SamplerSpec",
        )
        self.streams: bool = self._boundary.call(
            "cannot tell whether it makes parts of sets",
            lambda: self._sampler.streams,
            lambda streams: isinstance(streams, bool),
            "True or False",
        )
        # Randomizers move the points of a set: how the sets of a block depend on each other, they cannot undo. A pixel
        # more than the block: the trials take different places of their blocks.
        self._apart = self.spec.screen_block + 1 if self.spec.screen_block else 1
        self._fill: Fill = self._sampler.fill
        self._randomizers = randomizers
        if randomizers:
            fused = self._boundary.call(
                "cannot be randomised",
                lambda: self._sampler.fused(randomizers[0].spec.name),
                lambda fill: fill is None or callable(fill),
                "a function or None",
            )
            if fused is not None:
                self._fill, self._randomizers = fused, randomizers[1:]
        for each in randomizers:
            self.text += f"+{each.text}"
            self.spec = _randomized(self.spec, each.spec)

    def fresh(self) -> ConfiguredSampler:
        """Return this sampler with every realisation made afresh: itself, unless it reuses sets."""
        registration, options, randomizers = self.parts
        fresh_options = registration.spec.fresh_options
        if all(self.options[name] == value for name, value in fresh_options.items()):
            return self
        return type(self)(registration, {**options, **fresh_options}, randomizers)

    def followed_by(self, name: str) -> ConfiguredSampler:
        """Return this sampler followed by one more randomizer.

        Raises
        ------
        UnknownNameError
            No randomizer has the name.
        """
        registration, options, randomizers = self.parts
        return ConfiguredSampler(registration, options, (*randomizers, randomizer(name)))

    def check(self, count: int, dims: int, blocks: tuple[int, ...] = ()) -> None:
        """Raise unless this sampler makes sets of ``count`` points in ``dims`` dimensions.

        Parameters
        ----------
        count, dims
            Points of a set, and dimensions.
        blocks
            Sizes of the blocks that the dimensions form; see :class:`Realizations`.

        Raises
        ------
        DimensionsError, CountError
            They carry what the sampler makes, and the nearest counts.
        UsageError
            The sampler refuses the request for another reason.
        PluginError
            The plugin failed.
        """
        least, most = self.spec.dimensions
        # As Python's integers: NumPy's overflow.
        dims, count = check_positive("dims", dims), check_positive("count", count)
        if dims < least or (most is not None and dims > most):
            raise DimensionsError(self.text, dims, least, most)
        if count - 1 > self.spec.largest_index:
            message = f"{self.text} makes at most {self.spec.largest_index + 1} points, not {count}"
            raise CountError(message, count, self.spec.counts.below(self.spec.largest_index + 2, dims), None)
        self.spec.counts.check(self.text, count, dims)
        self._boundary.call("failed", lambda: self._sampler.check(count, dims, blocks))

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None] = lambda _, __: None) -> None:
        """Make what all such sets share; see :meth:`Sampler.prepare`.

        Raises
        ------
        PluginError
            The plugin failed.
        """
        self._boundary.call("failed", lambda: self._sampler.prepare(count, dims, progress))

    def notes(self, count: int, dims: int) -> list[str]:
        """Return what a user of these sets should know; see :meth:`Sampler.notes`."""
        return self._boundary.call(
            "cannot tell its notes", lambda: self._sampler.notes(count, dims), _are_texts, "texts"
        )

    def trials(self, start: int, stop: int, seed: int, blocks: tuple[int, ...] = (), *, apart: int = 1) -> Realizations:
        """Return the independent realisations start to stop of this sampler.

        They are pixels in a row, one in each block of pixels that share a sequence (``screen_block``). Where a row
        ends, the next one is as far below as two pixels are apart.

        Parameters
        ----------
        start, stop
            Numbers of the first realisation and of the one after the last, from 0 on.
        seed
            From 0 to 2^64 - 1.
        blocks
            Sizes of the blocks that the dimensions form; see :class:`Realizations`.
        apart
            Least distance of two pixels.

        Raises
        ------
        UsageError
            The seed or a number is out of range.

        Examples
        --------
        >>> import samplekit
        >>> samplekit.sampler("jittered").trials(0, 3, seed=7).x, samplekit.sampler("z-sobol").trials(0, 3, seed=7).x
        (array([0, 1, 2]), array([  0,  65, 130]))
        """
        apart = max(apart, self._apart)
        columns = LARGEST_COORDINATE // apart + 1
        x = np.arange(start, stop, dtype=np.int64)
        y = np.zeros_like(x) if start >= 0 and stop <= columns else x // columns
        return Realizations.of_pixels((x - y * columns) * apart, y * apart, seed, blocks)

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`.

        Raises
        ------
        PluginError
            The plugin raised an exception, wrote values outside [0, 1), or left some unwritten.
        """
        self._boundary.fill("failed", out, lambda: self._fill(out, realizations, count, start))
        self._boundary.check_points(out)
        for each in self._randomizers:
            each.apply(out, realizations, self._bases(out.shape[1]))

    def _bases(self, dims: int) -> tuple[int, ...]:
        return self._boundary.call(
            "cannot tell the bases of its digits",
            lambda: tuple(map(operator.index, self._sampler.bases(dims))),
            lambda bases: len(bases) == dims and min(bases) >= 2,
            f"{dims} integers from 2 on",
        )

    def points(
        self,
        count: int,
        dims: int = 2,
        *,
        realizations: int = 1,
        seed: int = 0,
        start: int = 0,
        stop: int | None = None,
        progress: Callable[[int, int], None] = lambda _, __: None,
    ) -> NDArray[np.float64]:
        """Return points start to stop of sets of ``count`` points.

        Parameters
        ----------
        count, dims, realizations
            Size of a set, dimensions, number of sets: all at least 1.
        seed
            From 0 to 2^64 - 1.
        start, stop
            The slice of each set that is returned; by default all of it.
        progress
            Called with the numbers of steps done and to do while the sampler makes what its sets share.

        Returns
        -------
        float64[realizations, stop - start, dims], in [0, 1).

        Raises
        ------
        UsageError
            The sampler cannot make them.
        """
        self.check(count, dims)
        check_seed(seed)
        count, dims, realizations = int(count), int(dims), check_positive("realizations", realizations)
        first, end = as_integer(start), count if stop is None else as_integer(stop)
        if first is None or end is None or not 0 <= first < end <= count:
            raise UsageError(f"slice {start}:{stop}: expected integers with 0 <= start < stop <= {count}")
        # A float64 as the sampler makes it, and another in the order that is returned.
        check_memory(2 * 8 * realizations * dims * (end - first), "these points")
        self.prepare(count, dims, progress)
        out = np.empty((realizations, dims, end - first))
        self.fill(out, self.trials(0, realizations, seed), count, first)
        return np.ascontiguousarray(out.transpose(0, 2, 1))


def sampler(choice: str | SamplerSpec | ConfiguredSampler, **options: object) -> ConfiguredSampler:
    """Return a sampler that is ready to make points.

    Parameters
    ----------
    choice
        ``NAME[:option=value,...][+RANDOMIZER]``; or the declaration of a sampler that is not installed; or what this
        function returned before, which is returned as it is.
    options
        Options by keyword: a dash in the name of an option is an underscore here.

    Raises
    ------
    UsageError
        An unknown name or option, or a value that an option does not take.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.sampler("sobol+owen").spec.randomized
    True
    """
    if isinstance(choice, ConfiguredSampler) and not options:
        return choice
    registration, given, name = find_choice("sampler", choice, options)
    return ConfiguredSampler(registration, given, (randomizer(name),) if name else ())


def _are_texts(notes: object) -> bool:
    return isinstance(notes, (list, tuple)) and all(isinstance(note, str) for note in notes)


def _randomized(sampler: SamplerSpec, randomizer: RandomizerSpec) -> SamplerSpec:
    """Return the declaration of a sampler that is followed by a randomizer."""
    return replace(
        sampler,
        randomized=True,
        unbiased=randomizer.unbiased,
        period=None,
        screen_block=None,
        promises=tuple(promise for promise in sampler.promises if promise.keyword in randomizer.keeps),
        largest_index=min(sampler.largest_index, randomizer.largest_index),
    )
