"""Small languages of these commands: projections, lists of frequencies, positive numbers."""

from __future__ import annotations

import math
import re

from samplekit import UsageError

MOST_PAIRS = 120


def parse_projections(text: str, dims: int | None) -> list[tuple[int, ...] | None]:
    """Read ``I,J``, ``I``, ``I,J,K``, ``all`` (every pair of the dimensions), or nothing (all dimensions at once).

    Raises
    ------
    UsageError
        Not of this form, or more pairs than a picture can show.
    """
    if not text:
        return [None]
    if text == "all":
        size = dims or 2
        pairs = [(i, j) for j in range(1, size) for i in range(j)] if size <= 1024 else []
        if not pairs or len(pairs) > MOST_PAIRS:
            raise UsageError(f"--project all shows the pairs of 2 to 16 dimensions, not of {size}")
        return list(pairs)
    if not re.fullmatch(r"\d{1,6}(,\d{1,6}){0,2}", text.strip(), re.ASCII):
        raise UsageError(f"project {text}: expected two dimensions such as 0,1, or all")
    return [tuple(int(word) for word in text.split(","))]


def parse_positive(text: str, what: str) -> float:
    """Read a finite number above 0.

    Raises
    ------
    UsageError
        It is none.
    """
    try:
        value = float(text) if "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise UsageError(f"{what} {text}: expected a number above 0")
    return value


def parse_vectors(text: str) -> list[list[float]]:
    """Read frequencies ``X,Y;X,Y;...``; a component is a number or a power such as ``2^40``.

    Raises
    ------
    UsageError
        Not of this form, or vectors of different lengths.
    """
    items = [item for item in text.split(";") if item.strip()]
    vectors = [[_component(word.strip(), text) for word in item.split(",")] for item in items]
    if not vectors or len({len(vector) for vector in vectors}) != 1:
        raise UsageError(f"frequencies {text!r}: expected vectors of one length, such as 0.5,1;2^20,3")
    return vectors


def _component(word: str, text: str) -> float:
    power = re.fullmatch(r"(-?)(\d{1,3})\^(\d{1,3})", word, re.ASCII)
    try:
        if power:
            return float(int(power[2]) ** int(power[3])) * (-1.0 if power[1] else 1.0)
        if "_" not in word:
            return float(word)
    except (ValueError, OverflowError):
        pass
    raise UsageError(f"frequencies {text!r}: {word!r} is no number")
