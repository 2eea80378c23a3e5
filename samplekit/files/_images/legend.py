"""The strip below an error picture: colour bar, tick labels, and in words what the colours mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.files._images import diverging
from samplekit.files._images.lettering import Label, draw, fitted, printable, width
from samplekit.files._images.png import RESERVED

if TYPE_CHECKING:
    from numpy.typing import NDArray

BACKGROUND = 38
"""Grey level of the strip and of the margin beside a narrow picture: unlike any error."""

_ALIGNMENTS = {0.0: "left", 1.0: "right"}
"""How the labels at the ends of the bar lie on their ticks; those between are centred."""


def strip(title: str, phrases: list[str], invalid: int, scale: float, room: int) -> NDArray[np.uint8]:
    """Draw the strip uint8[h, room, 3] below a picture, as high as its lines need.

    Parameters
    ----------
    title
        First line, cut short if need be; empty: none.
    phrases
        What to state, on as few lines as it fits on.
    invalid
        Number of pixels that are not finite: the last phrase, behind a swatch of their colour, unless it is 0.
    scale
        The error at the ends of the colour bar; 0: no bar.
    room
        Width of the picture in pixels, at least 200.
    """
    size = min(max(round(room / 42), 13), 96)
    margin = (size + 1) // 2
    line = round(1.4 * size)
    span = room - 2 * margin
    labels: list[Label] = []
    swatches: list[tuple[int, int]] = []
    y = margin + size
    if title:
        labels.append(Label(fitted(printable(title), size, span), margin, y))
        y += line
    marked = [f"{pixel_count(invalid)} not finite"] if invalid else []
    x = margin
    for text in phrases + marked:
        indent = size + size // 3 if text in marked else 0
        need = indent + width(text, size)
        if x > margin and x + need > room - margin:
            x = margin
            y += line
        if text in marked:
            swatches.append((x, y - size + 2))
        labels.append(Label(text, x + indent, y))
        x += need + size
    top, bottom = y + line - size + margin // 2, y + margin
    ticks = _tick_places(scale, size, span) if scale > 0.0 else []
    if ticks:
        baseline = top + size + size // 3 + round(1.1 * size)
        bottom = baseline + margin
        for place in ticks:
            value, align = (2.0 * place - 1.0) * scale, _ALIGNMENTS.get(place, "center")
            labels.append(Label(number(value), margin + round(place * (span - 1)), baseline, align))
    pixels = draw(np.full((bottom, room, 3), BACKGROUND, np.uint8), labels, size)
    for x, upper in swatches:
        pixels[upper : upper + size, x : x + size] = RESERVED
    if ticks:
        _draw_bar(pixels, margin, top, size, ticks)
    return pixels


def pixel_count(pixels: int) -> str:
    """Write a number of pixels."""
    return "1 pixel" if pixels == 1 else f"{pixels} pixels"


def number(value: float) -> str:
    """Write a number as it stands on a label: ``0.05``, ``2.5e-6``."""
    mantissa, e, exponent = f"{value:.4g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _tick_places(scale: float, size: int, span: int) -> list[float]:
    """Choose the places of ticks along the bar, in [0, 1]: five, or three where five labels would touch."""
    half = scale / 2.0
    need = 2 * (width(number(-scale), size) + width(number(-half), size)) + width("0", size) + 4 * size
    return [0.0, 0.25, 0.5, 0.75, 1.0] if half > 0.0 and need <= span else [0.0, 0.5, 1.0]


def _draw_bar(pixels: NDArray[np.uint8], margin: int, top: int, size: int, places: list[float]) -> None:
    """Draw the colours of all errors, ``size`` pixels high, from margin to margin, and a tick below each place."""
    length = pixels.shape[1] - 2 * margin
    below = top + size
    pixels[top:below, margin : margin + length] = diverging.colours(np.linspace(-1.0, 1.0, length)[None], 1.0)
    thick = max(1, size // 12)
    for place in places:
        x = margin + min(max(round(place * (length - 1)) - thick // 2, 0), length - thick)
        pixels[below : below + size // 3, x : x + thick] = 230
