"""Points into a file of the kind that its ending says, whole or not at all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._writing import shown, write_group

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.files._writing import Writer

PLAIN = ".plain.csv"
ENDINGS = (".csv", PLAIN, ".npy", ".dat", ".bin", ".svg", ".png")
PICTURES = (".svg", ".png")


def check_path(path: Path, realizations: int, dims: int) -> str:
    """Return the ending of the path in lower case, once it is known that such points fit into such a file.

    Raises
    ------
    UsageError
        An ending that is none of these; several realisations where there is room for one, or a picture of more than 16
        dimensions.
    """
    ending = path.suffix.lower()
    if path.name.lower().endswith(PLAIN) and len(path.name) > len(PLAIN):
        ending = PLAIN
    if ending not in ENDINGS:
        raise UsageError(
            f"cannot write {shown(path)}: expected a name that ends in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}"
        )
    if realizations != 1 and ending in (PLAIN, *PICTURES):
        what = f"{PLAIN} holds" if ending == PLAIN else "a picture shows"
        raise UsageError(f"{what} one realisation, not {realizations}: write .csv, .npy, .dat or .bin, or ask for one")
    if ending in PICTURES:
        from samplekit.files._pointsets.picture import check_dims

        check_dims(dims)
    return ending


def write_points(
    points: NDArray[np.float64],
    path: Path,
    *,
    spec: SamplerSpec,
    title: str,
    metadata: Mapping[str, Any],
    progress: Callable[[int, int], None] = lambda _done, _total: None,
) -> None:
    """Write points, or leave what was there.

    Parameters
    ----------
    points
        float64[R, N, D], each of R, N and D at least 1; pictures (``.svg``, ``.png``) take R = 1 and values in [0, 1],
        ``.plain.csv`` takes R = 1.
    path
        Its ending chooses the format: ``.csv``, ``.plain.csv`` (coordinates alone, for Samplin' Safari and most
        others), ``.npy``, ``.dat`` and ``.bin`` (UTK's text and binary), ``.svg``, ``.png``.
    spec
        The sampler's declaration: pictures show the grids that it promises.
    title
        Stands above a picture, see `title_of`.
    metadata
        How the points were made: anything that JSON holds, stored in pictures. The others hold the numbers alone.
    progress
        Called with the numbers of points done and to do, where it may take long.

    Raises
    ------
    UsageError
        An unknown ending, or points that such a file cannot show; a path that cannot be written to.
    SamplekitError
        Metadata that is no JSON; the writing failed.
    """
    points = np.asarray(points, np.float64)
    if points.ndim != 3 or points.size == 0:
        raise UsageError(f"points must have shape [realisations, points, dimensions], not {list(points.shape)}")
    ending = check_path(path, points.shape[0], points.shape[2])
    write_group([(path, _writer(ending, points, spec, title, metadata, progress))])


def title_of(sampler: str, count: int, dims: int, seed: int, realization: int = 0) -> str:
    """Say which points a picture shows."""
    points = "1 point" if count == 1 else f"{count} points"
    return f"{sampler}, {points} in {dims}D, seed {seed}, realisation {realization}"


def _writer(
    ending: str,
    points: NDArray[np.float64],
    spec: SamplerSpec,
    title: str,
    metadata: Mapping[str, Any],
    progress: Callable[[int, int], None],
) -> Writer:
    # Each format imports its own: a table of numbers needs no image library.
    if ending == ".npy":
        from samplekit.files._pointsets.npy import npy_writer

        return npy_writer(points)
    if ending == ".bin":
        from samplekit.files._pointsets.utk_binary import utk_binary_writer

        return utk_binary_writer(points)
    from samplekit.files._verified import text_writer

    if ending in (".csv", PLAIN):
        from samplekit.files._pointsets.csv import csv_text, plain_csv_text

        return text_writer(csv_text(points, progress) if ending == ".csv" else plain_csv_text(points[0], progress))
    if ending == ".dat":
        from samplekit.files._pointsets.utk_text import utk_text

        return text_writer(utk_text(points, progress))
    from samplekit.files._pointsets.picture import make_picture

    picture = make_picture(points[0], spec.promises, title)
    if ending == ".svg":
        from samplekit.files._pointsets.svg import svg_text

        return text_writer(svg_text(picture, metadata))
    from samplekit.files._images.png import png_writer
    from samplekit.files._pointsets.raster import draw_picture

    return png_writer(draw_picture(picture), metadata)
