"""Values from the text of the command line: counts, lists and ranges of counts, numbers, seeds, sizes, crops."""

from __future__ import annotations

import math
import re

from samplekit._arguments import LARGEST_SEED, check_crop
from samplekit._errors import UsageError

_MOST_COUNTS = 1000


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
