"""The files of one rendering: STEM.exr with the numbers, STEM.png for the eye, STEM.error.png for the error."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images.exr import Window, parts_writer
from samplekit.files._images.falsecolor import error_picture
from samplekit.files._images.png import encode_srgb, png_writer
from samplekit.files._writing import Writer, check_targets, shown, write_group

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike


_ENDINGS = (".exr", ".png", ".error.png")


def check_stem(output: str, name: str) -> Path:
    """Find the stem of a rendering's files, and check that they can be written before any work is done.

    Parameters
    ----------
    output
        A folder, ``STEM.exr``, or nothing for the current folder.
    name
        Last part of the stem in a folder.

    Raises
    ------
    UsageError
        Neither a folder nor ``STEM.exr``, or files that cannot be written there.
    """
    path = Path(output)
    try:
        is_folder = path.is_dir()
    except OSError as error:
        raise UsageError(f"cannot write to {shown(path)}: {error.strerror}") from None
    if is_folder:
        stem = path / name
    elif path.suffix == ".exr" and not output.endswith(("/", "\\")):
        stem = path.with_suffix("")
    else:
        raise UsageError(f"cannot write to {shown(path)}: it is neither a folder that exists nor ends in .exr")
    check_targets([_named(stem, ending) for ending in _ENDINGS])
    return stem


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
        Of a crop: ``(x, y, width, height)``, the place of its first pixel in the whole image, and the whole image's
        size.
    scale, title
        Of the error picture, as `samplekit.files._images.falsecolor.error_picture` takes them.

    Returns
    -------
    list of Path
        The files written, the EXR first.

    Raises
    ------
    UsageError
        Arrays of another shape; a window that does not hold them; a path that cannot be written to.
    SamplekitError
        A value that float32 cannot hold, metadata that is no JSON, or the writing failed: no file has changed.
    """
    given = {"image": image, "reference": reference, "error": error}
    parts = {name: np.asarray(values, np.float64) for name, values in given.items() if values is not None}
    for name, values in parts.items():
        if values.shape != parts["image"].shape:
            raise UsageError(f"the {name} has shape {list(values.shape)}, the image {list(parts['image'].shape)}")
    items: list[tuple[Path, Writer]] = [
        (_named(stem, _ENDINGS[0]), parts_writer(parts, metadata, window)),
        (_named(stem, _ENDINGS[1]), png_writer(encode_srgb(parts["image"]), metadata)),
    ]
    if "error" in parts:
        picture, used = error_picture(parts["error"], scale, title)
        items.append((_named(stem, _ENDINGS[2]), png_writer(picture, {**metadata, "error_scale": used})))
    write_group(items)
    return [path for path, _ in items]


def _named(stem: Path, ending: str) -> Path:
    # Not with_suffix: a stem may have a dot of its own, as in "zoneplate-k0.5".
    return stem.parent / (stem.name + ending)
