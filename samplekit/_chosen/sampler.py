"""A sampler as a user chose it: name, options and randomizer, checked against what they declare."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._bases.realizations import Realizations, check_seed
from samplekit._bases.sampler import Sampler
from samplekit._errors import CountError, UsageError
from samplekit._guard import Guard
from samplekit._memory import check_memory
from samplekit._parsing import check_positive, parse_choice
from samplekit._registry import BUILTIN, Offer, registry
from samplekit._specs import written

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from samplekit._bases.randomizer import Randomizer
    from samplekit._specs import OptionValue, RandomizerSpec, SamplerSpec


class ConfiguredSampler:
    """What ``samplekit.sampler("sobol+owen")`` returns.

    Attributes
    ----------
    text
        As it would be written on the command line.
    spec
        The declaration of the whole: the sampler's, as the randomizer changes it.
    """

    def __init__(self, offer: Offer, options: Mapping[str, object], randomizer: Offer | None = None) -> None:
        spec: SamplerSpec = offer.spec
        values = spec.parse_options(options)
        self.plugin = offer.plugin
        self.text = written(offer.called, options, values) + (f"+{randomizer.called}" if randomizer else "")
        self._offers = offer, randomizer
        self._options = dict(options)
        self._sampler = _sampler(offer, values)
        spec = self._sampler.refine(spec)
        if randomizer:
            from samplekit._bases.randomizer import RandomizedSampler

            self._sampler = RandomizedSampler(self._sampler, _randomizer(randomizer), randomizer.spec.name)
            spec = _randomized(spec, randomizer.spec)
        self.spec = spec

    def __repr__(self) -> str:
        return f"<sampler {self.text}>"

    @property
    def streams(self) -> bool:
        """Whether a part of a set costs a part of the whole."""
        return self._sampler.streams

    def fresh(self) -> ConfiguredSampler:
        """This sampler with every realisation made afresh: itself, unless it reuses sets."""
        offer, randomizer = self._offers
        fresh_options = offer.spec.fresh_options
        if all(offer.spec.parse_options(self._options)[name] == value for name, value in fresh_options.items()):
            return self
        return ConfiguredSampler(offer, {**self._options, **fresh_options}, randomizer)

    def prepare(self, count: int, dims: int, progress: Callable[[int, int], None] = lambda _, __: None) -> None:
        """Make what all such sets share; see :meth:`Sampler.prepare`.

        Raises
        ------
        SamplekitError
            The plugin raised.
        """
        self._sampler.prepare(count, dims, progress)

    def notes(self, count: int, dims: int) -> list[str]:
        """What a user of these sets should know; see :meth:`Sampler.notes`."""
        return self._sampler.notes(count, dims)

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
        UsageError
            Says what it makes; a :class:`CountError` if the count is at fault, with the nearest counts.
        SamplekitError
            The plugin raised.
        """
        least, most = self.spec.dimensions
        # As Python's integers: NumPy's overflow.
        dims, count = check_positive("dims", dims), check_positive("count", count)
        if dims < least or (most is not None and dims > most):
            span = f"{least}" if most == least else f"at least {least}" if most is None else f"{least} to {most}"
            raise UsageError(f"{self.text} makes points in {span} dimension{'' if most == 1 else 's'}, not {dims}")
        if count - 1 > self.spec.largest_index:
            message = f"{self.text} makes at most {self.spec.largest_index + 1} points, not {count}"
            raise CountError(message, count, self.spec.counts.below(self.spec.largest_index + 2, dims), None)
        self.spec.counts.check(self.text, count, dims)
        self._sampler.check(count, dims, blocks)

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets, see :meth:`Sampler.fill`; a plugin's points are checked, and its faults named.

        Raises
        ------
        SamplekitError
            The plugin raised, or wrote values outside [0, 1), or left some unwritten.
        """
        self._sampler.fill(out, realizations, count, start)

    def points(
        self,
        count: int,
        dims: int = 2,
        *,
        realizations: int = 1,
        seed: int = 0,
        start: int = 0,
        stop: int | None = None,
    ) -> NDArray[np.float64]:
        """Points start to stop of sets of ``count`` points.

        Parameters
        ----------
        count, dims, realizations
            Size of a set, dimensions, number of sets: all at least 1.
        seed
            From 0 to 2^64 - 1.
        start, stop
            The slice of each set that is returned; by default all of it.

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
        stop = count if stop is None else stop
        whole = all(isinstance(edge, (int, np.integer)) and not isinstance(edge, bool) for edge in (start, stop))
        if not whole or not 0 <= start < stop <= count:
            raise UsageError(f"slice {start}:{stop}: expected integers with 0 <= start < stop <= {count}")
        count, dims, realizations = int(count), int(dims), check_positive("realizations", realizations)
        start, stop = int(start), int(stop)
        # A float64 as the sampler makes it, and another in the order that is returned.
        check_memory(2 * 8 * realizations * dims * (stop - start), "these points")
        self.prepare(count, dims)
        out = np.empty((realizations, dims, stop - start))
        self.fill(out, Realizations.of_trials(0, realizations, seed), count, start)
        return np.ascontiguousarray(out.transpose(0, 2, 1))


def configured_sampler(text: str, **options: object) -> ConfiguredSampler:
    """The sampler written ``NAME[:option=value,...][+RANDOMIZER]``; options may also be given by keyword.

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
    choice = parse_choice(text, "sampler")
    given: dict[str, object] = {**choice.options, **{name.replace("_", "-"): value for name, value in options.items()}}
    randomizer = registry().find("randomizer", choice.randomizer) if choice.randomizer else None
    return ConfiguredSampler(registry().find("sampler", choice.name), given, randomizer)


def _sampler(offer: Offer, values: Mapping[str, OptionValue]) -> Sampler:
    """The sampler of a declaration, under guard if it is a plugin's."""
    guard = Guard(f"sampler {offer.called}", offer.plugin)
    made: Sampler = _made(offer, values, guard, lambda made: isinstance(made, Sampler), "a Sampler")
    if offer.plugin.name == BUILTIN:
        return made
    from samplekit._chosen.guarded import GuardedSampler

    return GuardedSampler(made, guard)


def _randomizer(offer: Offer) -> Randomizer:
    guard = Guard(f"randomizer {offer.called}", offer.plugin)
    values = offer.spec.parse_options({})
    made: Randomizer = _made(offer, values, guard, lambda made: hasattr(made, "apply"), "something with apply")
    if offer.plugin.name == BUILTIN:
        return made
    from samplekit._chosen.guarded import GuardedRandomizer

    return GuardedRandomizer(made, guard)


def _made(
    offer: Offer, values: Mapping[str, OptionValue], guard: Guard, valid: Callable[[Any], bool], expected: str
) -> Any:
    implementation = offer.spec.load()
    keywords = {name.replace("-", "_"): value for name, value in values.items()}
    return guard("cannot be set up", lambda: implementation(**keywords), valid, expected)


def _randomized(sampler: SamplerSpec, randomizer: RandomizerSpec) -> SamplerSpec:
    return replace(
        sampler,
        randomized=True,
        unbiased=randomizer.unbiased,
        period=None,
        screen_block=None,
        promises=tuple(promise for promise in sampler.promises if promise.keyword in randomizer.keeps),
        largest_index=min(sampler.largest_index, randomizer.largest_index),
    )
