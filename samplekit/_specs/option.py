"""Options: their type, range and text, the same on the command line and in Python."""

from __future__ import annotations

import math
import operator
import re
import unicodedata
from dataclasses import dataclass
from typing import TYPE_CHECKING, SupportsFloat, SupportsIndex

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping

NAME = re.compile(r"^[a-z][a-z0-9-]*\Z")

OptionValue = int | float | str | bool


def require(condition: bool, message: str) -> None:
    """Raise ValueError with the message unless the condition holds."""
    if not condition:
        raise ValueError(message)


def is_line(text: object) -> bool:
    """Whether it is text without line ends, tabs and other control characters."""
    return isinstance(text, str) and (text.isprintable() or not any(unicodedata.category(c) == "Cc" for c in text))


def is_number(value: object) -> bool:
    """Whether it is an int or a float, and not NaN."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value == value


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

    Examples
    --------
    >>> from samplekit import Option
    >>> Option("radius", 0.3, "of the disk", minimum=0.0).parse("0.25")
    0.25
    """

    name: str
    default: OptionValue
    summary: str = ""
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    required: bool = False

    def __post_init__(self) -> None:
        require(isinstance(self.name, str) and bool(NAME.match(self.name)), f"bad option name {self.name!r}")
        who = f"option {self.name}"
        require(type(self.default) in (int, float, str, bool), f"{who}: the default must be an int, float, str or bool")
        require(is_line(self.summary), f"{who}: the summary must be text of one line")
        for end in (self.minimum, self.maximum):
            require(end is None or is_number(end), f"{who}: bounds must be numbers or None")
        require(
            isinstance(self.choices, tuple) and all(isinstance(choice, str) for choice in self.choices),
            f"{who}: choices must be a tuple of text",
        )
        require(isinstance(self.required, bool), f"{who}: required must be True or False")
        if isinstance(self.default, float):
            require(math.isfinite(self.default), f"{who}: the default must be finite")
        if not self.required:
            try:
                self.parse(self.default)
            except UsageError as error:
                raise ValueError(f"the default of {error}") from None

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
    return str(value).removesuffix(".0") if isinstance(value, float) else str(value)


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
