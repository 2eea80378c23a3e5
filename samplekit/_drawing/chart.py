"""A chart: curves, intervals and guides over a grid, in a rectangle of a drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import GRID, GUIDE, Band, Disks, Drawing, Line, Text, blended
from samplekit._drawing.series import Style, markers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from samplekit._drawing.axis import Axis

_SIZE = 12


@dataclass
class Chart:
    """A chart in the rectangle ``left`` to ``right`` and ``top`` to ``bottom``, all whole units, of a drawing.

    Letters take about 60 units on the left, 36 below and 10 above.
    """

    drawing: Drawing
    left: int
    top: int
    right: int
    bottom: int
    x: Axis
    y: Axis

    def grid(self) -> None:
        """Draw the frame, the grid, and what the axes say."""
        drawing, size = self.drawing, _SIZE
        for value, written in self.x.ticks(max(2, (self.right - self.left) // 70)):
            at = float(self._across(value))
            drawing.segment(at, self.top, at, self.bottom, GRID)
            drawing.add(Text(written, at, self.bottom + 16, size, "center"))
        for value, written in self.y.ticks(max(2, (self.bottom - self.top) // 36)):
            at = float(self._up(value))
            drawing.segment(self.left, at, self.right, at, GRID)
            drawing.add(Text(written, self.left - 6, at + 4, size, "right"))
        drawing.frame(self.left, self.top, self.right, self.bottom)
        if self.x.name:
            drawing.add(Text(self.x.name, (self.left + self.right) / 2, self.bottom + 33, size, "center"))
        if self.y.name:
            drawing.add(Text(self.y.name, self.left, self.top - 6, size))

    def curve(self, x: ArrayLike, y: ArrayLike, style: Style, *, width: float = 1.6, marked: bool = True) -> None:
        """Draw a curve through float64[n] values; what cannot be drawn leaves a gap."""
        for run in self._runs(x, y):
            if len(run) > 1:
                self.drawing.add(Line(run, style.colour, width))
            if marked:
                self.drawing.add(*markers(run, style))
            elif len(run) == 1:
                self.drawing.add(Disks(run, width, style.colour))

    def band(self, x: ArrayLike, low: ArrayLike, high: ArrayLike, style: Style) -> None:
        """Shade the intervals between ``low`` and ``high``, cut at the frame; x rising."""
        xs, lows, highs = (np.asarray(values, np.float64) for values in (x, low, high))
        lows, highs = np.maximum(lows, self.y.low), np.minimum(highs, self.y.high)
        good = np.isfinite(lows) & np.isfinite(highs) & (highs >= lows) & self._inside(self.x, xs)
        if good.sum() > 1:
            places = (self._across(xs[good]), self._up(highs[good]), self._up(lows[good]))
            self.drawing.add(Band(*places, blended(style.colour, 0.8)))

    def whiskers(self, x: ArrayLike, low: ArrayLike, high: ArrayLike, style: Style) -> None:
        """Draw each interval as a line upright, cut at the frame."""
        for at, start, end in np.broadcast(*(np.asarray(values, np.float64) for values in (x, low, high))):
            start, end = max(start, self.y.low), min(end, self.y.high)
            if start <= end and self._inside(self.x, at):
                place = self._across(at)
                self.drawing.add(Line(np.array([(place, self._up(start)), (place, self._up(end))]), style.colour, 1.2))

    def guide(self, slope: float, x: float, y: float, written: str = "") -> None:
        """Draw the law y (t / x)^slope through (x, y), dashed, over as much of two logarithmic axes as it crosses."""
        reaches = sorted(x * (edge / y) ** (1.0 / slope) for edge in (self.y.low, self.y.high)) if slope else []
        start, end = max([self.x.low, *reaches[:1]]), min([self.x.high, *reaches[1:]])
        if start >= end:
            return
        ends = np.array([start, end])
        places = np.stack([self._across(ends), self._up(y * (ends / x) ** slope)], axis=1)
        self.drawing.add(Line(places, GUIDE, 1.0, dashed=True))
        if written:
            self.drawing.add(Text(written, places[1, 0] - 4, places[1, 1] - 6, 11, "right", GUIDE))

    def level(self, y: float, written: str = "") -> None:
        """Draw the value ``y`` as a dashed line from side to side."""
        if self._inside(self.y, y):
            at = float(self._up(y))
            self.drawing.segment(self.left, at, self.right, at, GUIDE, dashed=True)
            self.drawing.add(Text(written, self.right - 4, at - 5, 11, "right", GUIDE))

    def _runs(self, x: ArrayLike, y: ArrayLike) -> Sequence[NDArray[np.float64]]:
        xs, ys = np.asarray(x, np.float64), np.asarray(y, np.float64)
        good = self._inside(self.x, xs) & self._inside(self.y, ys)
        starts = np.flatnonzero(np.diff(good.astype(np.int8), prepend=0) == 1)
        ends = np.flatnonzero(np.diff(good.astype(np.int8), append=0) == -1) + 1
        return [
            np.stack([self._across(xs[start:end]), self._up(ys[start:end])], axis=1)
            for start, end in zip(starts, ends, strict=True)
        ]

    def _across(self, values: ArrayLike) -> NDArray[np.float64]:
        return self.left + self.x.share(values) * (self.right - self.left)

    def _up(self, values: ArrayLike) -> NDArray[np.float64]:
        return self.bottom - self.y.share(values) * (self.bottom - self.top)

    @staticmethod
    def _inside(axis: Axis, values: ArrayLike) -> NDArray[np.bool_]:
        array = np.asarray(values, np.float64)
        return np.asarray((array >= axis.low) & (array <= axis.high))


def legend(drawing: Drawing, x: float, y: float, entries: Sequence[tuple[str, Style]], line: int = 18) -> None:
    """Name the curves, one below the other; ``y`` is the middle of the first line."""
    for number, (name, style) in enumerate(entries):
        at = y + line * number
        drawing.add(Line(np.array([(x, at), (x + 22.0, at)]), style.colour, 1.6))
        drawing.add(*markers(np.array([(x + 11.0, at)]), style))
        drawing.add(Text(name, x + 30, at + 4, _SIZE))
