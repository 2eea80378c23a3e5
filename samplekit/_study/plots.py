"""Error against count and error against time, a plot for each scene, with intervals and guide lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.axis import spanning
from samplekit._drawing.chart import Chart, legend
from samplekit._drawing.drawing import Drawing, Text
from samplekit._drawing.series import style

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._drawing.axis import Axis
    from samplekit._study.results import Results, Row

    Array = NDArray[np.float64]

_WIDTH, _RIGHT, _TOP, _HEIGHT = 860, 590, 76, 560
_SLOPES = (-1.0, -1.5, -2.0, -3.0)


def plots_of(results: Results) -> dict[str, Drawing]:
    """The drawings of a study by the ends of their names."""
    drawings = {}
    for scene in results.scenes:
        rows = [row for row in results.rows if row.scene == scene and row.mse.estimate]
        if not rows:
            continue
        name = file_name(scene)
        drawings[f"{name}.error-against-count"] = _plot(results, scene, rows, "samples", _count)
        timed = [row for row in rows if row.time]
        if timed:
            axis = "seconds" if results.size == (1, 1) else "seconds for an image"
            drawings[f"{name}.error-against-time"] = _plot(results, scene, timed, axis, _seconds)
    return drawings


def file_name(text: str) -> str:
    """A scene or sampler as a part of a file's name."""
    return text.replace(":", "-").replace("/", "-").replace("\\", "-")


def _count(row: Row) -> float:
    return float(row.count)


def _seconds(row: Row) -> float:
    return row.time or 0.0


def _plot(results: Results, scene: str, rows: list[Row], across: str, place: Callable[[Row], float]) -> Drawing:
    against = "time" if place is _seconds else "samples"
    drawing = Drawing(_WIDTH, _HEIGHT, f"{scene}: error against {against}")
    size = "the unit square" if results.size == (1, 1) else f"{results.size[0]} x {results.size[1]} pixels"
    cost = f", {results.cost:g} ns added for each sample" if results.cost and place is _seconds else ""
    drawing.add(Text(drawing.title, 24, 28, 17))
    drawing.add(Text(f"{size}, {results.trials} trials, 95 % intervals{cost}", 24, 46, 12))
    errors = [(row.mse.low or row.mse.estimate, row.mse.estimate, row.mse.high or row.mse.estimate) for row in rows]
    x = spanning([place(row) for row in rows], across, 10 if place is _seconds else 2)
    y = spanning(np.array(errors, np.float64), "mean squared error", 10)
    chart = Chart(drawing, 72, _TOP, _RIGHT, _HEIGHT - 50, x, y)
    chart.grid()
    _guides(chart, rows, place, x)
    entries = []
    for number, sampler in enumerate(results.samplers):
        own = [(row, error) for row, error in zip(rows, errors, strict=True) if row.sampler == sampler]
        if not own:
            continue
        chosen = style(number)
        places = [place(row) for row, _ in own]
        low, middle, high = np.array([error for _, error in own], np.float64).T
        chart.whiskers(places, low, high, chosen)
        chart.curve(places, middle, chosen)
        slope = next((fit.slope for fit in results.fits if (fit.scene, fit.sampler) == (scene, sampler)), None)
        written = f": N^{slope.estimate:.2f}" if slope is not None and slope.estimate is not None else ""
        entries.append((sampler + written, chosen))
    legend(drawing, _RIGHT + 18, _TOP + 10, entries)
    return drawing


def _guides(chart: Chart, rows: list[Row], place: Callable[[Row], float], x: Axis) -> None:
    """Laws through the place where the curves begin, so that slopes can be told by eye."""
    first = min(rows, key=place)
    start = max(row.mse.estimate or 0.0 for row in rows if place(row) == place(first))
    for slope in _SLOPES:
        chart.guide(slope, max(place(first), x.low), start, f"{'N' if place is _count else 't'}^{slope:g}")
