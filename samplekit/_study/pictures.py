"""The images of a study: the first trial of each row, with its error, in a scale that all samplers share."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.rendering import Rendering, render
from samplekit._study.folder import IMAGES, file_name
from samplekit._study.results import Pictures
from samplekit.files._images.falsecolor import rounded_up

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from samplekit._study.request import Request
    from samplekit._study.results import Row
    from samplekit._study.subjects import Subjects


def write_pictures(
    rows: list[Row],
    request: Request,
    subjects: Subjects,
    folder: Path,
    threads: int | None,
    progress: Callable[[int, int], None],
) -> list[Row]:
    """Write the images of all rows; return the rows with their names.

    Raises
    ------
    SamplekitError
        One cannot be written.
    """
    if request.one_pixel:
        return rows
    (folder / IMAGES).mkdir(exist_ok=True)
    done: dict[tuple[str, str, int], Pictures] = {}
    for scene in request.scenes:
        for count in sorted({row.count for row in rows if row.scene == scene}):
            own = [row for row in rows if (row.scene, row.count) == (scene, count)]
            renderings = [_rendering(row, request, subjects, threads) for row in own]
            scale = _scale(renderings)
            for row, rendering in zip(own, renderings, strict=True):
                done[row.scene, row.sampler, row.count] = _write(row, rendering, scale, folder)
                progress(len(done), len(rows))
    return [replace(row, pictures=done[row.scene, row.sampler, row.count]) for row in rows]


def _rendering(row: Row, request: Request, subjects: Subjects, threads: int | None) -> Rendering:
    scene, sampler = subjects.scene(row.scene), subjects.sampler(row.sampler)
    return render(scene, sampler, row.count, size=request.size, seed=request.seed, threads=threads)


def _scale(renderings: list[Rendering]) -> float | None:
    """One scale for all samplers of a scene and count, so that colours can be compared; None: there is no error."""
    errors = [rendering.error for rendering in renderings if rendering.error is not None]
    largest = max(float(np.abs(error[np.isfinite(error)]).max(initial=0.0)) for error in errors)
    return rounded_up(largest) if largest > 0.0 else None


def _write(row: Row, rendering: Rendering, scale: float | None, folder: Path) -> Pictures:
    name = f"{file_name(row.scene)}-{file_name(row.sampler)}-{row.count}spp.exr"
    saved = rendering.save(folder / IMAGES / name, scale=scale)
    exr, png, error_png = (f"{IMAGES}/{file.name}" for file in saved.files)
    return Pictures(exr, png, error_png, scale or 0.0)
