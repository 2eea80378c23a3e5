"""Opening image files that may be missing, damaged or somebody else's."""

from __future__ import annotations

import contextlib
import struct
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images import metadata as metadata_
from samplekit.files._images.library import file_name, oiio, one_line
from samplekit.files._writing import shown

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# First bytes of the formats that we write. Asked about another file, OpenImageIO would try every reader it has.
_EXR = b"\x76\x2f\x31\x01"
_PNG = b"\x89PNG\r\n\x1a\n"


@contextlib.contextmanager
def opened(path: Path) -> Iterator[oiio.ImageInput]:
    """Open an EXR or PNG file for reading.

    Raises
    ------
    UsageError
        No such file, or one of another kind.
    SamplekitError
        The file is damaged.
    """
    _check_signature(path)
    try:
        file = oiio.ImageInput.open(file_name(path))
        if file is None:
            raise SamplekitError(f"it is damaged: {one_line()}")
        try:
            yield file
        finally:
            file.close()
    except UsageError as error:
        raise UsageError(f"cannot read {shown(path)}: {error}") from None
    except SamplekitError as error:
        raise SamplekitError(f"cannot read {shown(path)}: {error}") from None
    except (UnicodeDecodeError, RuntimeError, MemoryError) as error:  # what a damaged header makes of the bindings
        raise SamplekitError(f"cannot read {shown(path)}: it is damaged: {' '.join(str(error).split())}") from None


def _check_signature(path: Path) -> None:
    try:
        if path.exists() and not path.is_file():  # opening a pipe would wait for its writer
            raise UsageError(f"cannot read {shown(path)}: it is not a regular file")
        with path.open("rb") as file:
            start = file.read(8)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"cannot read {shown(path)}: {reason}") from None
    if start == _PNG:
        _check_chunks(path)
    elif not start.startswith(_EXR):
        raise UsageError(f"cannot read {shown(path)}: it is neither an EXR nor a PNG image")


def _check_chunks(path: Path) -> None:
    """Refuse a PNG file of which a chunk is damaged or missing: libpng would complain of it on the terminal."""
    data = memoryview(path.read_bytes())
    position = len(_PNG)
    kind = b""
    while kind != b"IEND":
        (length,) = struct.unpack(">I", data[position : position + 4]) if len(data) >= position + 12 else (len(data),)
        end = position + 12 + length
        if end > len(data):
            raise SamplekitError(f"cannot read {shown(path)}: it is damaged: it ends early")
        kind = bytes(data[position + 4 : position + 8])
        if zlib.crc32(data[position + 4 : end - 4]) != int.from_bytes(data[end - 4 : end], "big"):
            raise SamplekitError(f"cannot read {shown(path)}: it is damaged: the checksum of its {kind!r} is wrong")
        position = end


def specs(file: oiio.ImageInput) -> list[oiio.ImageSpec]:
    """Return what the file says of each of its parts."""
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


def metadata(spec: oiio.ImageSpec) -> dict[str, Any]:
    """Return the metadata of one part.

    Raises
    ------
    UsageError
        There is none: the file is not ours.
    """
    text = spec.get_string_attribute(metadata_.KEY)
    if not text:
        raise UsageError("it was not made by samplekit: it has no samplekit metadata")
    return metadata_.decode(text)
