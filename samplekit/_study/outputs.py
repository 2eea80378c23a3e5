"""The files of a study: the pictures of its rows, plots, ``results.csv``, ``results.json`` and ``report.html``."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from samplekit._drawing.raster import draw_pixels
from samplekit._drawing.vector import svg_text
from samplekit._report import write_report
from samplekit._study.folder import CSV, JSON, PLOTS
from samplekit._study.pictures import write_pictures
from samplekit._study.plots import plots_of
from samplekit._study.results import SCHEMA, to_json
from samplekit._study.table import table_text
from samplekit.files._images.png import png_writer
from samplekit.files._verified import text_writer
from samplekit.files._writing import Writer, write_group

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from samplekit._study.request import Request
    from samplekit._study.results import Results
    from samplekit._study.subjects import Subjects


def write_outputs(
    results: Results,
    request: Request,
    subjects: Subjects,
    folder: Path,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> Results:
    """Write all files; return the results with the names of plots and pictures.

    Raises
    ------
    SamplekitError
        One cannot be written.
    """
    rows = write_pictures(results.rows, request, subjects, folder, threads, progress)
    drawings = plots_of(results)
    (folder / PLOTS).mkdir(exist_ok=True)
    metadata = {"schema": SCHEMA, "command": results.command, "versions": results.versions}
    items: list[tuple[Path, Writer]] = []
    for name, drawing in drawings.items():
        items.append((folder / PLOTS / f"{name}.svg", text_writer([svg_text(drawing, metadata)])))
        items.append((folder / PLOTS / f"{name}.png", png_writer(draw_pixels(drawing, 2), metadata)))
    results = replace(results, rows=rows, plots=[f"{PLOTS}/{path.name}" for path, _ in items])
    items.append((folder / CSV, text_writer([table_text(results)])))
    items.append((folder / JSON, text_writer([to_json(results)])))
    write_group(items)
    write_report(results, folder)
    return results
