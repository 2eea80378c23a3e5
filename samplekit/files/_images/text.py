"""Text on pixels, in a font that comes with OpenImageIO: the same letters on every machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from samplekit._errors import SamplekitError
from samplekit.files._images.library import oiio, one_line

if TYPE_CHECKING:
    from numpy.typing import NDArray

FONT = "DroidSans"


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
    low, high = 0, len(text)
    while low < high:
        middle = (low + high + 1) // 2
        if width(text[:middle].rstrip() + "...", size) <= room:
            low = middle
        else:
            high = middle - 1
    return text[:low].rstrip() + "..."


def draw(
    pixels: NDArray[np.uint8], labels: list[Label], size: int, colour: tuple[float, float, float]
) -> NDArray[np.uint8]:
    """Return the pixels uint8[h, w, 3] with labels of ``size`` pixels on them, in a colour of components in [0, 1].

    Raises
    ------
    SamplekitError
        OpenImageIO has no font or cannot draw text.
    """
    canvas = oiio.ImageBuf(np.ascontiguousarray(pixels))
    for label in labels:
        algorithm = oiio.ImageBufAlgo.render_text
        if not algorithm(canvas, label.x, label.y, label.text, size, FONT, colour, label.align, "baseline"):
            raise SamplekitError(f"OpenImageIO cannot draw text: {one_line(canvas.geterror())}")
    return np.asarray(canvas.get_pixels(oiio.UINT8), np.uint8)
