"""Multi-part float32 EXR: named parts of one size, their place in the whole image, and how they were made.

Part k has channel Y, or R, G and B, ``zip`` compression, and the metadata as a JSON string in attribute
``samplekit``. Every part has the metadata, so that a part taken out of the file still says how it was made. There is no
date: the same input gives the same bytes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images import reading
from samplekit.files._images.library import oiio, write_image
from samplekit.files._images.metadata import KEY, decode_metadata, encode_metadata

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike, NDArray

    from samplekit.files._writing import Writer

Window = tuple[int, int, int, int]
"""Left and top edge of the pixels within the whole image, and its width and height, in pixels."""


class Contents(NamedTuple):
    """The contents of an EXR file: arrays by part name, metadata, and the window."""

    parts: dict[str, NDArray[np.float64]]
    metadata: dict[str, Any]
    window: Window


def parts_writer(parts: Mapping[str, ArrayLike], metadata: Mapping[str, Any], window: Window | None = None) -> Writer:
    """Make a writer of an EXR file for `samplekit.files.write_group`; the input is checked here.

    Parameters
    ----------
    parts
        By name: float64[h, w] or float64[h, w, 3], all of one size. Stored as float32: rounded to nearest (so below
        7e-46 to 0); NaN and infinity are kept.
    metadata
        Anything that JSON holds.
    window
        For a crop ``(x, y, width, height)``: the first pixel's place in the whole image, and the whole image's size.
        None: the pixels are the whole image.

    Raises
    ------
    UsageError
        A part has another shape, size or no name, or the window does not hold the pixels.
    SamplekitError
        A finite value is beyond the range of float32, or the metadata is no JSON.
    """
    arrays = {name: _to_float32(name, values) for name, values in parts.items()}
    if "" in arrays:
        raise UsageError("a part of an EXR file needs a name")
    sizes = {values.shape[:2] for values in arrays.values()}
    if len(sizes) != 1:
        raise UsageError("an EXR file needs parts of one size" if sizes else "an EXR file needs at least one part")
    height, width = sizes.pop()
    window = _checked_window(window, width, height)
    text = encode_metadata(metadata)
    specs = [_spec(name, values, window, text) for name, values in arrays.items()]

    def write(temporary: Path) -> None:
        write_image(temporary, "openexr", specs, list(arrays.values()))
        _verify(temporary, arrays, text, window)

    return write


def read_parts(path: Path) -> Contents:
    """Read an EXR file that samplekit wrote.

    Returns
    -------
    Contents
        ``parts`` (float64[h, w] or float64[h, w, 3] by name), ``metadata``, ``window``.

    Raises
    ------
    UsageError
        There is no such file, or samplekit did not write it.
    SamplekitError
        The file is damaged.
    """
    stored, metadata, window = _read(path)
    with np.errstate(invalid="ignore"):  # a signalling NaN
        parts = {name: _squeezed(values).astype(np.float64) for name, values in stored.items()}
    return Contents(parts, metadata, window)


def _to_float32(name: str, values: ArrayLike) -> NDArray[np.float32]:
    """Return the values of one part as float32[h, w, 1 or 3].

    Raises
    ------
    UsageError
        The part has another shape, or no pixels.
    SamplekitError
        A finite value is beyond the range of float32, and would be stored as infinity.
    """
    array = np.asarray(values, np.float64)
    if not (array.ndim == 2 or (array.ndim == 3 and array.shape[2] == 3)) or array.size == 0:
        raise UsageError(f"part {name}: an image must have shape [h, w] or [h, w, 3], not {list(array.shape)}")
    with np.errstate(over="ignore", invalid="ignore"):
        stored = array.astype(np.float32)
    lost = np.isinf(stored) & np.isfinite(array)
    if lost.any():
        largest = array[lost][np.abs(array[lost]).argmax()]
        raise SamplekitError(
            f"part {name}: {int(lost.sum())} values are beyond float32 (3.4e+38), the largest is {largest:.6g}"
        )
    return np.ascontiguousarray(stored.reshape(*array.shape[:2], -1))


def _checked_window(window: Window | None, width: int, height: int) -> Window:
    if window is None:
        return (0, 0, width, height)
    x, y, full_width, full_height = (int(value) for value in window)
    if x < 0 or y < 0 or x + width > full_width or y + height > full_height:
        raise UsageError(
            f"{width} x {height} pixels at ({x}, {y}) are not within an image of {full_width} x {full_height}"
        )
    return (x, y, full_width, full_height)


def _spec(name: str, values: NDArray[np.float32], window: Window, text: str) -> oiio.ImageSpec:
    height, width, channels = values.shape
    spec = oiio.ImageSpec(width, height, channels, oiio.FLOAT)
    spec.channelnames = ("Y",) if channels == 1 else ("R", "G", "B")
    spec.x, spec.y, spec.full_width, spec.full_height = window
    spec.attribute("oiio:subimagename", name)
    spec.attribute("compression", "zip")
    spec.attribute("DateTime", "")  # left to itself OpenImageIO stores the time of writing
    spec.attribute(KEY, text)
    return spec


def _read(path: Path) -> tuple[dict[str, NDArray[np.float32]], dict[str, Any], Window]:
    with reading.opened(path) as file:
        if file.format_name() != "openexr":
            raise UsageError(f"it is a {file.format_name()} file, not EXR")
        specs = reading.part_specs(file)
        metadata = decode_metadata(specs[0].get_string_attribute(KEY))
        stored = {}
        for index, spec in enumerate(specs):
            name = spec.get_string_attribute("oiio:subimagename")
            if name in stored or spec.nchannels not in (1, 3) or spec.deep:
                raise SamplekitError(f"it is damaged: part {index} ({name!r}) is none that samplekit writes")
            stored[name] = reading.pixels(file, index, spec, oiio.FLOAT)
        first = specs[0]
        return stored, metadata, (first.x, first.y, first.full_width, first.full_height)


def _verify(path: Path, arrays: Mapping[str, NDArray[np.float32]], text: str, window: Window) -> None:
    """Compare bit for bit: a success that OpenImageIO reports is no proof."""
    stored, metadata, stored_window = _read(path)
    same = list(stored) == list(arrays) and encode_metadata(metadata) == text and stored_window == window
    if not same or any(
        not np.array_equal(stored[name].view(np.uint32), values.view(np.uint32)) for name, values in arrays.items()
    ):
        raise SamplekitError("what was read back is not what was written")


def _squeezed(values: NDArray[np.float32]) -> NDArray[np.float32]:
    return values[:, :, 0] if values.shape[2] == 1 else values
