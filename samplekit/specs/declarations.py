"""What a sampler, scene, randomizer or command says of itself before its code is imported."""

from __future__ import annotations

import contextlib
import importlib
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

from samplekit.errors import SamplekitError, UsageError
from samplekit.quoting import quoted, reason
from samplekit.specs.option import NAME, Option, OptionValue, is_line, require
from samplekit.specs.promise import Promise

API_VERSION = 1
TARGET = re.compile(r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*\Z")
COUNTS = re.compile(
    r"^(any|products|products-in-[1-9]\d*|squares|prime-squares|prime-cubes|fibonacci|(powers-of|exactly)-[1-9]\d*)\Z"
)
PROGRESSIVE = re.compile(r"^(no|every-count|powers-of-[1-9]\d*)\Z")


def _is_integer(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


@dataclass(frozen=True)
class _Spec:
    name: str
    target: str
    summary: str
    options: tuple[Option, ...] = field(default=(), kw_only=True)
    reference: str = field(default="", kw_only=True)
    api_version: int = field(default=API_VERSION, kw_only=True)

    def __post_init__(self) -> None:
        require(
            isinstance(self.name, str) and bool(NAME.match(self.name)), f"bad name {self.name!r}: want [a-z][a-z0-9-]*"
        )
        require(
            isinstance(self.target, str) and bool(TARGET.match(self.target)),
            f"{self.name}: bad target {self.target!r}: want 'package.module:Class'",
        )
        for word in ("summary", "reference"):
            require(is_line(getattr(self, word)), f"{self.name}: the {word} must be text of one line")
        require(isinstance(self.options, tuple), f"{self.name}: options must be a tuple")
        for option in self.options:
            require(isinstance(option, Option), f"{self.name}: {quoted(option)} is no Option")
        names = [option.name for option in self.options]
        require(len(set(names)) == len(names), f"{self.name}: an option is declared twice")
        require(_is_integer(self.api_version), f"{self.name}: api_version must be an integer")
        require(
            self.api_version <= API_VERSION,
            f"{self.name}: made for plugin interface {self.api_version}, this samplekit has {API_VERSION}:"
            " upgrade samplekit-core",
        )

    def load(self) -> Any:
        """Import the implementation and return it.

        Raises
        ------
        SamplekitError
            The target cannot be imported.
        """
        module, _, attribute = self.target.partition(":")
        try:
            # Results go to standard output: what a module prints while it is imported must not stand among them.
            with contextlib.redirect_stdout(sys.stderr):
                return getattr(importlib.import_module(module), attribute)
        except (Exception, SystemExit) as error:
            raise SamplekitError(f"{self.name}: cannot import {self.target}: {reason(error)}") from error

    @property
    def required_options(self) -> tuple[str, ...]:
        """Names of the options without which there is none of these: a file's path, say."""
        return tuple(option.name for option in self.options if option.required)

    def parse_options(self, given: Mapping[str, object]) -> dict[str, OptionValue]:
        """All options with their values: those given, parsed, and the defaults of the rest.

        Raises
        ------
        UsageError
            An unknown option, a required one that is missing, or a value that its option does not take.
        """
        known = {option.name: option for option in self.options}
        for name in given:
            if name not in known:
                takes = ", ".join(known) if known else "none"
                raise UsageError(f"{self.name} has no option {name!r}: it takes {takes}")
        for name, option in known.items():
            if option.required and name not in given:
                example = f"{self.name}:{name}={name.upper()}"
                raise UsageError(f"{self.name} needs the option {name} ({option.summary}): write {example}")
        try:
            return {
                name: option.parse(given[name]) if name in given else option.default for name, option in known.items()
            }
        except UsageError as error:
            raise UsageError(f"{self.name}: {error}") from None


@dataclass(frozen=True)
class SamplerSpec(_Spec):
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
            _is_integer(least) and least >= 1 and (most is None or (_is_integer(most) and most >= least)),
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
            self.period is None or (_is_integer(self.period) and self.period >= 1),
            f"{who}: period must be a positive integer or None",
        )
        require(
            self.screen_block is None or (_is_integer(self.screen_block) and self.screen_block >= 2),
            f"{who}: screen_block must be an integer from 2 on, or None",
        )
        require(
            _is_integer(self.largest_index) and 0 <= self.largest_index < 2**64,
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


@dataclass(frozen=True)
class RandomizerSpec(_Spec):
    """What a randomizer declares.

    ``keeps`` names the kinds of promise that survive it: ``net``, ``latin``, ``grid``, ``orthogonal-array``,
    ``distance``; ``largest_index`` is that of a point whose digits it can still tell apart.

    Examples
    --------
    >>> from samplekit import RandomizerSpec
    >>> RandomizerSpec("flip", "mine.flip:Flip", "mirror each dimension or not", keeps=("net", "latin")).keeps
    ('net', 'latin')
    """

    keeps: tuple[str, ...] = field(default=(), kw_only=True)
    largest_index: int = field(default=2**64 - 1, kw_only=True)
    unbiased: bool = field(default=True, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        kinds = {promise.keyword for promise in get_args(Promise)}
        require(
            isinstance(self.keeps, tuple) and all(isinstance(kind, str) and kind in kinds for kind in self.keeps),
            f"{self.name}: keeps must be a tuple of {', '.join(sorted(kinds))}",
        )
        require(
            _is_integer(self.largest_index) and 0 <= self.largest_index < 2**64,
            f"{self.name}: largest_index must be from 0 to 2^64 - 1",
        )
        require(isinstance(self.unbiased, bool), f"{self.name}: unbiased must be True or False")


PIXEL_FILTER = Option("pixel-filter", "box", "mean over the pixel, or its centre alone", choices=("box", "center"))


Purpose = Literal["pixel", "lens", "time", "direction", "further"]
PURPOSES: tuple[Purpose, ...] = get_args(Purpose)


def _is_purpose(pair: object) -> bool:
    """Whether it is a purpose and a number of dimensions."""
    return isinstance(pair, tuple) and len(pair) == 2 and pair[0] in PURPOSES and _is_integer(pair[1]) and pair[1] >= 1


@dataclass(frozen=True)
class SceneSpec(_Spec):
    """What a scene declares: ``purposes`` are the blocks of dimensions that it may need, in their order.

    ``further`` are dimensions that are none of pixel, lens, time and direction, such as the bounces of a path.
    ``extremes`` are options that take the scene from mild to stiff, one text each (``"sigma=1e-12"``): what
    ``samplekit stability`` sweeps.

    Every scene with pixel dimensions also takes the option ``pixel-filter``, which it never sees itself.

    Examples
    --------
    >>> from samplekit import Option, SceneSpec
    >>> spec = SceneSpec("lamp", "lamp.scene:Lamp", "light of a lamp", options=(Option("height", 0.3, "of the lamp"),))
    >>> dict(spec.purposes)
    {'pixel': 2}
    """

    purposes: tuple[tuple[Purpose, int], ...] = field(default=(("pixel", 2),), kw_only=True)
    extremes: tuple[str, ...] = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        require(
            isinstance(self.purposes, tuple) and all(map(_is_purpose, self.purposes)),
            f"{self.name}: purposes must be pairs of {', '.join(PURPOSES)} and a number of dimensions",
        )
        require(
            isinstance(self.extremes, tuple) and all(isinstance(text, str) and "=" in text for text in self.extremes),
            f"{self.name}: extremes must be a tuple of texts such as 'sigma=1e-12'",
        )
        if any(purpose == "pixel" for purpose, _ in self.purposes) and PIXEL_FILTER not in self.options:
            object.__setattr__(self, "options", (*self.options, PIXEL_FILTER))
            super().__post_init__()


@dataclass(frozen=True)
class CommandSpec(_Spec):
    """What a command declares: ``target`` names a function that typer can turn into a command.

    Examples
    --------
    >>> from samplekit import CommandSpec
    >>> CommandSpec("gaps", "mine.command:gaps", "Distances to the nearest neighbours.").name
    'gaps'
    """


Spec = SamplerSpec | RandomizerSpec | SceneSpec | CommandSpec
