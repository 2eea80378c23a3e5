"""Text on pixels, in a font that comes with OpenImageIO: the same letters on every machine."""

from __future__ import annotations

import bisect
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from samplekit._errors import SamplekitError
from samplekit.files._images.library import oiio, one_line

if TYPE_CHECKING:
    from numpy.typing import NDArray

FONT = "DroidSans"
_COLOUR = (0.9, 0.9, 0.9)


class Label(NamedTuple):
    """A text and its place in pixels: ``x`` of its left end, middle or right end (``align``), ``y`` of its baseline."""

    text: str
    x: int
    y: int
    align: str = "left"


def printable(text: str) -> str:
    """Return the text on one line, with a question mark for all that the font has no letter for."""
    latin = " ".join(text.split()).encode("latin-1", "replace").decode("latin-1")
    return "".join(letter if letter.isprintable() else "?" for letter in latin)


def width(text: str, size: int) -> int:
    """Measure in pixels a text whose letters are ``size`` pixels high."""
    if not text:
        return 0
    region = oiio.ImageBufAlgo.text_size(text, size, FONT)
    if not region.defined:
        raise SamplekitError(f"OpenImageIO cannot draw text: {one_line()}")
    return int(region.xend)


def fitted(text: str, size: int, room: int) -> str:
    """Return the text, cut short with dots if it is wider than ``room`` pixels."""
    if width(text, size) <= room:
        return text

    def shortened(letters: int) -> str:
        return text[:letters].rstrip() + "..."

    too_many = bisect.bisect_right(range(len(text)), room, key=lambda letters: width(shortened(letters), size))
    return shortened(max(too_many - 1, 0))


def draw(pixels: NDArray[np.uint8], labels: list[Label], size: int) -> NDArray[np.uint8]:
    """Return the pixels uint8[h, w, 3] with labels on them, light grey and ``size`` pixels high.

    Raises
    ------
    SamplekitError
        OpenImageIO has no font or cannot draw text.
    """
    canvas = oiio.ImageBuf(np.ascontiguousarray(pixels))
    for label in labels:
        algorithm = oiio.ImageBufAlgo.render_text
        if not algorithm(canvas, label.x, label.y, label.text, size, FONT, _COLOUR, label.align, "baseline"):
            raise SamplekitError(f"OpenImageIO cannot draw text: {one_line(canvas.geterror())}")
    return np.asarray(canvas.get_pixels(oiio.UINT8), np.uint8)
