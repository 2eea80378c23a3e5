"""Read values of options from text: projections, lists of frequencies, positive numbers."""

from __future__ import annotations

import re

from samplekit import UsageError
from samplekit.commands import parse_number

MOST_PAIRS = 120


def parse_projections(text: str, dims: int | None) -> list[tuple[int, ...] | None]:
    """Read ``I,J``, ``I``, ``I,J,K``, ``all`` (every pair of the dimensions), or nothing (all dimensions at once).

    Raises
    ------
    UsageError
        The text has another form, or there are more pairs than a picture can show.
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
        It is not a finite number above 0.
    """
    expected = "a number above 0"
    value = parse_number(text, what, expected)
    if value <= 0.0:
        raise UsageError(f"{what} {text}: expected {expected}")
    return value


def parse_vectors(text: str) -> list[list[float]]:
    """Read frequencies ``X,Y;X,Y;...``; a component is a number or a power such as ``2^40``.

    Raises
    ------
    UsageError
        The text has another form, or the vectors have different lengths.
    """
    vectors = [[_component(word.strip()) for word in item.split(",")] for item in text.split(";") if item.strip()]
    if not vectors or len({len(vector) for vector in vectors}) != 1:
        raise UsageError(f"frequencies {text!r}: expected vectors of one length, such as 0.5,1;2^20,3")
    return vectors


def _component(word: str) -> float:
    power = re.fullmatch(r"(-?)(\d{1,3})\^(\d{1,2})", word, re.ASCII)
    if power:
        return float(int(power[2]) ** int(power[3])) * (-1.0 if power[1] else 1.0)
    return parse_number(word, "frequencies", "numbers such as 0.5 or 2^20")
