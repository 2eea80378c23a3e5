"""Points from text: our own CSV, plain columns, and the text of UTK, distinguished by their contents.

A line a point, its coordinates separated by commas or by spaces. Our own CSV begins with the header
``realisation,index,x0,...``; another first line without numbers is a header too, and skipped. A line that begins with
``#`` ends a set (UTK writes one between realisations); empty lines mean nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

_OURS = ["realisation", "index"]
_SHOWN = 30
"""Letters of a faulty line that a message shows."""


def read_text(path: Path) -> NDArray[np.float64]:
    """Read points float64[R, N, D].

    Raises
    ------
    UsageError
        The file is no such text: names the line.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError:
        raise UsageError("it is no text: expected .npy, .bin, or numbers as text") from None
    return parse_points(text)


def parse_points(text: str) -> NDArray[np.float64]:
    """Points float64[R, N, D] from the whole text of a file.

    Raises
    ------
    UsageError
        Something that is no number, rows of different lengths, sets of different sizes: names the line.
    """
    sets: list[list[list[float]]] = [[]]
    ours = False
    width = 0
    realization = -1.0
    for number, line in enumerate(text.split("\n"), start=1):
        stripped = line.strip()
        if not stripped:
            continue
        if stripped.startswith("#"):
            _close(sets, number)
            continue
        fields = stripped.split(",") if "," in stripped else stripped.split()
        # Python alone takes 1_000 for a number.
        row = None if "_" in stripped else _numbers(fields)
        if row is None:
            if width or any(_numbers([field]) for field in fields):
                what = stripped[:_SHOWN] + ("..." if len(stripped) > _SHOWN else "")
                raise UsageError(f"line {number}: expected numbers separated by commas or spaces, found {what!r}")
            ours = [field.strip() for field in fields[:2]] == _OURS
            width = len(fields)
            continue
        width = width or len(row)
        if len(row) != width:
            raise UsageError(f"line {number} has {len(row)} numbers, the lines before it have {width}")
        if ours:
            if row[0] != realization:
                _close(sets, number)
                realization = row[0]
            if row[1] != len(sets[-1]):
                raise UsageError(f"line {number}: index {row[1]:g} where {len(sets[-1])} was expected")
        sets[-1].append(row)
    _close(sets, number)
    if len(sets) == 1:
        raise UsageError("it holds no points")
    return np.array(sets[:-1], np.float64)[:, :, 2 if ours else 0 :].copy()


def _numbers(fields: list[str]) -> list[float] | None:
    """The numbers that the fields are; None if one of them is none."""
    try:
        return list(map(float, fields))
    except ValueError:
        return None


def _close(sets: list[list[list[float]]], line: int) -> None:
    """Begin another set, if the last one has points; all have as many as the first.

    Raises
    ------
    UsageError
        The last one has not.
    """
    if not sets[-1]:
        return
    if len(sets[-1]) != len(sets[0]):
        raise UsageError(
            f"set {len(sets) - 1}, before line {line}, has {len(sets[-1])} points, set 0 has {len(sets[0])}"
        )
    sets.append([])
