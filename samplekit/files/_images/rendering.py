"""The files of one rendering: STEM.exr with the numbers, STEM.png for the eye, STEM.error.png for the error."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images.exr import Window, parts_writer
from samplekit.files._images.falsecolor import error_picture
from samplekit.files._images.png import encode_srgb, png_writer
from samplekit.files._writing import write_stem

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike

    from samplekit.files._writing import Writer

RENDERING_ENDINGS = (".exr", ".png", ".error.png")
"""The endings of the files of one rendering."""


def write_rendering(
    stem: Path,
    image: ArrayLike,
    reference: ArrayLike | None,
    error: ArrayLike | None,
    metadata: Mapping[str, Any],
    window: Window | None = None,
    *,
    scale: float | None = None,
    title: str | None = None,
) -> list[Path]:
    """Write an image and, if there is one, its error: all files or none.

    Parameters
    ----------
    stem
        The path without the ending: ``out/disk`` gives ``out/disk.exr``, ``out/disk.png`` and ``out/disk.error.png``.
    image
        Linear, float64[h, w] or float64[h, w, 3].
    reference
        The exact image, of the same shape, or None.
    error
        The signed error, image - reference; None leaves it out.
    metadata
        How the image was made: anything that JSON holds, stored in every file; ``STEM.error.png`` adds ``error_scale``.
    window
        For a crop ``(x, y, width, height)``: the first pixel's place in the whole image, and the whole image's size.
    scale, title
        Scale and title of the error picture, as `samplekit.files._images.falsecolor.error_picture` takes them.

    Returns
    -------
    list of Path
        The files written, the EXR first.

    Raises
    ------
    UsageError
        An array has another shape, the window does not hold it, or the path cannot be written to.
    SamplekitError
        Float32 cannot hold a value, the metadata is no JSON, or the writing failed: no file has changed.
    """
    given = {"image": image, "reference": reference, "error": error}
    parts = {name: np.asarray(values, np.float64) for name, values in given.items() if values is not None}
    for name, values in parts.items():
        if values.shape != parts["image"].shape:
            raise UsageError(f"the {name} has shape {list(values.shape)}, the image {list(parts['image'].shape)}")
    writers: dict[str, Writer] = {
        ".exr": parts_writer(parts, metadata, window),
        ".png": png_writer(encode_srgb(parts["image"]), metadata),
    }
    if "error" in parts:
        picture, used = error_picture(parts["error"], scale, title)
        writers[".error.png"] = png_writer(picture, {**metadata, "error_scale": used})
    return write_stem(stem, writers)
