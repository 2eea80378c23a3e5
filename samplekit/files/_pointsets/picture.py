"""A picture of a point set, apart from any file format: where each line, point and letter goes.

One dimension is a line of ticks, two are a square, more are the squares of all pairs in a lower triangle. Units are
those of an SVG, a pixel at its natural size; x goes to the right and y down, as in the domain of the points.
"""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._pointsets.grids import describe_grids, grid_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from samplekit._specs import Promise
    from samplekit.files._pointsets.grids import Grid

MOST_DIMS = 16
LINES_UP_TO = 64
"""Intervals of an axis that are drawn as lines across; more of them are ticks beside it."""

_MARGIN, _GAP, _LABELS = 28, 22, 20
_TITLE, _CAPTION, _LABEL = 15, 12, 12
_LETTER = 0.6
"""Width of a letter as a part of its size, on the safe side: the layout knows no font."""
_TICK = 5
_LEAST_BOLD, _LEAST_CELL, _LEAST_INTERVAL, _LEAST_TICK = 12.0, 5.0, 3.0, 1.5
"""Units between lines below which they are drawn thinner, then as ticks, then not at all: no picture is a grey mass."""


class Style(NamedTuple):
    """A colour as ``#rrggbb`` and a width in units."""

    colour: str
    width: float


BACKGROUND = "#ffffff"
STYLES = {
    "faint": Style("#e3e6eb", 1.0),
    "fine": Style("#b9c2ce", 0.5),
    "strong": Style("#a9b3c1", 1.0),
    "tick": Style("#8c97a6", 0.5),
    "frame": Style("#4a5361", 1.0),
    "text": Style("#2b323c", 0.0),
    "point": Style("#c2281d", 0.0),
}
"""By role, in the order of drawing."""


class Text(NamedTuple):
    """Letters ``size`` units high; ``x`` is their left end, center or right end (``align``), ``y`` their baseline."""

    text: str
    x: float
    y: float
    size: int
    align: str = "left"


@dataclass(frozen=True, eq=False)
class Panel:
    """The projection on one dimension or two.

    Attributes
    ----------
    axes
        The dimensions: along x, and along y.
    left, top, width, height
        Its place in the picture.
    lines
        By role, float64[n, 4]: both ends x0, y0, x1, y1 of lines along x or along y. The points of one dimension are
        among them.
    disks
        float64[N, 2]: the centres of the points.
    """

    axes: tuple[int, ...]
    left: float
    top: float
    width: float
    height: float
    lines: Mapping[str, NDArray[np.float64]]
    disks: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Picture:
    """All that is drawn. ``radius``: of the disks; ``stroke``: width of a point that is a line."""

    width: float
    height: float
    title: str
    radius: float
    stroke: float
    texts: Sequence[Text]
    panels: Sequence[Panel]


