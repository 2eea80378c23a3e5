"""Points in files of the format that the file's ending names: written whole or not at all, and read back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._pointsets.npy import npy_writer, read_npy
from samplekit.files._pointsets.text import csv_text, plain_csv_text, read_text, utk_text
from samplekit.files._pointsets.utk_binary import read_utk_binary, utk_binary_writer
from samplekit.files._reading import errors_naming
from samplekit.files._writing import shown, text_writer, write_group

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit.files._writing import Writer

PLAIN = ".plain.csv"
ENDINGS = (".csv", PLAIN, ".npy", ".dat", ".bin")
PICTURES = (".svg", ".png", ".pdf")
"""Endings of pictures, which `samplekit.plots.PointsDisplay` draws."""


def check_path(path: Path, realizations: int) -> str:
    """Return the ending of the path in lower case, and check that such a file holds so many realisations.

    Raises
    ------
    UsageError
        The ending is none of points or of pictures, or the file holds one realisation and there are several.
    """
    ending = path.suffix.lower()
    if path.name.lower().endswith(PLAIN) and len(path.name) > len(PLAIN):
        ending = PLAIN
    if ending not in ENDINGS + PICTURES:
        *names, last = ENDINGS + PICTURES
        raise UsageError(f"cannot write {shown(path)}: expected a name that ends in {', '.join(names)} or {last}")
    if realizations != 1 and ending in (PLAIN, *PICTURES):
        what = f"{PLAIN} holds" if ending == PLAIN else "a picture shows"
        raise UsageError(f"{what} one realisation, not {realizations}: write .csv, .npy, .dat or .bin, or ask for one")
    return ending


def write_points(
    points: NDArray[np.float64], path: Path, *, progress: Callable[[int, int], None] = lambda _done, _total: None
) -> None:
    """Write points, or leave what was there.

    Pictures of points are drawn by :class:`samplekit.plots.PointsDisplay`.

    Parameters
    ----------
    points
        float64[R, N, D], each of R, N and D at least 1; ``.plain.csv`` takes R = 1.
    path
        Its ending chooses the format: ``.csv``, ``.plain.csv`` (coordinates alone, for Samplin' Safari and most
        others), ``.npy``, ``.dat`` and ``.bin`` (UTK's text and binary).
    progress
        Called with the numbers of points done and to do, where it may take long.

    Raises
    ------
    UsageError
        The ending is unknown, such a file cannot hold the points, or the path cannot be written to.
    SamplekitError
        The writing failed.
    """
    points = np.asarray(points, np.float64)
    if points.ndim != 3 or points.size == 0:
        raise UsageError(f"points must have shape [realisations, points, dimensions], not {list(points.shape)}")
    ending = check_path(path, points.shape[0])
    if ending in PICTURES:
        raise UsageError(f"cannot write {shown(path)}: samplekit.plots.PointsDisplay draws pictures of points")
    write_group([(path, _writer(ending, points, progress))])


def _writer(ending: str, points: NDArray[np.float64], progress: Callable[[int, int], None]) -> Writer:
    if ending == ".npy":
        return npy_writer(points)
    if ending == ".bin":
        return utk_binary_writer(points)
    text = {".csv": csv_text, PLAIN: plain_csv_text, ".dat": utk_text}[ending]
    return text_writer(text(points, progress))


def read_points(path: Path) -> NDArray[np.float64]:
    """Read points from a file of any kind that `write_points` writes: ``.npy``, ``.bin``, or text.

    Parameters
    ----------
    path
        A file with sets of equal numbers of points.

    Returns
    -------
    float64[R, N, D], each of R, N and D at least 1, in [0, 1).

    Raises
    ------
    UsageError
        There is no such file, or it is a folder or of another kind; values are outside [0, 1) or NaN; rows differ in
        length.
    SamplekitError
        The file is damaged.
    """
    with errors_naming(path):
        points = _read(path)
        if points.size == 0:
            raise UsageError("it holds no points")
        _check_values(points)
        return points


def _read(path: Path) -> NDArray[np.float64]:
    ending = path.suffix.lower()
    if ending in PICTURES:
        raise UsageError("a picture does not hold the numbers of its points: expected .npy, .bin, or numbers as text")
    return {".npy": read_npy, ".bin": read_utk_binary}.get(ending, read_text)(path)


def _check_values(points: NDArray[np.float64]) -> None:
    inside = (points >= 0.0) & (points < 1.0)  # NaN is neither
    if inside.all():
        return
    index, point, dimension = (int(i) for i in np.argwhere(~inside)[0])
    value = float(points[index, point, dimension])
    raise UsageError(f"set {index}, point {point}, dimension {dimension} is {value!r}: expected values in [0, 1)")
