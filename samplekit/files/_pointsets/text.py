"""Points as text: our own CSV, the coordinates alone, and the text of UTK, the uniform sampling toolkit.

Each line is a point, with its coordinates separated by commas or by spaces. Numbers are the shortest that read back as
the same float64.

- ``.csv``, our own, begins with the header ``realisation,index,x0,...``.
- ``.plain.csv`` has the coordinates alone, as Samplin' Safari reads them: it would take a header for a point
  (src/sampler/CSVFile.cpp in wkjarosz/SamplinSafari).
- ``.dat``, UTK's, has a line ``#`` between one realisation and the next, and none after the last
  (utk-team.github.io/utk/usingutk/ExeUtk, "File formats"; include/utk/utils/PointsetIO.hpp in utk-team/utk, whose
  reader would take an empty line for a point).

The reader distinguishes them by their contents. It skips any other first line without numbers as a header, and empty
lines; a line that begins with ``#`` ends a set.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    Progress = Callable[[int, int], None]

_OURS = ["realisation", "index"]
_BLOCK = 1 << 14
"""Points of a piece of text: large enough to be fast, small enough that a piece stays below some megabytes."""
_SHOWN = 30
"""Letters of a faulty line that a message shows."""


def csv_text(points: NDArray[np.float64], progress: Progress = lambda _done, _total: None) -> Iterator[str]:
    """Give the points as text in pieces, so that the whole of it is never in memory.

    Parameters
    ----------
    points
        float64[R, N, D].
    progress
        Called with the numbers of points done and to do.

    Yields
    ------
    str
        The header ``realisation,index,x0,x1,...``, then whole lines ending in a line feed. Numbers are the shortest
        that read back as the same float64.
    """
    yield ",".join([*_OURS, *(f"x{d}" for d in range(points.shape[2]))]) + "\n"
    for r, start, rows in _blocks(points, progress):
        yield "".join(f"{r},{index},{','.join(map(repr, row))}\n" for index, row in enumerate(rows, start))


def plain_csv_text(points: NDArray[np.float64], progress: Progress) -> Iterator[str]:
    """Give the coordinates of one set float64[1, N, D] as text in pieces, as in `csv_text`."""
    for _, _, rows in _blocks(points, progress):
        yield "".join(f"{','.join(map(repr, row))}\n" for row in rows)


def utk_text(points: NDArray[np.float64], progress: Progress) -> Iterator[str]:
    """Give points float64[R, N, D] as UTK's text in pieces, as in `csv_text`."""
    for r, start, rows in _blocks(points, progress):
        if r > 0 and start == 0:
            yield "#\n"
        yield "".join(f"{' '.join(map(repr, row))}\n" for row in rows)


def _blocks(points: NDArray[np.float64], progress: Progress) -> Iterator[tuple[int, int, list[list[float]]]]:
    """Give the points in blocks: the realisation, the index of the first point, and the coordinates."""
    realizations, count, _ = points.shape
    for r in range(realizations):
        for start in range(0, count, _BLOCK):
            rows = points[r, start : start + _BLOCK].tolist()
            yield r, start, rows
            progress(r * count + start + len(rows), realizations * count)


def read_text(path: Path) -> NDArray[np.float64]:
    """Read points float64[R, N, D].

    Raises
    ------
    UsageError
        The file is not a list of numbers; the message names the line.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError:
        raise UsageError("it is no text: expected .npy, .bin, or numbers as text") from None
    return parse_points(text)


def parse_points(text: str) -> NDArray[np.float64]:
    """Return the points float64[R, N, D] in the whole text of a file.

    Raises
    ------
    UsageError
        A field is no number, rows differ in length, or sets differ in size; the message names the line.
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
    """Return the fields as numbers; None if one of them is no number."""
    try:
        return list(map(float, fields))
    except ValueError:
        return None


def _close(sets: list[list[list[float]]], line: int) -> None:
    """Begin another set, if the last one has points.

    Raises
    ------
    UsageError
        The last set has another number of points than the first.
    """
    last, first = len(sets[-1]), len(sets[0])
    if not last:
        return
    if last != first:
        raise UsageError(f"set {len(sets) - 1}, before line {line}, has {last} points, set 0 has {first}")
    sets.append([])