def make_picture(points: NDArray[np.float64], promises: Sequence[Promise], title: str) -> Picture:
    """Lay out the picture of one set.

    Parameters
    ----------
    points
        float64[N, D] in [0, 1], N at least 1.
    promises
        What the sampler promises of such sets: its grids are drawn.
    title
        Stands above.

    Raises
    ------
    UsageError
        More than 16 dimensions, or values outside [0, 1].
    """
    count, dims = points.shape
    check_dims(dims)
    if not (points.min() >= 0.0 and points.max() <= 1.0):
        raise UsageError("a picture shows points in [0, 1]: there are others, or NaN")
    side = 640 if dims == 1 else 512 if dims == 2 else min(300, max(96, 760 // (dims - 1)))
    columns = max(dims - 1, 1)
    width = 2 * (_MARGIN + _LABELS) + columns * side + (columns - 1) * _GAP
    caption = describe_grids(promises, count, dims)
    texts, y = _heading(title, f"strata: {caption}" if caption else "", width)
    left, top = _MARGIN + _LABELS, y + _LABELS + _TICK
    panels = []
    if dims == 1:
        height = 72
        panels.append(_strip(points[:, 0], grid_of(promises, count, dims, (0,)), left, top, side, height))
    else:
        height = columns * side + (columns - 1) * _GAP
        for y_axis in range(1, dims):
            for x_axis in range(y_axis):
                grid = grid_of(promises, count, dims, (x_axis, y_axis))
                corner = left + x_axis * (side + _GAP), top + (y_axis - 1) * (side + _GAP)
                panels.append(_square(points[:, [x_axis, y_axis]], grid, (x_axis, y_axis), *corner, side))
    for panel in panels:
        texts += _labels(panel, ends=dims <= 2)
    spacing = side / math.sqrt(count)
    radius = min(max(0.18 * spacing, 0.4), max(side / 100, 1.6))
    stroke = min(max(0.3 * side / count, 0.5), 2.0)
    return Picture(width, top + height + _MARGIN, title, radius, stroke, texts, panels)


def check_dims(dims: int) -> None:
    """Raise if a picture cannot show so many dimensions.

    Raises
    ------
    UsageError
        More than 16.
    """
    if dims > MOST_DIMS:
        raise UsageError(f"a picture shows at most {MOST_DIMS} dimensions, not {dims}: write .csv or .npy")


def _heading(title: str, caption: str, width: float) -> tuple[list[Text], float]:
    """Place the lines above the panels; the second value is the lower edge of the last."""
    texts: list[Text] = []
    y: float = _MARGIN - 10
    for text, size in ((title, _TITLE), (caption, _CAPTION)):
        letters = int((width - 2 * _MARGIN - _LABELS) / (_LETTER * size))
        for line in textwrap.wrap(text, letters):
            y += 1.35 * size
            texts.append(Text(line, _MARGIN + _LABELS, round(y), size))
    return texts, round(y) + 4


def _labels(panel: Panel, *, ends: bool) -> list[Text]:
    """Names of the axes above the first panel of a column and left of the first of a row; 0 and 1 at their ends."""
    right, bottom, above = panel.left + panel.width, panel.top + panel.height, panel.top - _TICK - 4
    texts = []
    if len(panel.axes) == 1 or panel.axes[1] == panel.axes[0] + 1:
        texts.append(Text(f"x{panel.axes[0]}", panel.left + panel.width / 2, above, _LABEL, "center"))
        if ends:
            texts += [Text("0", panel.left, above, _LABEL, "center"), Text("1", right, above, _LABEL, "center")]
    if len(panel.axes) == 2 and panel.axes[0] == 0:
        beside = panel.left - _TICK - 4
        texts.append(Text(f"x{panel.axes[1]}", beside, panel.top + panel.height / 2 + 4, _LABEL, "right"))
        if ends:
            texts += [Text("0", beside, panel.top + 9, _LABEL, "right"), Text("1", beside, bottom, _LABEL, "right")]
    return texts


def _square(
    points: NDArray[np.float64], grid: Grid, axes: tuple[int, ...], left: float, top: float, side: float
) -> Panel:
    origin = np.array([left, top])
    lines: dict[str, list[NDArray[np.float64]]] = {"faint": [], "fine": [], "strong": [], "tick": []}
    for axis in (0, 1):
        for role, places in _rules(grid.cells[axis], grid.intervals[axis], side).items():
            span = (-_TICK, 0) if role == "tick" else (0, side)
            lines[role].append(_across(places * side, span, axis) + np.tile(origin, 2))
    right, bottom = left + side, top + side
    frame = [
        [left, top, right, top],
        [left, bottom, right, bottom],
        [left, top, left, bottom],
        [right, top, right, bottom],
    ]
    stacked = {role: np.concatenate(parts) for role, parts in lines.items() if parts} | {
        "frame": np.array(frame, np.float64)
    }
    return Panel(axes, left, top, side, side, stacked, origin + points * side)


def _strip(points: NDArray[np.float64], grid: Grid, left: float, top: float, width: float, height: float) -> Panel:
    lines = {
        role: _across(left + places * width, (top - _TICK, top) if role == "tick" else (top, top + height), 0)
        for role, places in _rules(1, grid.intervals[0], width).items()
    }
    right, bottom = left + width, top + height
    lines["frame"] = np.array(
        [[left, bottom, right, bottom], [left, top, left, bottom], [right, top, right, bottom]], np.float64
    )
    lines["point"] = _across(left + points * width, (top + height / 4, bottom), 0)
    return Panel((0,), left, top, width, height, lines, np.empty((0, 2)))


def _rules(cells: int, intervals: int, side: float) -> dict[str, NDArray[np.float64]]:
    """Places in (0, 1) of the lines between cells and between intervals of one axis, by role."""
    rules = {}
    if cells > 1 and side / cells >= _LEAST_TICK:
        role = "strong" if side / cells >= _LEAST_BOLD else "fine" if side / cells >= _LEAST_CELL else "tick"
        rules[role] = np.arange(1, cells) / cells
    if intervals > 1 and side / intervals >= _LEAST_TICK:
        numbers = np.arange(1, intervals)
        role = "faint" if intervals <= LINES_UP_TO and side / intervals >= _LEAST_INTERVAL else "tick"
        # A line of both is drawn once, as the stronger.
        drawn = role == "faint" and bool(rules.keys() & {"strong", "fine"})
        rules[role] = numbers[numbers * cells % intervals != 0] / intervals if drawn else numbers / intervals
    return rules


def _across(places: NDArray[np.float64], span: tuple[float, float], axis: int) -> NDArray[np.float64]:
    """Lines float64[n, 4] at places along ``axis`` (0: x), each across the span of the other axis."""
    low, high = np.full(places.size, span[0], np.float64), np.full(places.size, span[1], np.float64)
    return np.stack([places, low, places, high] if axis == 0 else [low, places, high, places], axis=1)
