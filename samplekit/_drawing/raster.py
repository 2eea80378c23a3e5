"""A drawing as pixels: lines and areas with smooth edges, letters in the font of the other pictures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import PAPER, Band, Bitmap, Disks, Drawing, Line, Text, rgb
from samplekit.files._images.text import Label, draw, printable

if TYPE_CHECKING:
    from numpy.typing import NDArray

_DASH, _GAP = 5.0, 4.0
_DISKS = 1 << 14


def draw_pixels(drawing: Drawing, scale: int = 1) -> NDArray[np.uint8]:
    """Return the pixels uint8[h, w, 3], encoded as sRGB, ``scale`` to a unit."""
    pixels = np.empty((drawing.height * scale, drawing.width * scale, 3), np.uint8)
    pixels[:] = rgb(PAPER)
    texts = []
    for item in drawing.items:
        if isinstance(item, Text):
            texts.append(item)
        elif isinstance(item, Line):
            _draw_line(pixels, item, scale)
        elif isinstance(item, Band):
            _draw_band(pixels, item, scale)
        elif isinstance(item, Disks):
            _draw_disks(pixels, item, scale)
        else:
            _draw_bitmap(pixels, item, scale)
    return _draw_texts(pixels, texts, scale)


def _draw_texts(pixels: NDArray[np.uint8], texts: list[Text], scale: int) -> NDArray[np.uint8]:
    for size, colour in sorted({(text.size, text.colour) for text in texts}):
        labels = [
            Label(printable(text.text), round(scale * text.x), round(scale * text.y), text.align)
            for text in texts
            if (text.size, text.colour) == (size, colour)
        ]
        red, green, blue = (component / 255 for component in rgb(colour))
        pixels = draw(pixels, labels, scale * size, (red, green, blue))
    return pixels


def _draw_bitmap(pixels: NDArray[np.uint8], item: Bitmap, scale: int) -> None:
    enlarged = np.repeat(np.repeat(item.pixels, scale, axis=0), scale, axis=1)
    height, width, _ = enlarged.shape
    pixels[scale * item.y : scale * item.y + height, scale * item.x : scale * item.x + width] = enlarged


def _draw_line(pixels: NDArray[np.uint8], line: Line, scale: int) -> None:
    """Blend the union of all segments: a pixel is covered as much as by the segment that covers most of it."""
    points = _dashes(line.points) if line.dashed else [line.points]
    height, width, _ = pixels.shape
    coverage = np.zeros((height, width))
    radius = max(scale * line.width, 1.0) / 2.0
    for polyline in points:
        for (x0, y0), (x1, y1) in zip(scale * polyline[:-1], scale * polyline[1:], strict=True):
            left, right = math.floor(min(x0, x1) - radius - 1), math.ceil(max(x0, x1) + radius + 1)
            top, bottom = math.floor(min(y0, y1) - radius - 1), math.ceil(max(y0, y1) + radius + 1)
            left, right, top, bottom = max(left, 0), min(right, width), max(top, 0), min(bottom, height)
            if left >= right or top >= bottom:
                continue
            # Straight lines along an axis are drawn on whole pixels.
            shift = 0.5 if (x0 == x1 or y0 == y1) and scale == 1 else 0.0
            x = np.arange(left, right) + 0.5 - (math.floor(x0) + shift if x0 == x1 and shift else x0)
            y = np.arange(top, bottom)[:, None] + 0.5 - (math.floor(y0) + shift if y0 == y1 and shift else y0)
            dx, dy = x1 - x0, y1 - y0
            length = dx * dx + dy * dy
            along = np.clip((x * dx + y * dy) / length, 0.0, 1.0) if length > 0 else 0.0
            distance = np.hypot(x - along * dx, y - along * dy)
            window = coverage[top:bottom, left:right]
            np.maximum(window, np.clip(radius + 0.5 - distance, 0.0, 1.0), out=window)
    _blend(pixels, coverage, line.colour)


def _dashes(points: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Cut a straight line into dashes."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    length = math.hypot(x1 - x0, y1 - y0)
    direction = np.array([x1 - x0, y1 - y0]) / max(length, 1e-9)
    starts = np.arange(0.0, length, _DASH + _GAP)
    return [points[0] + np.array([[start], [min(start + _DASH, length)]]) * direction for start in starts]


def _draw_band(pixels: NDArray[np.uint8], band: Band, scale: int) -> None:
    """Cover each column of pixels between the two curves at its middle."""
    height, width, _ = pixels.shape
    coverage = np.zeros((height, width))
    first, last = math.floor(scale * band.x[0]), math.ceil(scale * band.x[-1])
    columns = np.arange(max(first, 0), min(last, width))
    middle = (columns + 0.5) / scale
    edges = [np.interp(middle, band.x, side) * scale for side in (band.low, band.high)]
    top, bottom = np.minimum(*edges), np.maximum(*edges)
    rows = np.arange(height)[:, None]
    coverage[:, columns] = np.clip(np.minimum(rows + 1.0, bottom) - np.maximum(rows, top), 0.0, 1.0)
    _blend(pixels, coverage, band.colour)


def _draw_disks(pixels: NDArray[np.uint8], disks: Disks, scale: int) -> None:
    """Blend the union of the disks: a pixel is covered as much as by the disk that covers most of it."""
    height, width, _ = pixels.shape
    coverage = np.zeros((height, width))
    radius = scale * disks.radius
    reach = math.ceil(radius) + 1
    steps = np.arange(-reach, reach + 1)
    for start in range(0, len(disks.centres), _DISKS):
        centres = scale * disks.centres[start : start + _DISKS]
        # Pixel i is the interval [i, i + 1]: its middle is half a pixel on.
        x, y = (np.floor(centres[:, axis, None]).astype(np.int64) + steps for axis in (0, 1))
        squares = (x + 0.5 - centres[:, 0, None])[:, None, :] ** 2 + (y + 0.5 - centres[:, 1, None])[:, :, None] ** 2
        covered = np.clip(radius + 0.5 - np.sqrt(squares), 0.0, 1.0)
        inside = ((y >= 0) & (y < height))[:, :, None] & ((x >= 0) & (x < width))[:, None, :]
        places = (y[:, :, None] * width + x[:, None, :])[inside]
        np.maximum.at(coverage.reshape(-1), places, covered[inside])
    _blend(pixels, coverage, disks.colour)


def _blend(pixels: NDArray[np.uint8], coverage: NDArray[np.float64], colour: str) -> None:
    rows = np.flatnonzero(coverage.any(axis=1))
    if rows.size:
        part = slice(rows[0], rows[-1] + 1)
        # A line covers few of the pixels in its rows: the others are not touched.
        covered = coverage[part] > 0.0
        under = pixels[part][covered].astype(np.float64)
        share = coverage[part][covered][:, None]
        pixels[part][covered] = np.rint(under + share * (np.array(rgb(colour)) - under))
