"""Heat maps: for each sampler the digits that are right over scale and count, and below those that summation lost."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import FRAME, INK, Bitmap, Drawing, Text, blended, rgb

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._stability.sweep import Cell
    from samplekit._stability.verdict import Kind

_CELL_WIDTH, _CELL_HEIGHT = 62, 20
_RIGHT, _LOST = "#1f5fa8", "#c2281d"
_MOST_RIGHT, _MOST_LOST = 16.0, 3.0
_COLOURS: dict[Kind, str] = {
    "no hits": "#b9bec6",
    "few hits": "#dadde2",
    "refused": "#f4f4f4",
    "invalid": "#ff00ff",
    "wrong": "#ff00ff",
}
"""Of cells that have no digits to show."""
_SHORT: dict[Kind, str] = {
    "right": "",
    "no hits": "no hits",
    "few hits": "few hits",
    "infinite variance": "~",
    "precision lost": "!",
    "not random": "=",
    "invalid": "invalid",
    "refused": "-",
    "wrong": "wrong",
}
_LEGEND = (
    "digits of one estimate that are right, 0 to 16;  ~ the variance is infinite: no standard error",
    "! rounding exceeds the error of sampling;  = the sampler is not random: one set, no standard error",
    "no hits: every sample missed, nothing has converged;  few hits: beyond 4 standard errors, under 100 hits",
    "below: digits that summation lost of those that one rounding leaves, 0 to 3",
)


def heat_map(name: str, cells: Sequence[Cell], title: str) -> Drawing:
    """Draw the cells of one scene.

    Parameters
    ----------
    name
        The scene's.
    cells
        All of its cells, in the sweep's order.
    title
        First line.
    """
    extremes = list(dict.fromkeys(cell.extreme for cell in cells))
    samplers = list(dict.fromkeys(cell.sampler for cell in cells))
    counts = sorted({cell.count for cell in cells})
    by_place = {(cell.extreme, cell.sampler, cell.count): cell for cell in cells}
    margin = 24
    label = max(_width(text or name) for text in extremes) + 12
    panel = _CELL_WIDTH * len(counts) + 16
    block = _CELL_HEIGHT * len(extremes) + 58
    width = max(margin * 2 + label + panel * len(samplers), margin * 2 + _width(_LEGEND[2]))
    top = 56 + 18 * len(_LEGEND)
    drawing = Drawing(width, top + 2 * block + 8, title)
    drawing.add(Text(title, margin, 30, 17))
    for line, text in enumerate(_LEGEND):
        drawing.add(Text(text, margin, 54 + 18 * line, 12))
    for half, of in enumerate((_right, _lost)):
        upper = top + half * block
        for column, sampler in enumerate(samplers):
            left = margin + label + column * panel
            drawing.add(Text(sampler if not half else f"{sampler}: lost", left, upper + 12, 13))
            for across, count in enumerate(counts):
                middle = left + _CELL_WIDTH * (across + 0.5)
                drawing.add(Text(_count(count), middle, upper + 30, 11, "center", FRAME))
                for down, extreme in enumerate(extremes):
                    y = upper + 36 + down * _CELL_HEIGHT
                    colour, text = of(by_place[extreme, sampler, count])
                    _fill(drawing, left + across * _CELL_WIDTH, y, colour)
                    ink = "#ffffff" if sum(rgb(colour)) < 430 else INK
                    drawing.add(Text(text, middle, y + 14, 11, "center", ink))
        for down, extreme in enumerate(extremes):
            drawing.add(Text(extreme or name, margin, upper + 50 + down * _CELL_HEIGHT, 12))
    return drawing


def _right(cell: Cell) -> tuple[str, str]:
    """Colour and text of the digits that are right."""
    kind, short = cell.verdict.kind, _SHORT[cell.verdict.kind]
    if kind in _COLOURS or cell.measured is None:
        return _COLOURS.get(kind, "#f4f4f4"), short
    digits = cell.measured.digits_right
    return _shade(_RIGHT, digits / _MOST_RIGHT), f"{digits:.1f}{short}"


def _lost(cell: Cell) -> tuple[str, str]:
    """Colour and text of the digits that are lost."""
    if cell.measured is None or cell.verdict.kind == "invalid":
        return _COLOURS.get(cell.verdict.kind, "#f4f4f4"), _SHORT[cell.verdict.kind]
    digits = cell.measured.digits_lost
    return _shade(_LOST, digits / _MOST_LOST), f"{digits:.1f}"


def _shade(colour: str, share: float) -> str:
    return blended(colour, 1.0 - min(max(share, 0.0), 1.0))


def _fill(drawing: Drawing, x: int, y: int, colour: str) -> None:
    pixels = np.empty((_CELL_HEIGHT - 1, _CELL_WIDTH - 1, 3), np.uint8)
    pixels[:] = rgb(colour)
    drawing.add(Bitmap(pixels, x, y))


def _count(count: int) -> str:
    exponent = count.bit_length() - 1
    return f"2^{exponent}" if count == 2**exponent and exponent > 9 else f"{count}"


def _width(text: str) -> int:
    return 7 * len(text)
