"""OpenImageIO, set up once: deterministic, silent, and safe to fork after.

Importing this module imports OpenImageIO; the rest of the package takes it from here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import OpenImageIO as oiio  # noqa: N813

from samplekit._errors import SamplekitError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

__all__ = ["file_name", "oiio", "one_line", "write_image"]

# A dropped ImageBuf with an unread error prints it to stdout, into the middle of a JSON answer.
oiio.attribute("imagebuf:print_uncaught_errors", 0)
oiio.attribute("threads", 1)
# Crops of images larger than its own limit are whole images to it.
oiio.attribute("limits:resolution", 2**31 - 1)
# -1 leaves OpenEXR without a thread pool of its own: with one, a process forked after any write waits for ever.
oiio.attribute("exr_threads", -1)


def write_image(path: Path, file_format: str, specs: Sequence[oiio.ImageSpec], parts: Sequence[NDArray[Any]]) -> None:
    """Write the parts of an image file, each with its specification.

    Raises
    ------
    SamplekitError
        OpenImageIO failed. It may report success all the same: read the file back.
    """
    name = file_name(path)
    output = oiio.ImageOutput.create(file_format)
    if output is None:
        raise SamplekitError(one_line())
    try:
        # After a failed open, writing would end the process.
        good = output.open(name, specs)
        for index, pixels in enumerate(parts):
            good = good and (index == 0 or output.open(name, specs[index], "AppendSubimage"))
            good = good and output.write_image(pixels)
    finally:
        closed = output.close()  # always: an open file cannot be removed everywhere
    error = output.geterror()  # on a full disk every call for a PNG returns True, and only this reports it
    if error or not (good and closed):
        raise SamplekitError(one_line(error))


def file_name(path: Path) -> str:
    """Return the path as OpenImageIO takes it, which is UTF-8.

    Raises
    ------
    SamplekitError
        The path has bytes that are no Unicode.
    """
    name = str(path)
    try:
        name.encode()
    except UnicodeEncodeError:
        raise SamplekitError("the path is not valid Unicode, and OpenImageIO takes no other") from None
    return name


def one_line(message: str = "") -> str:
    """Return the start of the message on one line, or of OpenImageIO's own; they often repeat themselves."""
    for text in (message, oiio.geterror()):
        lines = list(dict.fromkeys(line.strip() for line in text.splitlines() if line.strip()))
        if lines:
            return "; ".join(lines[:2])
    return "OpenImageIO gives no reason"
