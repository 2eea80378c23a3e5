"""Options: their type, range and text, the same on the command line and in Python."""

from __future__ import annotations

import math
import operator
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, SupportsFloat, SupportsIndex

from samplekit._errors import UsageError
from samplekit._specs.fields import NAME, instance_of, is_line, is_number, matching, optional, require_fields, tuple_of

if TYPE_CHECKING:
    from collections.abc import Mapping

OptionValue = int | float | str | bool


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
        One line for help: what the option means.
    minimum, maximum
        Inclusive range of a number. ``maximum=math.inf`` allows infinity; NaN is never allowed.
    choices
        The words that a text option takes. Empty: any text.
    required
        Whether the option must be given. ``default`` then only states its type.

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
        bound = optional(is_number), "a number or None"
        require_fields(
            self,
            f"option {self.name}",
            name=(matching(NAME), f"of the form {NAME}"),
            default=(_is_default, "a finite int or float, a str or a bool"),
            summary=(is_line, "text of one line"),
            minimum=bound,
            maximum=bound,
            choices=(tuple_of(instance_of(str)), "a tuple of text"),
            required=(instance_of(bool), "True or False"),
        )
        if not self.required:
            try:
                self.parse(self.default)
            except UsageError as error:
                raise ValueError(f"the default of {error}") from None

    def parse(self, value: object) -> OptionValue:
        """Convert text or a Python value to this option's type.

        Raises
        ------
        UsageError
            Wrong type, NaN, or outside the range or the choices.
        """
        try:
            parsed = _convert(type(self.default), value)
            fits = self._fits(parsed)
        except (TypeError, ValueError, OverflowError):
            fits = False
        if not fits:
            raise UsageError(f"option {self.name}={value}: expected {self._expected()}")
        return parsed

    def _fits(self, value: OptionValue) -> bool:
        if self.choices:
            return value in self.choices
        if isinstance(value, (bool, str)):
            return True
        if math.isnan(value) or (math.isinf(value) and self.maximum != math.inf):
            return False
        return (self.minimum is None or value >= self.minimum) and (self.maximum is None or value <= self.maximum)

    def _expected(self) -> str:
        if self.choices:
            return " or ".join(self.choices)
        kind = type(self.default)
        expected = {bool: "true or false", int: "an integer", float: "a number", str: "text"}[kind]
        limits = self._limits()
        return f"{expected} {limits}" if limits else f"{expected}, finite" if kind is float else expected

    def _limits(self) -> str:
        """State the range of a number: ``"from 0 on"``, ``"from 1 to 9"``; empty if there is none."""
        if self.minimum is None:
            return "" if self.maximum is None else f"up to {self.maximum:g}"
        return f"from {self.minimum:g} on" if self.maximum is None else f"from {self.minimum:g} to {self.maximum:g}"

    def describe(self) -> str:
        """Say what the option means and takes: ``"of the disk; from 0 on"``."""
        takes = " or ".join(self.choices) or self._limits()
        return "; ".join(part for part in (self.summary, takes) if part) + (" (required)" if self.required else "")


def written(name: str, given: Mapping[str, object], values: Mapping[str, OptionValue]) -> str:
    """Write ``NAME:option=value,...`` as on the command line: the options in ``given``, each as short as can be."""
    chosen = ",".join(f"{option}={_shortest(value)}" for option, value in values.items() if option in given)
    return f"{name}:{chosen}" if chosen else name


def _shortest(value: OptionValue) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return str(value).removesuffix(".0") if isinstance(value, float) else str(value)


def _is_default(value: object) -> bool:
    return type(value) in (int, str, bool) or (type(value) is float and math.isfinite(value))


def _convert(kind: type, value: object) -> OptionValue:
    """Return the value as an instance of ``kind``; raise ValueError where that would change it."""
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
