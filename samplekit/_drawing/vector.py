"""A drawing as SVG text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

from samplekit._drawing.drawing import PAPER, Band, Disks, Drawing, Item, Line, Text
from samplekit.files._images.metadata import encode

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

_ANCHORS = {"left": "start", "center": "middle", "right": "end"}
_FONTS = "Droid Sans, Noto Sans, DejaVu Sans, Helvetica, Arial, sans-serif"


def svg_text(drawing: Drawing, metadata: Mapping[str, Any]) -> str:
    """Return the drawing as SVG, with ``metadata`` as JSON in the element ``metadata``; bitmaps have no place in it."""
    width, height = drawing.width, drawing.height
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}"',
        f'role="img" font-family="{_FONTS}">',
        f"<title>{_escaped(drawing.title)}</title>",
        f'<metadata id="samplekit">{_escaped(encode(metadata))}</metadata>',
        f'<rect width="{width}" height="{height}" fill="{PAPER}"/>',
        *(_element(item) for item in drawing.items),
        "</svg>\n",
    ]
    return "\n".join(lines)


def _element(item: Item) -> str:
    if isinstance(item, Text):
        return (
            f'<text x="{_number(item.x)}" y="{_number(item.y)}" font-size="{item.size}" '
            f'text-anchor="{_ANCHORS[item.align]}" fill="{item.colour}">{_escaped(item.text)}</text>'
        )
    if isinstance(item, Line):
        dashes = ' stroke-dasharray="5 4"' if item.dashed else ""
        return (
            f'<path d="{_path(item.points)}" fill="none" stroke="{item.colour}" '
            f'stroke-width="{_number(item.width)}" stroke-linejoin="round"{dashes}/>'
        )
    if isinstance(item, Band):
        there = zip(item.x, item.high, strict=True)
        back = zip(item.x[::-1], item.low[::-1], strict=True)
        return f'<path d="{_path([*there, *back])}Z" fill="{item.colour}"/>'
    if isinstance(item, Disks):
        circles = "".join(
            f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(item.radius)}"/>' for x, y in item.centres
        )
        return f'<g fill="{item.colour}">{circles}</g>'
    raise TypeError("a bitmap cannot be drawn as SVG")


def _path(points: Iterable[Any]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _number(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".")


def _escaped(text: str) -> str:
    return escape("".join(letter if letter.isprintable() else "?" for letter in text))
