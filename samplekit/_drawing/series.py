"""How the curves of a chart are told apart: a colour that all eyes can tell from the others, and a marker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import Disks, Line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._drawing.drawing import Item

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b5b00", "#2b323c")
"""Okabe and Ito 2008, "Color Universal Design", their yellow darkened for white paper."""

MARKERS = ("disk", "square", "triangle", "diamond", "cross", "plus", "point-down")
_CORNERS: dict[str, list[tuple[float, float]]] = {
    "square": [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)],
    "triangle": [(0, -1.2), (1.1, 0.9), (-1.1, 0.9), (0, -1.2)],
    "diamond": [(0, -1.4), (1.4, 0), (0, 1.4), (-1.4, 0), (0, -1.4)],
    "point-down": [(0, 1.2), (1.1, -0.9), (-1.1, -0.9), (0, 1.2)],
}
_STROKES: dict[str, list[list[tuple[float, float]]]] = {
    "cross": [[(-1, -1), (1, 1)], [(-1, 1), (1, -1)]],
    "plus": [[(-1.3, 0), (1.3, 0)], [(0, -1.3), (0, 1.3)]],
}


@dataclass(frozen=True)
class Style:
    """The colour and the marker of a curve."""

    colour: str
    marker: str


def style(number: int) -> Style:
    """The style of curve ``number``, from 0; 56 are different."""
    return Style(COLOURS[number % len(COLOURS)], MARKERS[number % len(MARKERS)])


def markers(centres: NDArray[np.float64], chosen: Style, radius: float = 3.0) -> list[Item]:
    """Markers at the centres float64[n, 2]."""
    if chosen.marker == "disk":
        return [Disks(centres, radius, chosen.colour)]
    strokes = _STROKES.get(chosen.marker) or [_CORNERS[chosen.marker]]
    return [
        Line(centre + radius * np.array(stroke, np.float64), chosen.colour, 1.5)
        for centre in centres
        for stroke in strokes
    ]
