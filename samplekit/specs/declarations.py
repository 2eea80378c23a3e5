"""What a sampler, scene, randomizer or command says of itself before its code is imported."""

from __future__ import annotations

import importlib
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from samplekit.errors import SamplekitError, UsageError
from samplekit.specs.option import NAME, Option, OptionValue, require
from samplekit.specs.promise import Promise

if TYPE_CHECKING:
    from collections.abc import Mapping

API_VERSION = 1
TARGET = re.compile(r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*\Z")
COUNTS = re.compile(
    r"^(any|products|products-in-[1-9]\d*|squares|prime-squares|prime-cubes|fibonacci|(powers-of|exactly)-[1-9]\d*)\Z"
)
PROGRESSIVE = re.compile(r"^(no|every-count|powers-of-[1-9]\d*)\Z")


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
        require(isinstance(self.summary, str), f"{self.name}: the summary must be text")
        require(isinstance(self.options, tuple), f"{self.name}: options must be a tuple")
        for option in self.options:
            require(isinstance(option, Option), f"{self.name}: {option!r} is no Option")
        names = [option.name for option in self.options]
        require(len(set(names)) == len(names), f"{self.name}: an option is declared twice")
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
            return getattr(importlib.import_module(module), attribute)
        except (Exception, SystemExit) as error:
            raise SamplekitError(
                f"{self.name}: cannot import {self.target}: {type(error).__name__}: {error}"
            ) from error

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
    largest_index
        Largest index of a point.
    promises
        Properties that hold exactly, for every realisation.
    fresh_options
        Options under which every realisation is made afresh, for samplers that otherwise reuse sets: studies of
        expected spectra and variances set them.
    expected_failures
        Check name to reason, for what is known not to hold.
    """

    dimensions: tuple[int, int | None] = field(default=(1, None), kw_only=True)
    progressive: str = field(default="no", kw_only=True)
    counts: str = field(default="any", kw_only=True)
    randomized: bool = field(default=True, kw_only=True)
    unbiased: bool = field(default=True, kw_only=True)
    period: int | None = field(default=None, kw_only=True)
    largest_index: int = field(default=2**32 - 1, kw_only=True)
    promises: tuple[Promise, ...] = field(default=(), kw_only=True)
    fresh_options: Mapping[str, OptionValue] = field(default_factory=dict, kw_only=True)
    expected_failures: Mapping[str, str] = field(default_factory=dict, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        require(
            isinstance(self.dimensions, tuple) and len(self.dimensions) == 2,
            f"{self.name}: dimensions must be (least, most)",
        )
        least, most = self.dimensions
        require(
            isinstance(least, int) and least >= 1 and (most is None or (isinstance(most, int) and most >= least)),
            f"{self.name}: dimensions {self.dimensions} must be (least, most) with 1 <= least <= most, or most None",
        )
        require(
            isinstance(self.counts, str) and bool(COUNTS.match(self.counts)),
            f"{self.name}: unknown counts {self.counts!r}",
        )
        require(
            isinstance(self.progressive, str) and bool(PROGRESSIVE.match(self.progressive)),
            f"{self.name}: unknown progressive {self.progressive!r}",
        )
        require(self.period is None or self.period >= 1, f"{self.name}: period must be positive or None")
        require(0 <= self.largest_index < 2**64, f"{self.name}: largest_index must be from 0 to 2^64 - 1")
        for promise in self.promises:
            require(isinstance(promise, Promise), f"{self.name}: {promise!r} is no promise")


@dataclass(frozen=True)
class RandomizerSpec(_Spec):
    """What a randomizer declares.

    ``keeps`` names the kinds of promise that survive it: ``net``, ``latin``, ``grid``, ``orthogonal-array``,
    ``distance``; ``largest_index`` is that of a point whose digits it can still tell apart.
    """

    keeps: tuple[str, ...] = field(default=(), kw_only=True)
    largest_index: int = field(default=2**64 - 1, kw_only=True)
    unbiased: bool = field(default=True, kw_only=True)


PIXEL_FILTER = Option("pixel-filter", "box", "mean over the pixel, or its centre alone", choices=("box", "center"))


@dataclass(frozen=True)
class SceneSpec(_Spec):
    """What a scene declares: ``purposes`` are the blocks of dimensions that it may need, in their order.

    Every scene with pixel dimensions also takes the option ``pixel-filter``, which it never sees itself.
    """

    purposes: tuple[tuple[Literal["pixel", "lens", "time", "direction"], int], ...] = field(
        default=(("pixel", 2),), kw_only=True
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require(
            all(isinstance(number, int) and number >= 1 for _, number in self.purposes),
            f"{self.name}: purposes must be pairs of a name and a number of dimensions",
        )
        if any(purpose == "pixel" for purpose, _ in self.purposes) and PIXEL_FILTER not in self.options:
            object.__setattr__(self, "options", (*self.options, PIXEL_FILTER))
            super().__post_init__()


@dataclass(frozen=True)
class CommandSpec(_Spec):
    """What a command declares: ``target`` names a function that typer can turn into a command."""


Spec = SamplerSpec | RandomizerSpec | SceneSpec | CommandSpec
