"""Pack the images of a study so that they fit into the page.

Errors are rounded to whole steps. The step is a power of two, at most 1/64 of the root mean square of the image's
errors, so every pixel is right to 1/128 of that. The reference of a scene is stored once, in float32 as in the EXR
files. If all pixels of all images would make the page too large, each scene keeps the window with the largest errors;
no image becomes coarser.
"""

from __future__ import annotations

import base64
import math
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError
from samplekit.files import read_parts

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit._study.results import Results, Row

STEPS = 64
"""A step is at most the root mean square of the error divided by this number."""

BUDGET = 18_000_000
"""Most characters that all images of a page take together."""

_INVALID = 0xFFFFFF


def packed(results: Results, folder: Path, budget: int = BUDGET) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """Pack the images of the first trials, for every scene that has images.

    Parameters
    ----------
    results, folder
        The study, and where the paths of its images begin.
    budget
        Most characters that all images take together.

    Returns
    -------
    scenes
        What the scripts of the page read about each scene with images.
    blobs
        The packed pixels by the names that occur in ``scenes``.

    Raises
    ------
    UsageError, SamplekitError
        An EXR file is missing or damaged, or has another size than the study.
    """
    rows_of: dict[str, list[tuple[int, Row]]] = {}
    for index, row in enumerate(results.rows):
        if row.pictures:
            rows_of.setdefault(row.scene, []).append((index, row))
    size, places = results.size, dict.fromkeys(rows_of, (0, 0))
    while True:
        scenes: list[dict[str, Any]] = []
        blobs: dict[str, str] = {}
        weights: dict[str, NDArray[np.float64]] = {}
        for scene, rows in rows_of.items():
            packed_scene, weights[scene] = _pack_scene(rows, folder, results.size, (*places[scene], *size), blobs)
            scenes.append(packed_scene)
        needed = sum(len(text) for text in blobs.values())
        if needed <= budget or max(size) == 1:
            return scenes, blobs
        shrink = 0.97 * math.sqrt(budget / needed)
        size = (max(1, int(shrink * size[0])), max(1, int(shrink * size[1])))
        places = {scene: _heaviest(weight, size) for scene, weight in weights.items()}


def _pack_scene(
    rows: Sequence[tuple[int, Row]],
    folder: Path,
    whole: tuple[int, int],
    window: tuple[int, int, int, int],
    blobs: dict[str, str],
) -> tuple[dict[str, Any], NDArray[np.float64]]:
    """Pack the images of one scene into ``blobs``.

    Return what the scripts read about the scene, and float64[h, w]: the sum of the squared errors of all images, scaled
    so that each image weighs the same.
    """
    left, top, width, height = window
    cut = np.s_[top : top + height, left : left + width]
    weight = np.zeros((whole[1], whole[0]))
    items: list[dict[str, Any]] = []
    reference_name = f"reference-{rows[0][0]}"
    for index, row in rows:
        reference, error = _parts(row, folder, whole)
        if not items:
            blobs[reference_name] = pack_reference(reference[cut])
        squared = np.square(np.where(np.isfinite(error), error, 0.0))
        weight += squared / (squared.sum() or 1.0)
        mse = float(squared.sum() / max(1, np.isfinite(error).sum()))
        name = f"error-{index}"
        blobs[name], step = pack_error(error[cut])
        items.append({"row": index, "step": step, "mse": mse, "rmse": math.sqrt(mse), "pixels": name})
    record = {
        "scene": rows[0][1].scene,
        "width": width,
        "height": height,
        "window": (left, top),
        "windowed": (width, height) != whole,
        "reference": reference_name,
        "items": items,
    }
    return record, weight


def _parts(row: Row, folder: Path, size: tuple[int, int]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read the reference and the error of a row from its EXR file."""
    assert row.pictures is not None
    path = folder / row.pictures.exr
    parts = read_parts(path).parts
    for name in ("reference", "error"):
        if name not in parts or parts[name].shape != (size[1], size[0]):
            raise SamplekitError(f"{path} has no part {name} of {size[0]} x {size[1]} pixels: run the study again")
    return parts["reference"], parts["error"]


def _heaviest(weight: NDArray[np.float64], size: tuple[int, int]) -> tuple[int, int]:
    """Return left and top of the window of this size that has the largest sum of weights."""
    width, height = size
    sums = np.zeros((weight.shape[0] + 1, weight.shape[1] + 1))
    sums[1:, 1:] = weight.cumsum(0).cumsum(1)
    inside = sums[height:, width:] - sums[:-height, width:] - sums[height:, :-width] + sums[:-height, :-width]
    top, left = np.unravel_index(int(np.argmax(inside)), inside.shape)
    return int(left), int(top)


def pack_reference(reference: NDArray[np.float64]) -> str:
    """Pack pixels as float32 in four planes of bytes, the lowest bytes first."""
    return _deflated(np.ascontiguousarray(reference, "<f4").view(np.uint8).reshape(-1, 4).T)


def pack_error(error: NDArray[np.float64]) -> tuple[str, float]:
    """Pack an error as whole steps 0, -1, 1, -2, ... of 24 bits in three planes of bytes, the lowest bytes first.

    Pixels that are not finite get the largest code. No other pixel reaches it: an error is at most the root of the
    number of pixels times the root mean square.

    Returns
    -------
    The packed pixels, and the step, a power of two.
    """
    finite = np.isfinite(error)
    values = np.where(finite, error, 0.0)
    largest = float(np.abs(values).max(initial=0.0))
    if largest == 0.0:
        step = 1.0
    else:
        # Scaled before they are squared, since squares of very small or very large errors are 0 or infinity.
        rms = largest * math.sqrt(float(np.mean(np.square(values[finite] / largest))))
        step = math.ldexp(1.0, max(math.floor(math.log2(rms / STEPS)), -149))  # float32 has no smaller one
    steps = np.rint(values / step).astype(np.int64)
    codes = np.where(steps < 0, -2 * steps - 1, 2 * steps)
    codes[~finite] = _INVALID
    return _deflated(codes.astype("<u4").reshape(-1, 1).view(np.uint8).T[:3]), step


def _deflated(planes: NDArray[np.uint8]) -> str:
    """Compress bytes and write them as text."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(planes).tobytes(), 6)).decode("ascii")
