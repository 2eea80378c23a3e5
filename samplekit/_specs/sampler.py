"""What a sampler says of itself before its code is imported."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from samplekit._errors import UsageError
from samplekit._quoting import quoted
from samplekit._specs.declaration import Declaration, is_integer
from samplekit._specs.option import OptionValue, is_line, require
from samplekit._specs.promise import Promise

COUNTS = re.compile(
    r"^(any|products|products-in-[1-9]\d*|squares|prime-squares|prime-cubes|fibonacci|(powers-of|exactly)-[1-9]\d*)\Z"
)
PROGRESSIVE = re.compile(r"^(no|every-count|powers-of-[1-9]\d*)\Z")


@dataclass(frozen=True)
class SamplerSpec(Declaration):
    """What a sampler declares.

    Parameters
    ----------
    name, target, summary, options, reference, api_version
        Name on the command line, ``"package.module:Class"``, one line, options, paper, plugin interface.
    dimensions
        Least and most; most None: any number.
    progressive
        ``"no"``; ``"every-count"`` or ``"powers-of-B"``: points(M)[:N] == points(N), and prefixes of those lengths are
        good sets.
    counts
        ``"any"``, ``"products"`` (a grid of near-equal sides over all dimensions), ``"products-in-2"`` (over pairs),
        ``"squares"``, ``"prime-squares"``, ``"prime-cubes"``, ``"powers-of-B"``, ``"fibonacci"``, ``"exactly-N"``.
    randomized
        Another seed, and another realisation, gives other points.
    unbiased
        The mean of its estimates over realisations is the integral.
    period
        Pixels after which its sets repeat; None: never.
    screen_block
        Side B of the aligned squares of B x B pixels that share one sequence, so that their errors cancel when they are
        seen together: the sets of such a block are different parts of the sequence, all of them together keep every
        promise that is made of one, and other blocks have other sequences. None: pixels know nothing of each other.
    largest_index
        Largest index of a point.
    promises
        Properties that hold exactly, for every realisation.
    fresh_options
        Options under which every realisation is made afresh, for samplers that otherwise reuse sets: studies of
        expected spectra and variances set them.
    expected_failures
        Check name to reason, for what is known not to hold.

    Examples
    --------
    >>> from samplekit import LatinStrata, SamplerSpec
    >>> spec = SamplerSpec("mine", "mine.points:Mine", "my own points", dimensions=(2, 2), promises=(LatinStrata(),))
    >>> spec.progressive, spec.counts
    ('no', 'any')
    """

    dimensions: tuple[int, int | None] = field(default=(1, None), kw_only=True)
    progressive: str = field(default="no", kw_only=True)
    counts: str = field(default="any", kw_only=True)
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
        who = self.name
        require(
            isinstance(self.dimensions, tuple) and len(self.dimensions) == 2,
            f"{who}: dimensions must be (least, most)",
        )
        least, most = self.dimensions
        require(
            is_integer(least) and least >= 1 and (most is None or (is_integer(most) and most >= least)),
            f"{who}: dimensions {self.dimensions} must be (least, most) with 1 <= least <= most, or most None",
        )
        require(
            isinstance(self.counts, str) and bool(COUNTS.match(self.counts)),
            f"{who}: unknown counts {quoted(self.counts)}",
        )
        require(
            isinstance(self.progressive, str) and bool(PROGRESSIVE.match(self.progressive)),
            f"{who}: unknown progressive {quoted(self.progressive)}",
        )
        for word in ("randomized", "unbiased"):
            require(isinstance(getattr(self, word), bool), f"{who}: {word} must be True or False")
        require(
            self.period is None or (is_integer(self.period) and self.period >= 1),
            f"{who}: period must be a positive integer or None",
        )
        require(
            self.screen_block is None or (is_integer(self.screen_block) and self.screen_block >= 2),
            f"{who}: screen_block must be an integer from 2 on, or None",
        )
        require(
            is_integer(self.largest_index) and 0 <= self.largest_index < 2**64,
            f"{who}: largest_index must be from 0 to 2^64 - 1",
        )
        require(isinstance(self.promises, tuple), f"{who}: promises must be a tuple")
        for promise in self.promises:
            require(isinstance(promise, Promise), f"{who}: {quoted(promise)} is no promise")
        self._require_mappings()

    def _require_mappings(self) -> None:
        for word in ("fresh_options", "expected_failures"):
            given = getattr(self, word)
            require(isinstance(given, Mapping), f"{self.name}: {word} must be a mapping")
            # A copy of our own: plain data, which nobody else changes.
            object.__setattr__(self, word, dict(given))
        require(
            all(isinstance(check, str) and is_line(why) for check, why in self.expected_failures.items()),
            f"{self.name}: expected_failures must be names of checks and reasons, text of one line each",
        )
        options = {option.name: option for option in self.options}
        for name, value in self.fresh_options.items():
            require(name in options, f"{self.name}: fresh_options names {quoted(name)}, which is no option of it")
            try:
                options[name].parse(value)
            except UsageError as error:
                raise ValueError(f"{self.name}: fresh_options: {error}") from None
