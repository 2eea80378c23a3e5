"""The declaration of a sampler, read before its code is imported."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeVar

from samplekit._errors import UsageError
from samplekit._quoting import quoted
from samplekit._specs.counts import AnyCount, Counts
from samplekit._specs.declaration import Declaration
from samplekit._specs.fields import instance_of, integer, is_line, optional, require_fields, tuple_of
from samplekit._specs.promise import Promise

if TYPE_CHECKING:
    from samplekit._specs.option import OptionValue

Kind = TypeVar("Kind", bound=Promise)


@dataclass(frozen=True)
class SamplerSpec(Declaration):
    """The declaration of a sampler; its first fields are those of :class:`Declaration`.

    Parameters
    ----------
    dimensions
        Least and most number of dimensions; most None: any number.
    counts
        Which numbers of points it makes.
    progressive
        The lengths at which a prefix of a set is a set of its own, points(M)[:N] == points(N), and a good one:
        ``AnyCount()`` or ``PowersOf(2)``, say. None: another number of points is another set. The number of dimensions
        is the same on both sides.
    extensible_dims
        Whether the first dimensions of a set stay the same, bit for bit, when more dimensions are asked for. False:
        another number of dimensions is another set.
    randomized
        Whether another seed, and another realisation, gives other points.
    unbiased
        Whether the mean of its estimates over realisations is the integral.
    period
        Number of pixels after which sets repeat; None: never.
    screen_block
        Side B of the aligned squares of B x B pixels that share one sequence, so that their errors cancel when they are
        seen together: the sets of such a block are different parts of the sequence, all of them together keep every
        promise that is made of one, and other blocks have other sequences. Trials take one pixel of each block. None:
        pixels are independent.
    largest_index
        Largest index of a point.
    promises
        Properties that hold exactly, for every realisation.
    fresh_options
        Options under which every realisation is made afresh, for samplers that otherwise reuse sets: studies of
        expected spectra and variances set them.
    expected_failures
        Names of checks that are known to fail, and the reason for each.

    Examples
    --------
    >>> from samplekit import AnyCount, LatinStrata, SamplerSpec
    >>> spec = SamplerSpec("mine", "mine.points:Mine", "my own points", dimensions=(2, 2), promises=(LatinStrata(),))
    >>> spec.counts.allows(97, dims=2), spec.progressive
    (True, None)
    """

    dimensions: tuple[int, int | None] = field(default=(1, None), kw_only=True)
    progressive: Counts | None = field(default=None, kw_only=True)
    extensible_dims: bool = field(default=True, kw_only=True)
    counts: Counts = field(default=AnyCount(), kw_only=True)
    randomized: bool = field(default=True, kw_only=True)
    unbiased: bool = field(default=True, kw_only=True)
    period: int | None = field(default=None, kw_only=True)
    screen_block: int | None = field(default=None, kw_only=True)
    largest_index: int = field(default=2**32 - 1, kw_only=True)
    promises: tuple[Promise, ...] = field(default=(), kw_only=True)
    fresh_options: Mapping[str, OptionValue] = field(default_factory=dict, kw_only=True)
    expected_failures: Mapping[str, str] = field(default_factory=dict, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        require_fields(
            self,
            self.name,
            dimensions=(_are_bounds, "(least, most) with 1 <= least <= most, or most None"),
            counts=(instance_of(Counts), "an object such as AnyCount() or PowersOf(2)"),
            progressive=(optional(instance_of(Counts)), "None or an object such as AnyCount() or PowersOf(2)"),
            extensible_dims=(instance_of(bool), "True or False"),
            randomized=(instance_of(bool), "True or False"),
            unbiased=(instance_of(bool), "True or False"),
            period=(optional(integer(1)), "a positive integer or None"),
            screen_block=(optional(integer(2)), "an integer from 2 on, or None"),
            largest_index=(integer(0, 2**64 - 1), "an integer from 0 to 2^64 - 1"),
            promises=(tuple_of(instance_of(Promise)), "a tuple of promises such as LatinStrata()"),
            fresh_options=(instance_of(Mapping), "a mapping from options to values"),
            expected_failures=(_are_reasons, "a mapping from names of checks to reasons of one line each"),
        )
        for name in ("fresh_options", "expected_failures"):
            # A copy of our own: plain data, which nobody else changes.
            object.__setattr__(self, name, dict(getattr(self, name)))
        options = {option.name: option for option in self.options}
        for name, value in self.fresh_options.items():
            if name not in options:
                raise ValueError(f"{self.name}: fresh_options names {quoted(name)}, which is no option of it")
            try:
                options[name].parse(value)
            except UsageError as error:
                raise ValueError(f"{self.name}: fresh_options: {error}") from None

    def promised(self, kind: type[Kind]) -> list[Kind]:
        """Return the promises of one kind: ``spec.promised(Net)``."""
        return [promise for promise in self.promises if isinstance(promise, kind)]


def _are_bounds(value: object) -> bool:
    if not (isinstance(value, tuple) and len(value) == 2 and integer(1)(value[0])):
        return False
    least, most = value
    return most is None or integer(least)(most)


def _are_reasons(value: object) -> bool:
    return isinstance(value, Mapping) and all(
        isinstance(check, str) and is_line(reason) for check, reason in value.items()
    )
