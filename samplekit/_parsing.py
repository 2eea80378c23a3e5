"""The command line's small languages: ``NAME[:option=value,...][+RANDOMIZER]``, counts, sizes and lists."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import SupportsIndex

from samplekit._errors import UsageError
from samplekit._quoting import quoted

LARGEST_SEED = 2**64 - 1
LARGEST_SIDE = 2**31
"""Of an image, in pixels."""
_MOST_COUNTS = 1000


@dataclass(frozen=True)
class Choice:
    """A name with the options that were given, as text, and the name behind a plus sign."""

    name: str
    options: dict[str, str] = field(default_factory=dict)
    randomizer: str | None = None


def parse_choice(text: str, kind: str) -> Choice:
    """Read ``NAME[:option=value,...][+RANDOMIZER]``; only a sampler takes a randomizer.

    Raises
    ------
    UsageError
        The text does not have this form.
    """
    chosen, *randomizers = re.split(r"\+(?=[A-Za-z])", text) if kind == "sampler" else [text]
    if any("." in randomizer.rpartition("/")[2] for randomizer in randomizers):
        raise UsageError(f"{kind} {text!r}: a plus sign before a letter ends a value: expected +RANDOMIZER behind it")
    if len(randomizers) > 1:
        raise UsageError(f"{kind} {text!r}: one randomizer at most")
    name, colon, rest = chosen.partition(":")
    options: dict[str, str] = {}
    for item in rest.split(",") if colon else []:
        option, equals, value = item.partition("=")
        if not equals or not option.strip() or not value.strip():
            hint = ": a comma ends a value" if options else ""
            raise UsageError(f"{kind} {text!r}: expected NAME:option=value,... but found {item!r}{hint}")
        if option.strip() in options:
            raise UsageError(f"{kind} {text!r}: option {option.strip()!r} is given twice")
        options[option.strip()] = value.strip()
    for chosen_name in (name, *randomizers):
        if not re.fullmatch(r"([A-Za-z0-9_.-]+/)?[A-Za-z0-9_.-]+", chosen_name):
            raise UsageError(f"{kind} {text!r}: expected NAME or NAME:option=value,...")
    return Choice(name, options, randomizers[0] if randomizers else None)


def parse_count(text: str, what: str) -> int:
    """Read a positive integer, plain or as a power: ``4096`` or ``2^12``.

    Raises
    ------
    UsageError
        Not a positive integer, or more than 2^63.
    """
    match = re.fullmatch(r"(\d{1,20})(?:\^(\d{1,3}))?", text.strip(), re.ASCII)
    value = 0 if match is None else int(match[1]) ** int(match[2] or 1)
    if not 1 <= value <= 2**63:
        raise UsageError(f"{what} {text}: expected a positive integer such as 16 or 2^4")
    return value


def parse_counts(text: str, what: str) -> list[int]:
    """Read a list of positive integers: ``1,4,16``, a range of powers ``2^0..2^12`` or ``4^1..4^5``, or both mixed.

    Parameters
    ----------
    text, what
        What is read, and its name in an error.

    Returns
    -------
    The integers, rising; each once.

    Raises
    ------
    UsageError
        Not of this form, a range that does not rise or is not of powers of one base, or more than 1000 integers.
    """
    counts: set[int] = set()
    for item in text.split(","):
        first, dots, last = item.strip().partition("..")
        if not dots:
            counts.add(parse_count(first, what))
            continue
        ends = [re.fullmatch(r"(\d{1,18})\^(\d{1,3})", end.strip(), re.ASCII) for end in (first, last)]
        if ends[0] is None or ends[1] is None or int(ends[0][1]) != int(ends[1][1]) or int(ends[0][1]) < 2:
            raise UsageError(f"{what} {item.strip()}: expected a range of powers of one base, such as 2^0..2^12")
        base, start, stop = int(ends[0][1]), int(ends[0][2]), int(ends[1][2])
        if start > stop:
            raise UsageError(f"{what} {item.strip()}: the range falls: expected {base}^{stop}..{base}^{start}")
        parse_count(last, what)
        counts.update(base**exponent for exponent in range(start, stop + 1))
    if len(counts) > _MOST_COUNTS:
        raise UsageError(f"{what}: {len(counts)} of them, at most {_MOST_COUNTS}")
    return sorted(counts)


def parse_range(text: str, what: str) -> tuple[int, int]:
    """Read ``FIRST..LAST``, two positive integers that do not fall.

    Raises
    ------
    UsageError
        Not of this form.
    """
    first, dots, last = text.partition("..")
    ends = (parse_count(first, what), parse_count(last, what)) if dots and last else (0, 0)
    if not 1 <= ends[0] <= ends[1]:
        raise UsageError(f"{what} {text}: expected FIRST..LAST, such as 256..4096")
    return ends


def parse_number(text: str, what: str, expected: str) -> float:
    """Read a finite number.

    Raises
    ------
    UsageError
        It is none; ``expected`` says what would be right.
    """
    match = re.fullmatch(
        r"[+-]?(\d{1,30}(\.\d{0,30})?|\.\d{1,30})(e[+-]?\d{1,3})?", text.strip(), re.ASCII | re.IGNORECASE
    )
    value = float(text) if match else math.nan
    if not math.isfinite(value):
        raise UsageError(f"{what} {text}: expected {expected}")
    return value


def check_positive(what: str, value: object) -> int:
    """The value as an int.

    Raises
    ------
    UsageError
        It is not an integer of at least 1.
    """
    if isinstance(value, bool) or not isinstance(value, SupportsIndex) or operator.index(value) < 1:
        raise UsageError(f"{what} {value}: expected a positive integer")
    return operator.index(value)


def parse_seed(text: str) -> int:
    """Read a seed.

    Raises
    ------
    UsageError
        Not an integer from 0 to 2^64 - 1.
    """
    if not re.fullmatch(r"\d{1,20}", text.strip(), re.ASCII) or int(text) > LARGEST_SEED:
        raise UsageError(f"seed {text}: expected an integer from 0 to {LARGEST_SEED}")
    return int(text)


def parse_size(text: str) -> tuple[int, int]:
    """Read ``W`` or ``WxH`` as (width, height).

    Raises
    ------
    UsageError
        Not of this form, or zero.
    """
    match = re.fullmatch(r"(\d{1,9})(?:x(\d{1,9}))?", text.strip(), re.ASCII)
    width, height = (0, 0) if match is None else (int(match[1]), int(match[2] or match[1]))
    if width < 1 or height < 1:
        raise UsageError(f"size {text}: expected W or WxH with both at least 1, such as 512 or 640x480")
    return width, height


def parse_crop(text: str, size: tuple[int, int]) -> tuple[int, int, int, int]:
    """Read ``X,Y,W,H``, a rectangle inside an image of ``size``.

    Raises
    ------
    UsageError
        Not of this form, empty, or not inside.
    """
    match = re.fullmatch(r"(\d{1,9}),(\d{1,9}),(\d{1,9}),(\d{1,9})", text.strip(), re.ASCII)
    if match is None:
        raise UsageError(f"crop {text}: expected X,Y,W,H in pixels, such as 10,20,64,64")
    x, y, w, h = (int(group) for group in match.groups())
    return check_crop((x, y, w, h), size)


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height, as Python's integers.

    Raises
    ------
    UsageError
        They are not two integers from 1 to 2^31.
    """
    sides = _integers(size, 2)
    if sides is None or not all(1 <= side <= LARGEST_SIDE for side in sides):
        raise UsageError(f"size {_shown(size)}: expected width and height from 1 to {LARGEST_SIDE}")
    return sides[0], sides[1]


