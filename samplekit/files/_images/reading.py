"""Opening image files that may be missing, damaged or of another program, and what `samplekit info` shows of them."""

from __future__ import annotations

import contextlib
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images.library import file_name, oiio, one_line
from samplekit.files._images.metadata import KEY, decode_metadata
from samplekit.files._reading import errors_naming

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# First bytes of the formats that we write. Asked about another file, OpenImageIO would try every reader it has.
_EXR = b"\x76\x2f\x31\x01"
_PNG = b"\x89PNG\r\n\x1a\n"


def read_info(path: Path) -> dict[str, Any]:
    """Size, parts and metadata of an EXR or PNG file that samplekit wrote. Reads no pixels.

    Returns
    -------
    dict
        ``format`` (``"openexr"`` or ``"png"``), ``width``, ``height``, ``window`` (left, top, and size of the whole
        image), ``parts`` (a list of ``name``, ``channels``, ``type``; a PNG has one part without a name),
        ``metadata``. All of it is JSON.

    Raises
    ------
    UsageError
        There is no such file, or samplekit did not write it.
    SamplekitError
        The file is damaged.
    """
    with opened(path) as file:
        specs = part_specs(file)
        first = specs[0]
        return {
            "format": file.format_name(),
            "width": first.width,
            "height": first.height,
            "window": [first.x, first.y, first.full_width, first.full_height],
            "parts": [
                {
                    "name": spec.get_string_attribute("oiio:subimagename"),
                    "channels": list(spec.channelnames),
                    "type": str(spec.format),
                }
                for spec in specs
            ],
            "metadata": decode_metadata(first.get_string_attribute(KEY)),
        }


@contextlib.contextmanager
def opened(path: Path) -> Iterator[oiio.ImageInput]:
    """Open an EXR or PNG file for reading.

    Raises
    ------
    UsageError
        There is no such file, or it is of another kind.
    SamplekitError
        The file is damaged.
    """
    with errors_naming(path):
        _check_signature(path)
        try:
            file = oiio.ImageInput.open(file_name(path))
            if file is None:
                raise SamplekitError(f"it is damaged: {one_line()}")
            with contextlib.closing(file):
                yield file
        except (UnicodeDecodeError, RuntimeError, MemoryError) as error:  # the bindings raise them for damaged headers
            raise SamplekitError(f"it is damaged: {' '.join(str(error).split())}") from None


def _check_signature(path: Path) -> None:
    with path.open("rb") as file:
        start = file.read(8)
    if start == _PNG:
        _check_chunks(path.read_bytes())
    elif not start.startswith(_EXR):
        raise UsageError("it is neither an EXR nor a PNG image")


def _check_chunks(data: bytes) -> None:
    """Refuse a PNG file of which a chunk is damaged or missing: libpng would complain of it on the terminal."""
    end, kind = len(_PNG), b""
    while kind != b"IEND":
        start = end
        # Length, kind, content and checksum.
        end = start + 12 + int.from_bytes(data[start : start + 4])
        if end > len(data):
            raise SamplekitError("it is damaged: it ends early")
        kind = data[start + 4 : start + 8]
        if zlib.crc32(data[start + 4 : end - 4]) != int.from_bytes(data[end - 4 : end]):
            raise SamplekitError(f"it is damaged: the checksum of its {kind!r} is wrong")


def part_specs(file: oiio.ImageInput) -> list[oiio.ImageSpec]:
    """Return the specification of each part of the file."""
    found: list[oiio.ImageSpec] = []
    while file.seek_subimage(len(found), 0):
        found.append(file.spec())
    error = file.geterror()  # the search ends with one, by design
    if not found:
        raise SamplekitError(f"it is damaged: {one_line(error)}")
    return found


def pixels(file: oiio.ImageInput, part: int, spec: oiio.ImageSpec, kind: Any) -> np.ndarray[Any, Any]:
    """Read the pixels [h, w, channels] of one part as stored: ``kind`` is ``oiio.FLOAT`` or ``oiio.UINT8``."""
    try:
        values = file.read_image(part, 0, 0, spec.nchannels, kind)
    except MemoryError:
        raise SamplekitError(f"no memory for {spec.width} x {spec.height} pixels") from None
    if values is None or file.has_error:
        raise SamplekitError(f"it is damaged: {one_line(file.geterror())}")
    return np.asarray(values).reshape(spec.height, spec.width, spec.nchannels)
