"""A picture of points as pixels: lines on whole pixels, disks with smooth edges where the points are."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit.files._images.text import Label, draw, printable
from samplekit.files._pointsets.picture import BACKGROUND, STYLES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.files._pointsets.picture import Panel, Picture

SCALE = 2
"""Pixels for one unit of the picture: sharp on a dense screen, and still readable at half the size."""

_POINTS = 1 << 14


def draw_picture(picture: Picture) -> NDArray[np.uint8]:
    """Draw the pixels uint8[h, w, 3], encoded as sRGB, twice as many along a side as the picture has units."""
    size = math.ceil(SCALE * picture.height), math.ceil(SCALE * picture.width)
    pixels = np.empty((*size, 3), np.uint8)
    pixels[:] = _rgb(BACKGROUND)
    pixels = _write_texts(pixels, picture)
    for panel in picture.panels:
        for role, style in STYLES.items():
            if role in panel.lines:
                width = picture.stroke if role == "point" else style.width
                _draw_lines(pixels, panel.lines[role] * SCALE, max(1, round(width * SCALE)), style.colour)
        _draw_disks(pixels, panel, picture.radius)
    return pixels


def _write_texts(pixels: NDArray[np.uint8], picture: Picture) -> NDArray[np.uint8]:
    red, green, blue = (component / 255 for component in _rgb(STYLES["text"].colour))
    for size in sorted({text.size for text in picture.texts}):
        labels = [
            Label(printable(text.text), round(SCALE * text.x), round(SCALE * text.y), text.align)
            for text in picture.texts
            if text.size == size
        ]
        pixels = draw(pixels, labels, SCALE * size, (red, green, blue))
    return pixels


def _draw_lines(pixels: NDArray[np.uint8], lines: NDArray[np.float64], width: int, colour: str) -> None:
    """Fill lines float64[n, 4] along x or along y, in pixels, each ``width`` pixels wide with square ends."""
    # On whole pixels many lines become one: so a million points cost no more than the picture is wide.
    edges = np.unique(np.floor(lines - width / 2 + 0.5).astype(np.int64), axis=0)
    for x0, y0, x1, y1 in np.maximum(edges, 0).tolist():
        pixels[y0 : y1 + width, x0 : x1 + width] = _rgb(colour)


def _draw_disks(pixels: NDArray[np.uint8], panel: Panel, radius: float) -> None:
    """Blend the union of the disks: a pixel is covered as much as by the disk that covers most of it."""
    if not len(panel.disks):
        return
    reach = math.ceil(SCALE * radius) + 1
    left, top = (int(SCALE * edge) - reach for edge in (panel.left, panel.top))
    width, height = (int(SCALE * side) + 2 * reach + 1 for side in (panel.width, panel.height))
    coverage = np.zeros(height * width)
    steps = np.arange(-reach, reach + 1)
    for start in range(0, len(panel.disks), _POINTS):
        centres = SCALE * panel.disks[start : start + _POINTS] - (left, top)
        whole = np.minimum(centres.astype(np.int64), (width - 1 - reach, height - 1 - reach))
        x = whole[:, 0, None] + steps
        y = whole[:, 1, None] + steps
        # Pixel i is the interval [i, i + 1]: its middle is half a pixel on.
        squares = (x + 0.5 - centres[:, 0, None])[:, None, :] ** 2 + (y + 0.5 - centres[:, 1, None])[:, :, None] ** 2
        covered = np.clip(SCALE * radius + 0.5 - np.sqrt(squares), 0.0, 1.0)
        np.maximum.at(coverage, (y[:, :, None] * width + x[:, None, :]).ravel(), covered.ravel())
    window = pixels[top : top + height, left : left + width]
    shade = coverage.reshape(height, width)[: window.shape[0], : window.shape[1], None]
    window[:] = np.rint(window + shade * (np.array(_rgb(STYLES["point"].colour)) - window))


def _rgb(colour: str) -> tuple[int, int, int]:
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)
