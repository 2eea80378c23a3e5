"""Checks of the numbers in a request: what is not allowed ends in one clear line."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import SupportsIndex

from samplekit._errors import UsageError
from samplekit._quoting import quoted

LARGEST_SEED = 2**64 - 1
LARGEST_SIDE = 2**31
"""Largest width and height of an image, in pixels."""
MOST_SAMPLES = 2**48
"""Samples of one image: weeks of work; a larger request is a slip of the keyboard."""


def as_integer(value: object) -> int | None:
    """Return an integer of Python or NumPy as an int; None for everything else, True and False included."""
    if isinstance(value, bool) or not isinstance(value, SupportsIndex):
        return None
    try:
        return operator.index(value)
    except TypeError:
        # Arrays of NumPy have the method, and most of them refuse.
        return None


def check_positive(what: str, value: object) -> int:
    """Return the value as an int.

    Raises
    ------
    UsageError
        It is not an integer of at least 1.
    """
    integer = as_integer(value)
    if integer is None or integer < 1:
        raise UsageError(f"{what} {value}: expected a positive integer")
    return integer


def check_samples(pixels: int, count: int, where: str) -> None:
    """Raise unless so many samples can be drawn in one image.

    Raises
    ------
    UsageError
        There are more than 2^48 samples.
    """
    if pixels * count > MOST_SAMPLES:
        raise UsageError(
            f"{pixels} pixels x {count} samples = {pixels * count:.3g}: at most {MOST_SAMPLES:.3g} in {where}"
        )


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Return width and height as Python's integers.

    Raises
    ------
    UsageError
        They are not two integers from 1 to 2^31.
    """
    sides = _integers(size, 2)
    if sides is None or not all(1 <= side <= LARGEST_SIDE for side in sides):
        raise UsageError(f"size {_shown(size, 'x')}: expected width and height from 1 to {LARGEST_SIDE}")
    return sides[0], sides[1]


def check_crop(crop: tuple[int, int, int, int], size: tuple[int, int]) -> tuple[int, int, int, int]:
    """Return the crop as Python's integers.

    Raises
    ------
    UsageError
        It is not four integers, or not a rectangle inside the image of at least one pixel.
    """
    rectangle = _integers(crop, 4)
    if rectangle is not None:
        x, y, w, h = rectangle
        if min(x, y) >= 0 and min(w, h) >= 1 and x + w <= size[0] and y + h <= size[1]:
            return x, y, w, h
    raise UsageError(
        f"crop {_shown(crop, ',')}: expected a rectangle X,Y,W,H inside the image of {size[0]}x{size[1]} pixels"
    )


def _integers(values: object, number: int) -> tuple[int, ...] | None:
    """Return so many integers; None if the values are anything else."""
    if not isinstance(values, Iterable) or isinstance(values, bytes):
        return None
    listed = tuple(values)
    integers = tuple(integer for value in listed if (integer := as_integer(value)) is not None)
    return integers if len(integers) == len(listed) == number else None


def _shown(values: object, separator: str) -> str:
    return separator.join(map(str, values)) if isinstance(values, (tuple, list)) else quoted(values)
