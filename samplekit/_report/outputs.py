"""Write the files of a study: images of its rows, plots, ``results.csv``, ``results.json`` and ``report.html``."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.rendering import Rendering, render
from samplekit._report.page import page
from samplekit._report.results_csv import csv_text
from samplekit._study.folder import CSV, IMAGES, JSON, PLOTS, REPORT, file_name
from samplekit._study.results import SCHEMA, Pictures
from samplekit.files import text_writer, write_group
from samplekit.files._images.falsecolor import rounded_up
from samplekit.plots import figure_writer
from samplekit.plots._study import Against, StudyDisplay

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from samplekit._study.request import Request
    from samplekit._study.resources import Resources
    from samplekit._study.results import Results, Row
    from samplekit.files import Writer

_PLOTS: tuple[tuple[str, Against], ...] = (("error-against-count", "samples"), ("error-against-time", "time"))
"""Names of the plots of each scene, and what they draw the error against."""


def write_outputs(
    results: Results,
    request: Request,
    resources: Resources,
    folder: Path,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> Results:
    """Write all files of a study; plots, tables and the page are replaced all together or not at all.

    Parameters
    ----------
    results, request, resources
        The study.
    folder
        Where the files go.
    threads
        Number of threads that render the images; None: a thread for each processor.
    progress
        Called with the number of images done and to do.

    Returns
    -------
    The results with the names of plots and images.

    Raises
    ------
    SamplekitError
        A file cannot be written.
    """
    rows = _write_images(results.rows, request, resources, folder, threads, progress)
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
    items.append((folder / CSV, text_writer([csv_text(results)])))
    items.append((folder / JSON, text_writer([json.dumps(results.as_json(), allow_nan=False, indent=1)])))
    items.append((folder / REPORT, text_writer([page(results, folder)])))
    write_group(items)
    return results


def _write_images(
    rows: list[Row],
    request: Request,
    resources: Resources,
    folder: Path,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> list[Row]:
    """Write the first trial of each row as an image, with its error; return the rows with the names of the files.

    All samplers of a scene and count share one scale of errors, so that their colours can be compared.
    """
    if request.one_pixel:
        return rows
    (folder / IMAGES).mkdir(exist_ok=True)
    done: dict[tuple[str, str, int], Pictures] = {}
    for scene in request.scenes:
        for count in sorted({row.count for row in rows if row.scene == scene}):
            own = [row for row in rows if (row.scene, row.count) == (scene, count)]
            renderings = [
                render(
                    resources.scene(scene),
                    resources.sampler(row.sampler),
                    count,
                    size=request.size,
                    seed=request.seed,
                    threads=threads,
                )
                for row in own
            ]
            scale = _error_scale(renderings)
            for row, rendering in zip(own, renderings, strict=True):
                name = f"{file_name(scene)}-{file_name(row.sampler)}-{count}spp.exr"
                files = rendering.save(folder / IMAGES / name, scale=scale).files
                exr, png, error_png = (f"{IMAGES}/{file.name}" for file in files)
                done[scene, row.sampler, count] = Pictures(exr, png, error_png, scale or 0.0)
                progress(len(done), len(rows))
    return [replace(row, pictures=done[row.scene, row.sampler, row.count]) for row in rows]


def _error_scale(renderings: list[Rendering]) -> float | None:
    """Return the error that gets the strongest colour in all of the images; None if there is no error."""
    errors = [rendering.error for rendering in renderings if rendering.error is not None]
    largest = max(float(np.abs(error[np.isfinite(error)]).max(initial=0.0)) for error in errors)
    return rounded_up(largest) if largest > 0.0 else None
