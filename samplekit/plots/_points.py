"""Point sets, and the grids in which their sampler promises as many points in each cell as in any other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.plots._display import Display
from samplekit.plots._grids import describe_grids, grid_of
from samplekit.plots._style import SMALL_SIZE, make_axes, style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._specs import Promise
    from samplekit.plots._grids import Grid

MOST_DIMS = 16
LINES_UP_TO = 64
"""Intervals of an axis that are drawn as lines across; more of them are ticks beside it."""

_POINT = "#c2281d"
_STRONG, _FINE, _FAINT, _TICK = ("#a9b3c1", 0.7), ("#b9c2ce", 0.4), ("#dfe3e9", 0.6), ("#8c97a6", 0.4)
"""Colour and width in points of lines between cells, of those between many, between intervals, and of ticks."""
_LEAST_BOLD, _LEAST_CELL, _LEAST_INTERVAL, _LEAST_TICK = 8.0, 3.5, 2.0, 1.2
"""Distances in points below which lines are thinner, then ticks, then left out: many would be a grey mass."""


class PointsDisplay(Display):
    """A picture of a point set.

    One dimension is a line of ticks, two are a square, more are the squares of all pairs of dimensions in a lower
    triangle. x goes to the right and y goes down, as in the domain of scenes.

    Parameters
    ----------
    points
        float64[N, D] in [0, 1], N at least 1, D from 1 to 16.
    promises
        What the sampler promises of such sets: its grids are drawn.
    title
        Stands above the picture, with a description of the grids below it.
    names
        The number that each axis shows as its dimension; None: from 0 on.

    Attributes
    ----------
    axes_, ax_, figure_
        See :class:`Display`: one axes for each of :attr:`pairs`.

    Raises
    ------
    UsageError
        There are more than 16 dimensions, or values outside [0, 1].

    Examples
    --------
    >>> from samplekit.plots import PointsDisplay
    >>> display = PointsDisplay.from_sampler("jittered", count=96, dims=2, seed=0).plot()
    >>> display.ax_.get_xlabel(), display.ax_.get_ylabel()
    ('$x_{0}$', '$x_{1}$')
    """

    def __init__(
        self,
        points: ArrayLike,
        promises: Sequence[Promise] = (),
        title: str = "",
        names: Sequence[int] | None = None,
    ) -> None:
        self.points: NDArray[np.float64] = np.asarray(points, np.float64)
        if self.points.ndim != 2 or self.points.size == 0:
            raise UsageError(f"a picture shows points of shape [N, D], not {list(self.points.shape)}")
        check_dims(self.points.shape[1])
        if not (self.points.min() >= 0.0 and self.points.max() <= 1.0):
            raise UsageError("a picture shows points in [0, 1]: there are others, or NaN")
        self.promises = tuple(promises)
        self.title = title
        self._names = range(self.points.shape[1]) if names is None else names

    @classmethod
    def from_sampler(
        cls, sampler: str | ConfiguredSampler, count: int, dims: int = 2, *, seed: int = 0
    ) -> PointsDisplay:
        """Make the display of a sampler's first set.

        Parameters
        ----------
        sampler
            ``NAME[:option=value,...][+RANDOMIZER]``, or what :func:`samplekit.sampler` returned.
        count, dims
            Points of the set, and dimensions.
        seed
            From 0 to 2^64 - 1.

        Raises
        ------
        UsageError
            The sampler is unknown or cannot make such a set.
        """
        from samplekit._configured.sampler import sampler as configured_sampler

        check_dims(dims)
        source = configured_sampler(sampler)
        return cls.of_set(source, source.points(count, dims, seed=seed)[0], seed)

    @classmethod
    def of_set(cls, source: ConfiguredSampler, points: NDArray[np.float64], seed: int) -> PointsDisplay:
        """Make the display of a sampler's first set, which was made already.

        Parameters
        ----------
        source, seed
            The sampler and the seed that made the set.
        points
            float64[N, D] in [0, 1].
        """
        count, dims = points.shape
        number = "1 point" if count == 1 else f"{count} points"
        return cls(points, source.spec.promises, f"{source.text}, {number} in {dims}D, seed {seed}, realisation 0")

    @property
    def pairs(self) -> list[tuple[int, ...]]:
        """The dimensions along x and along y of each panel, row by row; in one dimension ``(0,)``."""
        dims = self.points.shape[1]
        return [(0,)] if dims == 1 else [(x, y) for y in range(1, dims) for x in range(y)]

    @style()
    def plot(self, ax: Axes | None = None, *, axes: Any = None) -> PointsDisplay:
        """Draw the points and the grids.

        Parameters
        ----------
        ax
            Where a set in one or two dimensions is drawn; None: on a new figure, with a title.
        axes
            Where a set in more dimensions is drawn: one for each of :attr:`pairs`, in any shape.

        Returns
        -------
        PointsDisplay
            This display.

        Raises
        ------
        UsageError
            Another number of axes than there are panels.
        """
        count, dims = self.points.shape
        self.choose_axes(ax, axes, len(self.pairs), self._new_axes)
        for panel, pair in zip(self.axes_, self.pairs, strict=True):
            side = panel.bbox.width * 72 / panel.figure.dpi
            _draw_grid(panel, grid_of(self.promises, count, dims, pair), side)
            if dims == 1:
                self._draw_strip(panel, side)
            else:
                self._draw_square(panel, pair, side)
            panel.xaxis.set_label_position("top")
            panel.xaxis.tick_top()
            panel.tick_params(which="major", length=0.0, pad=5.0, labelsize=SMALL_SIZE)
            panel.tick_params(which="minor", length=3.0, width=_TICK[1], color=_TICK[0])
        return self

    def _new_axes(self) -> tuple[Figure, list[Axes]]:
        count, dims = self.points.shape
        grids = describe_grids(self.promises, count, dims)
        caption = [f"strata: {grids}"] if grids else []
        if dims == 1:
            return make_axes(
                [(0, 0)], 5.4, 0.6, title=self.title, caption=caption, left=0.2, above=0.3, right=0.2, below=0.1
            )
        side = 4.2 if dims == 2 else min(2.4, max(0.8, round(6.3 / (dims - 1), 1)))
        places = [(y - 1, x) for x, y in self.pairs]
        room = 0.3 if dims == 2 else 0.25
        return make_axes(
            places, side, side, title=self.title, caption=caption, left=0.4, above=room, right=0.2, below=0.15,
            gap=(0.15, 0.25),
        )  # fmt: skip

    def _label(self, dimension: int) -> str:
        return f"$x_{{{self._names[dimension]}}}$"

    def _draw_square(self, ax: Axes, pair: tuple[int, ...], side: float) -> None:
        spacing = side / len(self.points) ** 0.5
        size = 2.0 * min(max(0.18 * spacing, 0.25), max(side / 100, 1.0))
        x, y = self.points[:, pair].T
        ax.plot(x, y, "o", color=_POINT, markersize=size, markeredgewidth=0.0, clip_on=False, zorder=3, label="points")
        ax.set(xlim=(0.0, 1.0), ylim=(1.0, 0.0), aspect="equal")
        # The panels of many dimensions are named at the top of each column and at the left of each row.
        several = self.points.shape[1] > 2
        if not several or pair[1] == pair[0] + 1:
            ax.set_xlabel(self._label(pair[0]), labelpad=3.5 if several else -4.0)
        if not several or pair[0] == 0:
            ax.set_ylabel(self._label(pair[1]), rotation=0.0, va="center", labelpad=8.0 if several else 4.0)
        for set_ticks in (ax.set_xticks, ax.set_yticks):
            set_ticks([] if several else [0.0, 1.0], None if several else ["0", "1"])

    def _draw_strip(self, ax: Axes, side: float) -> None:
        width = min(max(0.3 * side / len(self.points), 0.3), 1.4)
        ax.vlines(self.points[:, 0], 0.0, 0.75, _POINT, linewidths=width, clip_on=False, zorder=3, label="points")
        ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), xticks=[0.0, 1.0], xticklabels=["0", "1"], yticks=[])
        ax.set_xlabel(self._label(0), labelpad=-4.0)
        ax.spines["top"].set_visible(False)


def check_dims(dims: int) -> None:
    """Raise if a picture cannot show so many dimensions.

    Raises
    ------
    UsageError
        There are more than 16.
    """
    if dims > MOST_DIMS:
        raise UsageError(f"a picture shows at most {MOST_DIMS} dimensions, not {dims}: write .csv or .npy")


def _draw_grid(ax: Axes, grid: Grid, side: float) -> None:
    """Draw the lines and ticks of a grid along both axes of a panel, ``side`` points long."""
    for axis in (0, 1):
        cells, intervals = grid.cells[axis], grid.intervals[axis]
        lines, set_ticks = (ax.vlines, ax.set_xticks) if axis == 0 else (ax.hlines, ax.set_yticks)
        ticks = np.array([])
        if cells > 1 and side / cells >= _LEAST_CELL:
            colour, width = _STRONG if side / cells >= _LEAST_BOLD else _FINE
            lines(np.arange(1, cells) / cells, 0.0, 1.0, colour, linewidths=width, zorder=0.6, label="cells")
        elif cells > 1 and side / cells >= _LEAST_TICK:
            ticks = np.arange(1, cells) / cells
        if intervals > 1 and intervals <= LINES_UP_TO and side / intervals >= _LEAST_INTERVAL:
            # A line between cells is drawn once, as the stronger one.
            numbers = np.arange(1, intervals)
            numbers = numbers[numbers * cells % intervals != 0]
            colour, width = _FAINT
            lines(numbers / intervals, 0.0, 1.0, colour, linewidths=width, zorder=0.5, label="intervals")
        elif intervals > 1 and side / intervals >= _LEAST_TICK:
            ticks = np.union1d(ticks, np.arange(1, intervals) / intervals)
        if ticks.size:
            set_ticks(ticks, minor=True)
