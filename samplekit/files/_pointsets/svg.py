"""A picture of points as SVG: text, the same bytes for the same points, to be opened by any browser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

from samplekit.files._images.metadata import encode
from samplekit.files._pointsets.picture import BACKGROUND, STYLES

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from samplekit.files._pointsets.picture import Panel, Picture

_ANCHORS = {"left": "start", "center": "middle", "right": "end"}
_FONTS = "Droid Sans, Noto Sans, DejaVu Sans, Helvetica, Arial, sans-serif"
_ROWS = 1 << 14


def svg_text(picture: Picture, metadata: Mapping[str, Any]) -> Iterator[str]:
    """Give the picture as SVG in pieces; ``metadata`` is stored as JSON in the element ``metadata``.

    Raises
    ------
    SamplekitError
        The metadata is no JSON.
    """
    width, height = _number(picture.width), _number(picture.height)
    title = _escaped(picture.title)
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" role="img">\n'
        f'<title>{title}</title>\n<metadata id="samplekit">{_escaped(encode(metadata))}</metadata>\n'
        f'<rect width="{width}" height="{height}" fill="{BACKGROUND}"/>\n'
        f'<g fill="{STYLES["text"].colour}" font-family="{_FONTS}">\n'
    )
    for text in picture.texts:
        place = (
            f'x="{_number(text.x)}" y="{_number(text.y)}" font-size="{text.size}" text-anchor="{_ANCHORS[text.align]}"'
        )
        yield f"<text {place}>{_escaped(text.text)}</text>\n"
    yield "</g>\n"
    for panel in picture.panels:
        yield from _panel(panel, picture)
    yield "</svg>\n"


def _panel(panel: Panel, picture: Picture) -> Iterator[str]:
    yield f'<g id="{"-".join(f"x{axis}" for axis in panel.axes)}">\n'
    for role, style in STYLES.items():
        lines = panel.lines.get(role)
        if lines is None or not len(lines):
            continue
        # Lines on whole pixels; the points of one dimension where they are.
        edges = "" if role == "point" else ' shape-rendering="crispEdges"'
        width = picture.stroke if role == "point" else style.width
        stroke = f'stroke="{style.colour}" stroke-width="{_number(width)}" stroke-linecap="square"{edges}'
        yield f'<path class="{role}" {stroke} d="'
        for start in range(0, len(lines), _ROWS):
            rows = lines[start : start + _ROWS].tolist()
            yield "".join(f"M{_number(a)} {_number(b)}L{_number(c)} {_number(d)}" for a, b, c, d in rows)
        yield '"/>\n'
    if len(panel.disks):
        yield f'<g class="points" fill="{STYLES["point"].colour}">\n'
        radius = _number(picture.radius)
        for start in range(0, len(panel.disks), _ROWS):
            rows = panel.disks[start : start + _ROWS].tolist()
            yield "".join(f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{radius}"/>\n' for x, y in rows)
        yield "</g>\n"
    yield "</g>\n"


def _number(value: float) -> str:
    """Round to three decimals: a five-hundredth of a pixel even when it is enlarged twice."""
    return f"{value:.3f}".rstrip("0").rstrip(".")


def _escaped(text: str) -> str:
    # XML has no place for control characters, not even escaped ones.
    return escape("".join(letter if letter.isprintable() else "?" for letter in text))
