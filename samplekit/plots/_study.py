"""Studies: the error of each sampler against samples or against run time, with intervals and fitted slopes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from samplekit._errors import UsageError
from samplekit.plots._display import Display
from samplekit.plots._style import (
    GRID,
    GUIDE,
    SMALL_SIZE,
    count_label,
    curve_style,
    make_axes,
    plain,
    style,
    text_width,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit._study.results import Interval, Results, Row

Against = Literal["samples", "time"]

_WIDTH, _HEIGHT, _LINE = 3.8, 3.2, 0.175
_SLOPES = (-1.0, -1.5, -2.0, -3.0)


class StudyDisplay(Display):
    """The mean squared error on one scene, a curve for each sampler, along two logarithmic axes.

    Every point has its 95 % interval, against time also that of its time. Against samples, the legend names the slope
    that was fitted to each sampler if its interval lies below 0. The legend is sorted by the error at the end of the
    curves. Lines below it show how some powers fall along these axes. Errors of 0 cannot be drawn on a logarithmic axis
    and are left out.

    Parameters
    ----------
    results
        What :func:`samplekit.compare` returned.
    scene
        One of ``results.scenes``; None: the only one.
    against
        ``"samples"``: of a pixel; ``"time"``: the seconds of one trial.

    Attributes
    ----------
    rows
        The rows of the results that are drawn; empty if there is nothing to draw.
    ax_, axes_, figure_
        See :class:`Display`.

    Raises
    ------
    UsageError
        The study does not have the scene, or it has several scenes and none was chosen.

    Examples
    --------
    >>> import samplekit
    >>> results = samplekit.compare(["random", "jittered"], "disk", [4, 16, 64], size=(1, 1), times=False)
    >>> results.plot().ax_.get_ylabel()
    'mean squared error'
    """

    def __init__(self, results: Results, scene: str | None = None, against: Against = "samples") -> None:
        if scene is None and len(results.scenes) > 1:
            raise UsageError(f"choose the scene of the plot: {', '.join(results.scenes)}")
        self.scene = results.scenes[0] if scene is None else scene
        if self.scene not in results.scenes:
            raise UsageError(f"the study has no scene {self.scene}: it has {', '.join(results.scenes)}")
        if against not in ("samples", "time"):
            raise UsageError(f"a plot against {against}: expected samples or time")
        self.results, self.against = results, against
        self.rows = [
            row
            for row in results.rows
            if row.scene == self.scene
            and row.mse.estimate
            and (against == "samples" or (row.time and row.time.estimate))
        ]

    @style()
    def plot(self, ax: Axes | None = None) -> StudyDisplay:
        """Draw the curves.

        Parameters
        ----------
        ax
            Where to draw. The legend stands at the right of it, outside. None: a new figure, with a title.

        Returns
        -------
        StudyDisplay
            This display.

        Raises
        ------
        UsageError
            There is nothing to draw: all errors are 0, or no times were taken.
        """
        from matplotlib.ticker import NullFormatter

        if not self.rows:
            what = "no times were taken" if self.against == "time" else "no error is above 0"
            raise UsageError(f"there is nothing to draw of {self.scene}: {what}")
        curves = self._curves()
        self.choose_axes(ax, None, 1, lambda: self._new_axes([label for _, label, _ in curves]))
        ax = self.ax_
        ax.set_xscale("log", base=2 if self.against == "samples" else 10)
        ax.set_yscale("log")
        for rows, label, kind in curves:
            estimates = np.array([row.mse.estimate for row in rows], np.float64)
            reach = _reach_of([row.mse for row in rows])
            places = np.array([self._place(row) for row in rows])
            along = None if self.against == "samples" else _reach_of([row.time for row in rows])
            ax.errorbar(places, estimates, reach, along, label=label, elinewidth=0.8, **kind)
        ax.set(xlabel=self._x_label(), ylabel="mean squared error")
        ax.grid(color=GRID, linewidth=0.6)
        ax.set_ylim(*_with_two_powers(*ax.get_ylim()))
        ax.yaxis.set_minor_formatter(NullFormatter())
        if self.against == "samples":
            _mark_counts(ax, [row.count for row in self.rows])
        else:
            ax.set_xlim(*_with_two_powers(*ax.get_xlim()))
            ax.xaxis.set_minor_formatter(NullFormatter())
        legend = ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), borderaxespad=0.0, labelspacing=0.35)
        if any(len(rows) > 1 for rows, _, _ in curves):
            _draw_slopes(ax, legend.get_window_extent().y0, "N" if self.against == "samples" else "t")
        return self

    def _place(self, row: Row) -> float:
        if self.against == "samples" or row.time is None:
            return float(row.count)
        return row.time.estimate or 0.0

    def _x_label(self) -> str:
        if self.against == "samples":
            return "samples $N$" if self.results.size == (1, 1) else "samples of a pixel, $N$"
        return "seconds $t$" if self.results.size == (1, 1) else "seconds for an image, $t$"

    def _curves(self) -> list[tuple[list[Row], str, dict[str, Any]]]:
        """Return rows, label and style of each sampler's curve, the curve with the largest last error first."""
        fits = self.results.fits if self.against == "samples" else []
        slopes = {fit.sampler: fit.slope.estimate for fit in fits if fit.scene == self.scene and fit.falls}
        curves = []
        for number, sampler in enumerate(self.results.samplers):
            rows = [row for row in self.rows if row.sampler == sampler]
            slope = slopes.get(sampler)
            label = plain(sampler) + (f"  $N^{{{slope:.2f}}}$" if slope is not None else "")
            if rows:
                curves.append((rows, label, curve_style(number)))
        return sorted(curves, key=lambda curve: -(curve[0][-1].mse.estimate or 0.0))

    def _new_axes(self, labels: list[str]) -> tuple[Figure, list[Axes]]:
        results = self.results
        size = "the unit square" if results.size == (1, 1) else f"{results.size[0]} x {results.size[1]} pixels"
        cost = f", {results.cost:g} ns added for each sample" if results.cost and self.against == "time" else ""
        return make_axes(
            [(0, 0)], _WIDTH, max(_HEIGHT, _LINE * len(labels) + 1.1),
            title=f"{self.scene}: error against {self.against}",
            caption=[f"{size}, {results.trials} trials, 95 % intervals{cost}"],
            left=0.65, right=max(0.8, *(text_width(label) for label in labels)) + 0.6,
        )  # fmt: skip


