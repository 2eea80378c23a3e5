"""Write points to a file of the kind that its ending says, whole or not at all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._writing import shown, write_group

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
    """Return the ending of the path in lower case, once it is known that such points fit into such a file.

    Raises
    ------
    UsageError
        No ending of a file of points or of a picture, or several realisations where there is room for one.
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
        An unknown ending, or points that such a file cannot hold; a path that cannot be written to.
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
    # Each format imports its own: a table of numbers needs no other library.
    if ending == ".npy":
        from samplekit.files._pointsets.npy import npy_writer

        return npy_writer(points)
    if ending == ".bin":
        from samplekit.files._pointsets.utk_binary import utk_binary_writer

        return utk_binary_writer(points)
    from samplekit.files._writing import text_writer

    if ending == ".dat":
        from samplekit.files._pointsets.utk_text import utk_text

        return text_writer(utk_text(points, progress))
    from samplekit.files._pointsets.csv import csv_text, plain_csv_text

    return text_writer(csv_text(points, progress) if ending == ".csv" else plain_csv_text(points[0], progress))
