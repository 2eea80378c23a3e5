"""OpenImageIO, set up once: deterministic, silent, and safe to fork after.

Importing this module imports OpenImageIO; the rest of the package takes it from here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import OpenImageIO as oiio  # noqa: N813

from samplekit._errors import SamplekitError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["file_name", "oiio", "one_line"]

# A dropped ImageBuf with an unread error prints it to stdout, into the middle of a JSON answer.
oiio.attribute("imagebuf:print_uncaught_errors", 0)
oiio.attribute("threads", 1)
# Crops of images larger than its own limit are whole images to it.
oiio.attribute("limits:resolution", 2**31 - 1)
# -1 leaves OpenEXR without a thread pool of its own: with one, a process forked after any write waits for ever.
oiio.attribute("exr_threads", -1)


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


def one_line(*messages: str) -> str:
    """Return the start of the first message that says something, on one line; they are often repeated many times."""
    for message in (*messages, oiio.geterror()):
        lines = list(dict.fromkeys(line.strip() for line in message.splitlines() if line.strip()))
        if lines:
            return "; ".join(lines[:2])
    return "OpenImageIO gives no reason"