def _reach_of(intervals: Sequence[Interval | None]) -> NDArray[np.float64]:
    """Return how far the intervals reach below and above their estimates: float64[2, n], 0 at an open end."""
    ends = [(each.estimate, each.low or each.estimate, each.high or each.estimate) for each in intervals if each]
    estimates, lows, highs = np.array(ends, np.float64).T
    reach: NDArray[np.float64] = np.array([estimates - lows, highs - estimates])
    return reach


def _with_two_powers(low: float, high: float) -> tuple[float, float]:
    """Widen limits until two powers of ten lie within them: only powers of ten are written along the axis."""
    below, above = math.floor(math.log10(low)), math.ceil(math.log10(high))
    inside = [power for power in range(below, above + 1) if low <= 10.0**power <= high]
    if len(inside) < 2:
        nearer = low / 10.0**below < 10.0**above / high
        low = 10.0**below if nearer or not inside else low
        high = high if nearer and inside else 10.0**above
    return low, high


def _mark_counts(ax: Axes, counts: list[int]) -> None:
    """Mark powers of two along x: as numbers, or as powers where they are long."""
    ax.set_xticks([], minor=True)
    low, high = min(counts), max(counts)
    first, last = (low - 1).bit_length(), high.bit_length() - 1
    step = max(1, -(-(last - first + 1) // 8))
    powers = range(first, last + 1, step)
    if len(powers) < 2:
        marks = sorted(set(counts))
        ax.set_xticks(marks, [str(mark) for mark in marks])
        return
    ax.set_xticks([2.0**power for power in powers], [count_label(2**power, 2**14) for power in powers])


def _draw_slopes(ax: Axes, under: float, letter: str) -> None:
    """Draw lines that fall as powers of x do along these axes, below the legend, which ends ``under`` pixels high."""
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    ax.set(xlim=(left, right), ylim=(bottom, top))
    # How far a line of slope -1 falls over the whole width of the axes, in heights of the axes.
    fall = np.log(right / left) / np.log(top / bottom)
    width = min(0.2, 0.34 / (fall * -_SLOPES[-1]))
    point = ax.figure.dpi / 72 / ax.bbox.height
    x, y = 1.04, ax.transAxes.inverted().transform((0.0, under))[1] - 8.0 * point
    previous = np.inf
    for slope in _SLOPES:
        end = y + slope * fall * width
        # The labels of lines that are nearly equal would lie on each other.
        if end > previous - 8.0 * point:
            continue
        previous = end
        ax.plot([x, x + width], [y, end], color=GUIDE, linewidth=0.8, clip_on=False, transform=ax.transAxes)
        power = f"{slope:g}".replace("-", "\N{MINUS SIGN}")
        ax.annotate(
            f"${letter}^{{{power}}}$", (x + width, end), (3, 0), "axes fraction", "offset points", va="center",
            fontsize=SMALL_SIZE, color=GUIDE, annotation_clip=False,
        )  # fmt: skip
