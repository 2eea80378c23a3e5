"""A drawing apart from any file format: areas, lines, letters and pixels, for SVG and for PNG alike.

Units are those of an SVG, a pixel at its natural size; x goes to the right and y down.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

PAPER = "#ffffff"
INK = "#2b323c"
FRAME = "#4a5361"
GRID = "#e3e6eb"
GUIDE = "#8c97a6"
CURVE = "#c2281d"
BAND = "#f0c4c0"


@dataclass(frozen=True)
class Text:
    """Letters ``size`` units high; ``x`` is their left end, center or right end (``align``), ``y`` their baseline."""

    text: str
    x: float
    y: float
    size: int = 13
    align: str = "left"
    colour: str = INK


@dataclass(frozen=True, eq=False)
class Line:
    """A polyline float64[n, 2]."""

    points: NDArray[np.float64]
    colour: str = FRAME
    width: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Band:
    """The area between two curves of y over the same x, all float64[n], x rising."""

    x: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    colour: str = BAND


@dataclass(frozen=True, eq=False)
class Bitmap:
    """Pixels uint8[h, w, 3], one to a unit, their corner at whole units."""

    pixels: NDArray[np.uint8]
    x: int
    y: int


@dataclass(frozen=True, eq=False)
class Disks:
    """Filled disks of one radius around the centres float64[n, 2]."""

    centres: NDArray[np.float64]
    radius: float
    colour: str = CURVE


Item = Text | Line | Band | Bitmap | Disks


@dataclass
class Drawing:
    """Everything, in the order of drawing."""

    width: int
    height: int
    title: str
    items: list[Item] = field(default_factory=list)

    def add(self, *items: Item) -> None:
        """Draw on top of what is there."""
        self.items.extend(items)

    def frame(self, left: float, top: float, right: float, bottom: float) -> None:
        """Draw a rectangle."""
        corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]
        self.add(Line(np.array(corners, np.float64)))

    def segment(self, x0: float, y0: float, x1: float, y1: float, colour: str, *, dashed: bool = False) -> None:
        """Draw a straight line."""
        self.add(Line(np.array([(x0, y0), (x1, y1)], np.float64), colour, 1.0, dashed))


def rgb(colour: str) -> tuple[int, int, int]:
    """Return the components of ``#rrggbb``."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def blended(colour: str, share: float) -> str:
    """Return ``#rrggbb`` mixed with white, of which it has the given share."""
    return "#" + "".join(f"{round(component + share * (255 - component)):02x}" for component in rgb(colour))


def label(value: float) -> str:
    """Write a number as it stands on an axis."""
    mantissa, e, exponent = f"{value:.4g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def round_ticks(low: float, high: float, most: int = 6) -> Sequence[float]:
    """Multiples of 1, 2 or 5 times a power of ten from ``low`` to ``high``, at most about ``most`` of them."""
    span = high - low
    if not (span > 0.0 and math.isfinite(span)):
        return [low]
    power = 10.0 ** math.floor(math.log10(span / most))
    step = next(digit * power for digit in (1.0, 2.0, 5.0, 10.0) if span / (digit * power) <= most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [round(number * step, 12) for number in range(first, last + 1)]
