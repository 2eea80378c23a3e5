"""Eight-bit PNG: linear values encoded as sRGB for the eye; a text chunk ``samplekit`` says how they were made."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images import reading
from samplekit.files._images.library import oiio, write_image
from samplekit.files._images.metadata import KEY, decode_metadata, encode_metadata
from samplekit.files._writing import Writer, write_group

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike, NDArray

RESERVED = (255, 0, 255)
"""Colour of pixels that are NaN or infinite: no grey and no error has it."""


def encode_srgb(array: ArrayLike) -> NDArray[np.uint8]:
    """Encode linear values as sRGB of eight bits (IEC 61966-2-1), clamped to [0, 1] and rounded to nearest.

    Parameters
    ----------
    array
        float64[h, w], shown as grey, or float64[h, w, 3] with Rec. 709 primaries.

    Returns
    -------
    uint8[h, w, 3]
        Pixels with a NaN or an infinity in any channel have the colour `RESERVED`.
    """
    linear = np.asarray(array, np.float64)
    finite = np.isfinite(linear)
    linear = np.clip(np.where(finite, linear, 0.0), 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    levels = np.floor(255.0 * encoded + 0.5).astype(np.uint8)
    if levels.ndim == 2:
        levels, finite = np.repeat(levels[:, :, None], 3, axis=2), finite[:, :, None]
    levels[~finite.all(axis=2)] = RESERVED
    return levels


def write_png(path: Path, pixels: NDArray[np.uint8], metadata: Mapping[str, Any]) -> None:
    """Write uint8[h, w, 3], already encoded as sRGB, as a PNG file, or leave what was there.

    Raises
    ------
    UsageError
        The pixels have another shape or type, or the path cannot be written to.
    SamplekitError
        The metadata is no JSON, or the writing failed.
    """
    write_group([(path, png_writer(pixels, metadata))])


def png_writer(pixels: NDArray[np.uint8], metadata: Mapping[str, Any]) -> Writer:
    """Make a writer for `samplekit.files.write_group`, with the parameters and errors of `write_png`.

    The input is checked here, before anything is written.
    """
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.size == 0:
        raise UsageError(f"PNG needs uint8[h, w, 3], not {pixels.dtype}{list(pixels.shape)}")
    pixels = np.ascontiguousarray(pixels)
    text = encode_metadata(metadata)
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, oiio.UINT8)
    oiio.set_colorspace(spec, "srgb_rec709_scene")
    spec.attribute(KEY, text)
    # The default level takes five times as long for a tenth of the size.
    spec.attribute("png:compressionLevel", 2)

    def write(temporary: Path) -> None:
        write_image(temporary, "png", [spec], [pixels])
        stored, found = read_png(temporary)
        if not np.array_equal(stored, pixels) or encode_metadata(found) != text:
            raise SamplekitError("what was read back is not what was written")

    return write


def read_png(path: Path) -> tuple[NDArray[np.uint8], dict[str, Any]]:
    """Read the pixels uint8[h, w, 3] and the metadata of a PNG file that samplekit wrote.

    Raises
    ------
    UsageError
        There is no such file, or samplekit did not write it.
    SamplekitError
        The file is damaged.
    """
    with reading.opened(path) as file:
        if file.format_name() != "png":
            raise UsageError(f"it is a {file.format_name()} file, not PNG")
        spec = file.spec()
        metadata = decode_metadata(spec.get_string_attribute(KEY))
        return reading.pixels(file, 0, spec, oiio.UINT8), metadata