def _integers(values: object, number: int) -> tuple[int, ...] | None:
    """So many integers, or None if they are not."""
    if not isinstance(values, Iterable) or isinstance(values, (str, bytes)):
        return None
    listed = tuple(values)
    if len(listed) != number or any(isinstance(v, bool) or not isinstance(v, SupportsIndex) for v in listed):
        return None
    try:
        return tuple(operator.index(value) for value in listed)
    except TypeError:
        return None


def _shown(values: object) -> str:
    return "x".join(map(str, values)) if isinstance(values, (tuple, list)) else quoted(values)


def check_crop(crop: tuple[int, int, int, int], size: tuple[int, int]) -> tuple[int, int, int, int]:
    """The crop as Python's integers, if it is a rectangle inside the image.

    Raises
    ------
    UsageError
        It is empty or not inside, or not four integers.
    """
    numbers = _integers(crop, 4)
    if numbers is None:
        raise UsageError(
            f"crop {quoted(crop)}: expected (x, y, width, height) inside the image of {size[0]}x{size[1]} pixels"
        )
    x, y, w, h = numbers
    if min(x, y) < 0 or min(w, h) < 1 or x + w > size[0] or y + h > size[1]:
        raise UsageError(
            f"crop {x},{y},{w},{h}: expected a rectangle X,Y,W,H inside the image of {size[0]}x{size[1]} pixels"
        )
    return x, y, w, h
