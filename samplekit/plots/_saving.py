"""Write figures as PNG, SVG or PDF: whole or not at all, and the same bytes for the same figure."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images.metadata import encode_metadata
from samplekit.files._writing import data_writer, write_group
from samplekit.plots._style import style

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit.files._writing import Writer

ENDINGS = (".png", ".svg", ".pdf")
"""Endings of the files that a figure can be written to."""


def save(figure: Figure, path: str | os.PathLike[str], metadata: Mapping[str, Any] | None = None) -> None:
    """Write a figure to a file of the kind that its ending says, or leave the file as it was.

    Parameters
    ----------
    figure
        Any figure of matplotlib.
    path
        A name that ends in ``.png``, ``.svg`` or ``.pdf``.
    metadata
        How the figure was made: anything that JSON holds. It is stored in the file; ``samplekit info`` reads it from
        a PNG.

    Raises
    ------
    UsageError
        The ending is another, or the path cannot be written to.
    SamplekitError
        The metadata is no JSON, or the writing failed.

    Examples
    --------
    >>> from samplekit.plots import make_axes, save
    >>> figure, axes = make_axes([(0, 0)], 3.0, 2.0)
    >>> save(figure, "plot.txt")
    Traceback (most recent call last):
        ...
    samplekit._errors.UsageError: a figure is written to a name that ends in .png, .svg or .pdf, not '.txt'
    """
    path = Path(path)
    write_group([(path, figure_writer(figure, path.suffix, metadata))])


def figure_writer(figure: Figure, ending: str, metadata: Mapping[str, Any] | None = None) -> Writer:
    """Make a writer of the figure for :func:`samplekit.files.write_group`, with the errors of :func:`save`.

    The figure is drawn here, before anything is written: as pixels at its own resolution, or as vectors whose text
    stays text. Neither has a date.

    Parameters
    ----------
    figure, metadata
        As in :func:`save`.
    ending
        End of the file's name: ``.png``, ``.svg`` or ``.pdf``.

    Examples
    --------
    >>> from samplekit.plots import figure_writer, make_axes
    >>> figure, axes = make_axes([(0, 0)], 3.0, 2.0)
    >>> callable(figure_writer(figure, ".svg", {"seed": "1"}))
    True
    """
    form = ending.lower()
    if form not in ENDINGS:
        raise UsageError(f"a figure is written to a name that ends in .png, .svg or .pdf, not {ending!r}")
    if form == ".png":
        from samplekit.files._images.png import png_writer

        return png_writer(_pixels(figure), metadata or {})
    return data_writer([_vectors(figure, form[1:], encode_metadata(metadata or {}))])


def inline_svg(figure: Figure) -> str:
    """Draw the figure as an SVG element for a page of HTML."""
    text = _vectors(figure, "svg", "").decode()
    return text[text.index("<svg") :]


@style()
def _vectors(figure: Figure, form: str, description: str) -> bytes:
    """Draw the figure as ``"svg"`` or ``"pdf"``, with a description among its metadata."""
    key, date = ("Description", "Date") if form == "svg" else ("Subject", "CreationDate")
    metadata = {"Creator": "samplekit", date: None, key: description}
    file = io.BytesIO()
    # The resolution is that of images inside of the file.
    figure.savefig(file, format=form, dpi=figure.dpi, metadata=metadata)
    return file.getvalue()


@style()
def _pixels(figure: Figure) -> NDArray[np.uint8]:
    """Draw the pixels uint8[h, w, 3], encoded as sRGB."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    before = figure.canvas
    canvas = FigureCanvasAgg(figure)
    try:
        canvas.draw()  # type: ignore[no-untyped-call]
        return np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[no-untyped-call]
    finally:
        figure.set_canvas(before)
