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
