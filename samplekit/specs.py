"""Declarations: what a sampler, scene, randomizer or command says of itself before its code is imported.

Plain data, no NumPy: listing, completing and checking a request never imports an implementation.
"""

from __future__ import annotations

import importlib
import math
import operator
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, SupportsFloat, SupportsIndex

from samplekit.errors import SamplekitError, UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping

API_VERSION = 1
NAME = re.compile(r"^[a-z][a-z0-9-]*$")
TARGET = re.compile(r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*$")
COUNTS = re.compile(
    r"^(any|products|products-in-[1-9]\d*|squares|prime-squares|prime-cubes|fibonacci|(powers-of|exactly)-[1-9]\d*)$"
)
PROGRESSIVE = re.compile(r"^(no|every-count|powers-of-[1-9]\d*)$")

OptionValue = int | float | str | bool


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise ValueError(message)


@dataclass(frozen=True)
class Option:
    """One option of a sampler, scene or randomizer.

    Parameters
    ----------
    name
        As written on the command line: ``[a-z][a-z0-9-]*``.
    default
        Its type is the option's type: int, float, str or bool.
    summary
        One line for help.
    minimum, maximum
        Inclusive range of a number. ``maximum=math.inf`` lets infinity in; nothing lets NaN in.
    choices
        The words that a string option takes; empty for free text.
    required
        It must be given: ``default`` tells its type alone.
    """

    name: str
    default: OptionValue
    summary: str = ""
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    required: bool = False

    def __post_init__(self) -> None:
        _require(isinstance(self.name, str) and bool(NAME.match(self.name)), f"bad option name {self.name!r}")
        _require(isinstance(self.default, (int, float, str)), f"option {self.name}: default must be int, float, str")

    def parse(self, value: object) -> OptionValue:
        """Turn text or a Python value into this option's type, or say what would be right.

        Raises
        ------
        UsageError
            Wrong type, NaN, or outside the range or the choices.
        """
        kind = type(self.default)
        expected = {bool: "true or false", int: "an integer", float: "a number", str: "text"}[kind]
        if self.choices:
            expected = " or ".join(self.choices)
        try:
            parsed = _convert(kind, value)
        except (TypeError, ValueError, OverflowError):
            raise UsageError(f"option {self.name}={value}: expected {expected}{self._range()}") from None
        if self.choices and parsed not in self.choices:
            raise UsageError(f"option {self.name}={value}: expected {expected}")
        if isinstance(parsed, (int, float)) and not isinstance(parsed, bool) and not self._inside(parsed):
            raise UsageError(f"option {self.name}={value}: expected {expected}{self._range()}")
        return parsed

    def _inside(self, value: float) -> bool:
        if math.isnan(value) or (math.isinf(value) and self.maximum != math.inf):
            return False
        return (self.minimum is None or value >= self.minimum) and (self.maximum is None or value <= self.maximum)

    def _range(self) -> str:
        if self.choices or (self.minimum is None and self.maximum is None):
            return ", finite" if isinstance(self.default, float) and not self.choices else ""
        low = "" if self.minimum is None else f" of at least {self.minimum:g}"
        high = "" if self.maximum is None else f" of at most {self.maximum:g}"
        return (low and high and f" from {self.minimum:g} to {self.maximum:g}") or low or high


def written(name: str, given: Mapping[str, object], values: Mapping[str, OptionValue]) -> str:
    """``NAME:option=value,...`` as on the command line, with the options that were given, each as its shortest text."""
    chosen = ",".join(f"{option}={_shortest(value)}" for option, value in values.items() if option in given)
    return f"{name}:{chosen}" if chosen else name


def _shortest(value: OptionValue) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return str(value).removesuffix(".0")


def _convert(kind: type, value: object) -> OptionValue:
    """The value as an instance of ``kind``; ValueError where that would change it."""
    if kind is str and isinstance(value, str):
        return value
    if kind is bool and (isinstance(value, bool) or value in ("true", "false")):
        return value in (True, "true")
    if kind is int and isinstance(value, str) and re.fullmatch(r"[+-]?\d{1,20}", value, re.ASCII):
        return int(value)
    if kind is int and isinstance(value, SupportsIndex) and not isinstance(value, bool):
        return operator.index(value)
    if (
        kind is float
        and isinstance(value, (str, SupportsFloat))
        and not isinstance(value, bool)
        and "_" not in str(value)
    ):
        return float(value)
    raise ValueError(value)


@dataclass(frozen=True)
class Net:
    """Promise: the projection on ``dims`` is a (t, m, s)-net in ``base`` for every power of the base.

    ``sequence``: every later block of a power of the base is a net as well ((t, s)-sequence).
    """

    dims: tuple[int, ...] = (0, 1)
    base: int = 2
    t: int = 0
    sequence: bool = True
    keyword = "net"


@dataclass(frozen=True)
class LatinStrata:
    """Promise: in each of ``dims`` (None: in all) every interval [i/N, (i+1)/N) holds exactly one of the N points."""

    dims: tuple[int, ...] | None = None
    keyword = "latin"


@dataclass(frozen=True)
class GridStrata:
    """Promise: each cell of the grid that the count factorises into holds exactly one point.

    ``block``: number of dimensions that one grid spans; None: all of them.
    """

    block: int | None = None
    keyword = "grid"


@dataclass(frozen=True)
class OrthogonalArray:
    """Promise: every ``strength`` dimensions project onto one point in each cell of their grid."""

    strength: int = 2
    keyword = "orthogonal-array"


@dataclass(frozen=True)
class MinimumDistance:
    """Promise: no two points are closer than ``fraction`` of the densest packing's distance on the torus."""

    fraction: float
    keyword = "distance"


Promise = Net | LatinStrata | GridStrata | OrthogonalArray | MinimumDistance


@dataclass(frozen=True)
class _Spec:
    name: str
    target: str
    summary: str
    options: tuple[Option, ...] = field(default=(), kw_only=True)
    reference: str = field(default="", kw_only=True)
    api_version: int = field(default=API_VERSION, kw_only=True)

    def __post_init__(self) -> None:
        _require(
            isinstance(self.name, str) and bool(NAME.match(self.name)), f"bad name {self.name!r}: want [a-z][a-z0-9-]*"
        )
        _require(
            isinstance(self.target, str) and bool(TARGET.match(self.target)),
            f"{self.name}: bad target {self.target!r}: want 'package.module:Class'",
        )
        _require(isinstance(self.summary, str), f"{self.name}: the summary must be text")
        _require(isinstance(self.options, tuple), f"{self.name}: options must be a tuple")
        for option in self.options:
            _require(isinstance(option, Option), f"{self.name}: {option!r} is no Option")
        names = [option.name for option in self.options]
        _require(len(set(names)) == len(names), f"{self.name}: an option is declared twice")
        _require(
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
        _require(
            isinstance(self.dimensions, tuple) and len(self.dimensions) == 2,
            f"{self.name}: dimensions must be (least, most)",
        )
        least, most = self.dimensions
        _require(
            isinstance(least, int) and least >= 1 and (most is None or (isinstance(most, int) and most >= least)),
            f"{self.name}: dimensions {self.dimensions} must be (least, most) with 1 <= least <= most, or most None",
        )
        _require(
            isinstance(self.counts, str) and bool(COUNTS.match(self.counts)),
            f"{self.name}: unknown counts {self.counts!r}",
        )
        _require(
            isinstance(self.progressive, str) and bool(PROGRESSIVE.match(self.progressive)),
            f"{self.name}: unknown progressive {self.progressive!r}",
        )
        _require(self.period is None or self.period >= 1, f"{self.name}: period must be positive or None")
        _require(0 <= self.largest_index < 2**64, f"{self.name}: largest_index must be from 0 to 2^64 - 1")
        for promise in self.promises:
            _require(isinstance(promise, Promise), f"{self.name}: {promise!r} is no promise")


@dataclass(frozen=True)
class RandomizerSpec(_Spec):
    """What a randomizer declares.

    ``keeps`` names the kinds of promise that survive it: ``net``, ``latin``, ``grid``, ``orthogonal-array``,
    ``distance``.
    """

    keeps: tuple[str, ...] = field(default=(), kw_only=True)
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
        _require(
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
