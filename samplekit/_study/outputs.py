"""The files of a study: the pictures of its rows, plots, ``results.csv``, ``results.json`` and ``report.html``."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from samplekit._report import write_report
from samplekit._study.folder import CSV, JSON, PLOTS, file_name
from samplekit._study.pictures import write_pictures
from samplekit._study.results import SCHEMA, to_json
from samplekit._study.table import table_text
from samplekit.files._writing import Writer, text_writer, write_group
from samplekit.plots._saving import figure_writer
from samplekit.plots._study import Against, StudyDisplay

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from samplekit._study.request import Request
    from samplekit._study.results import Results
    from samplekit._study.subjects import Subjects

_PLOTS: tuple[tuple[str, Against], ...] = (("error-against-count", "samples"), ("error-against-time", "time"))
"""Names of the plots of each scene, and what they draw the error against."""


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
    (folder / PLOTS).mkdir(exist_ok=True)
    metadata = {"schema": SCHEMA, "command": results.command, "versions": results.versions}
    items: list[tuple[Path, Writer]] = []
    for scene in results.scenes:
        for name, against in _PLOTS:
            display = StudyDisplay(results, scene, against)
            if display.rows:
                figure = display.plot().figure_
                for ending in (".svg", ".png"):
                    path = folder / PLOTS / f"{file_name(scene)}.{name}{ending}"
                    items.append((path, figure_writer(figure, ending, metadata)))
    results = replace(results, rows=rows, plots=[f"{PLOTS}/{path.name}" for path, _ in items])
    items.append((folder / CSV, text_writer([table_text(results)])))
    items.append((folder / JSON, text_writer([to_json(results)])))
    write_group(items)
    write_report(results, folder)
    return results
