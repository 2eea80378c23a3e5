"""A sheet of pictures: rows of tiles with a line above and lines below each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import Bitmap, Drawing, Text
from samplekit.files._images import diverging
from samplekit.files._images.png import encode_srgb

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from samplekit._integrate.rendering import Rendering

_MARGIN, _GAP = 20, 14
_SIZE, _LINE = 12, 16
_FAINT = "#6b7480"


@dataclass(frozen=True, eq=False)
class Tile:
    """Pixels uint8[h, w, 3] encoded as sRGB, a name above, lines below."""

    pixels: NDArray[np.uint8]
    above: str = ""
    below: tuple[str, ...] = ()


def image_tile(values: NDArray[np.float64], above: str = "", *below: str, enlarged: int = 1) -> Tile:
    """A tile of linear values float64[h, w], each pixel shown as a square of ``enlarged`` pixels."""
    return Tile(enlarged_pixels(encode_srgb(values), enlarged), above, below)


def error_tile(error: NDArray[np.float64], scale: float, above: str = "", *below: str, enlarged: int = 1) -> Tile:
    """A tile of signed errors in false colour: blue at -scale, white at 0, red at +scale."""
    return Tile(enlarged_pixels(diverging.colours(error, scale), enlarged), above, below)


def rendering_tiles(result: Rendering, scale: float, above: str, *below: str, enlarged: int = 1) -> tuple[Tile, Tile]:
    """The image and its error as tiles, for two rows of a sheet."""
    assert result.error is not None
    image = image_tile(result.image, above, enlarged=enlarged)
    return image, error_tile(result.error, scale, "", *below, enlarged=enlarged)


def sheet(title: str, lines: Sequence[str], rows: Sequence[Sequence[Tile]]) -> Drawing:
    """Lay out rows of tiles below a title and some lines; the tiles of a column are as wide as its widest."""
    columns = max(len(row) for row in rows)
    widths = [max((row[at].pixels.shape[1] for row in rows if at < len(row)), default=0) for at in range(columns)]
    width = 2 * _MARGIN + sum(widths) + (columns - 1) * _GAP
    drawing = Drawing(width, 0, title)
    y = _MARGIN + 14
    drawing.add(Text(title, _MARGIN, y, 17))
    for line in lines:
        y += _LINE + 2
        drawing.add(Text(line, _MARGIN, y, _SIZE + 1, "left", _FAINT))
    y += 10
    for row in rows:
        above = _LINE + 2 if any(tile.above for tile in row) else 4
        below = _LINE * max(len(tile.below) for tile in row)
        height = max(tile.pixels.shape[0] for tile in row)
        x = _MARGIN
        for tile, room in zip(row, widths, strict=False):
            drawing.add(Text(tile.above, x, y + above - 5, _SIZE))
            drawing.add(Bitmap(tile.pixels, x, y + above))
            for number, line in enumerate(tile.below):
                drawing.add(Text(line, x, y + above + height + _LINE * (number + 1) - 2, _SIZE, "left", _FAINT))
            x += room + _GAP
        y += above + height + below + 10
    drawing.height = y + _MARGIN - 10
    return drawing


def enlarged_pixels(pixels: NDArray[np.uint8], factor: int) -> NDArray[np.uint8]:
    """Each pixel of uint8[h, w, 3] as a square of ``factor`` pixels."""
    return np.repeat(np.repeat(pixels, factor, axis=0), factor, axis=1)
