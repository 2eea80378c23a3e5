"""The strip below an error picture: colour bar, tick labels, and in words what the colours mean."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from samplekit.files._images import diverging
from samplekit.files._images.png import RESERVED
from samplekit.files._images.text import Label, draw, fitted, printable, width

if TYPE_CHECKING:
    from numpy.typing import NDArray

BACKGROUND = 38
"""Grey level of the strip and of the margin beside a narrow picture: unlike any error."""

_INK = (0.9, 0.9, 0.9)


class Facts(NamedTuple):
    """The facts that the strip states.

    ``scale`` is the error at the ends of the bar (0: no bar), ``largest`` the largest |error|, ``beyond`` and
    ``invalid`` the numbers of pixels past the scale and not finite, ``enlarged`` the side in pixels of one pixel of
    the image.
    """

    title: str
    scale: float
    largest: float
    beyond: int
    invalid: int
    pixels: int
    enlarged: int


def strip(facts: Facts, room: int) -> NDArray[np.uint8]:
    """Draw the strip uint8[h, room, 3] for a picture ``room`` pixels wide (at least 200): as high as its lines need."""
    size = min(max(round(room / 42), 13), 96)
    margin = (size + 1) // 2
    line = round(1.4 * size)
    labels: list[Label] = []
    swatches: list[tuple[int, int]] = []
    y = margin + size
    if facts.title:
        labels.append(Label(fitted(printable(facts.title), size, room - 2 * margin), margin, y))
        y += line
    for texts in _flow(_phrases(facts), size, room - 2 * margin):
        x = margin
        for text, has_swatch in texts:
            if has_swatch:
                swatches.append((x, y - size + 2))
                x += size + size // 3
            labels.append(Label(text, x, y))
            x += width(text, size) + size
        y += line
    bar_top, bar_height = y - size + margin // 2, size
    if facts.scale > 0.0:
        ticks = _ticks(facts.scale, size, room - 2 * margin)
        baseline = bar_top + bar_height + size // 3 + round(1.1 * size)
        labels += [
            Label(text, margin + round(place * (room - 2 * margin - 1)), baseline, align)
            for place, text, align in ticks
        ]
        bottom = baseline + margin
    else:
        ticks, bottom = [], y - line + margin
    pixels = np.full((bottom, room, 3), BACKGROUND, np.uint8)
    pixels = draw(pixels, labels, size, _INK)
    for x, top in swatches:
        pixels[top : top + size, x : x + size] = RESERVED
    if ticks:
        _draw_bar(pixels, margin, bar_top, bar_height, size, [place for place, _, _ in ticks])
    return pixels


def number(value: float) -> str:
    """Write a number as it stands on a label: ``0.05``, ``2.5e-6``."""
    mantissa, e, exponent = f"{value:.4g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _phrases(facts: Facts) -> list[tuple[str, bool]]:
    """List what to state, each with whether a swatch of the reserved colour goes before it."""
    finite = "every finite error" if facts.invalid else "every error"
    if facts.invalid == facts.pixels:
        phrases = ["error = image - reference", "scale 0: no finite error"]
    elif facts.largest == 0.0:
        phrases = ["error = image - reference", f"exact: {finite} is 0"]
        phrases.append(f"scale ±{number(facts.scale)}" if facts.scale > 0.0 else "scale 0")
    else:
        phrases = [
            "error = image - reference",
            f"scale ±{number(facts.scale)}",
            f"largest |error| {number(facts.largest)}",
        ]
    if facts.beyond:
        phrases.append(f"{_count(facts.beyond)} beyond the scale")
    if facts.enlarged > 1:
        phrases.append(f"1 pixel shown as {facts.enlarged} x {facts.enlarged}")
    marked = [(f"{_count(facts.invalid)} not finite", True)] if facts.invalid else []
    return [(text, False) for text in phrases] + marked


def _count(pixels: int) -> str:
    return "1 pixel" if pixels == 1 else f"{pixels} pixels"


def _flow(phrases: list[tuple[str, bool]], size: int, room: int) -> list[list[tuple[str, bool]]]:
    """Phrases on as few lines as they fit on."""
    lines: list[list[tuple[str, bool]]] = [[]]
    used = 0
    for text, has_swatch in phrases:
        need = width(text, size) + (size + size // 3 if has_swatch else 0)
        if lines[-1] and used + size + need > room:
            lines.append([])
            used = 0
        used += need + (size if lines[-1] else 0)
        lines[-1].append((text, has_swatch))
    return lines


def _ticks(scale: float, size: int, room: int) -> list[tuple[float, str, str]]:
    """Place in [0, 1], text and alignment of each tick: five, or three where five labels would touch."""
    ends = [(0.0, number(-scale), "left"), (0.5, "0", "center"), (1.0, number(scale), "right")]
    half = scale / 2.0
    between = [(0.25, number(-half), "center"), (0.75, number(half), "center")]
    need = 2 * width(number(-scale), size) + width(number(-half), size) * 2 + width("0", size) + 4 * size
    return sorted(ends + between) if half > 0.0 and need <= room else ends


def _draw_bar(pixels: NDArray[np.uint8], margin: int, top: int, height: int, size: int, places: list[float]) -> None:
    length = pixels.shape[1] - 2 * margin
    pixels[top : top + height, margin : margin + length] = diverging.colours(np.linspace(-1.0, 1.0, length)[None], 1.0)
    thick = max(1, size // 12)
    for place in places:
        x = margin + min(max(round(place * (length - 1)) - thick // 2, 0), length - thick)
        pixels[top + height : top + height + size // 3, x : x + thick] = 230
