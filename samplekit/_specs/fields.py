"""Checks of the fields of a declaration, with one form of message for all of them."""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING, Any

from samplekit._quoting import quoted

if TYPE_CHECKING:
    from collections.abc import Callable

    Predicate = Callable[[Any], bool]


NAME = "[a-z][a-z0-9-]*"
"""What names of samplers, scenes, randomizers, commands and options look like."""


def require_fields(declared: object, who: str, /, **fields: tuple[Predicate, str]) -> None:
    """Check fields of an object that was just made.

    Parameters
    ----------
    declared
        The object.
    who
        What the message begins with: the name of the sampler, say.
    fields
        For each field a predicate that its value must satisfy, and what that means in words.

    Raises
    ------
    ValueError
        Names the field, what it must be, and what it is.
    """
    for name, (is_right, expected) in fields.items():
        value = getattr(declared, name)
        if not is_right(value):
            raise ValueError(f"{who}: {name} must be {expected}, not {quoted(value)}")


def matching(pattern: str) -> Predicate:
    """Make the predicate of texts that match a regular expression from end to end."""
    return lambda value: isinstance(value, str) and re.fullmatch(pattern, value) is not None


def is_line(value: object) -> bool:
    """Tell whether it is text without line ends, tabs and other control characters."""
    return isinstance(value, str) and (value.isprintable() or not any(unicodedata.category(c) == "Cc" for c in value))


def is_number(value: object) -> bool:
    """Tell whether it is an int or a float, and not NaN."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value == value


def integer(least: int, most: int | None = None) -> Predicate:
    """Make the predicate of integers from ``least`` to ``most`` (None: without end)."""

    def is_right(value: object) -> bool:
        is_integer = isinstance(value, int) and not isinstance(value, bool)
        return is_integer and least <= value and (most is None or value <= most)  # type: ignore[operator]

    return is_right


def optional(is_right: Predicate) -> Predicate:
    """Make the predicate that also allows None."""
    return lambda value: value is None or is_right(value)


def tuple_of(is_right: Predicate) -> Predicate:
    """Make the predicate of tuples whose items all satisfy ``is_right``."""
    return lambda value: isinstance(value, tuple) and all(map(is_right, value))


def instance_of(kind: type) -> Predicate:
    """Make the predicate of instances of a class."""
    return lambda value: isinstance(value, kind)


def are_dimensions(value: object) -> bool:
    """Tell whether it is a tuple of different dimensions, counted from 0; not an empty one."""
    return isinstance(value, tuple) and tuple_of(integer(0))(value) and len({*value}) == len(value) > 0
