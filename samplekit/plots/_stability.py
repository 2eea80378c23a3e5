"""Stability: heat maps of the digits that are right, and of those that summation lost, over scale and count."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.plots._display import Display
from samplekit.plots._style import (
    FRAME,
    INK,
    SMALL_SIZE,
    add_bar,
    count_label,
    make_axes,
    plain,
    style,
    text_width,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit._stability.results import Stability
    from samplekit._stability.verdict import Kind

_CELL_WIDTH, _CELL_HEIGHT = 0.46, 0.17
_RIGHT, _LOST = "#1f5fa8", "#b8501c"
_MOST_RIGHT, _MOST_LOST = 16.0, 3.0
_COLOURS: dict[Kind, str] = {
    "no hits": "#b9bec6",
    "few hits": "#dadde2",
    "invalid": "#ff00ff",
    "wrong": "#ff00ff",
}
"""Colours of cells whose estimates have no digits to show."""
_SHORT: dict[Kind, str] = {
    "right": "",
    "infinite variance": "~",
    "precision lost": "!",
    "not random": "=",
    "refused": "\N{EN DASH}",
}
"""Marks of cells; those of the other kinds are their names."""
_LEGEND = (
    "blue: digits of one estimate that are right, 0 to 16;  ~ the variance is infinite: no standard error",
    "! rounding exceeds the error of sampling;  = the sampler is not random: one set, no standard error",
    "no hits: every sample missed, or all estimates are equal;  few hits: too few estimates differ to judge the error",
    "orange: digits that summation lost of those that one rounding leaves, 0 to 3",
)


class StabilityDisplay(Display):
    """Heat maps of the cells of one scene: scales down, counts across, a column of maps for each sampler.

    The upper row shows the decimal digits of one estimate that are right, the lower row those that summation lost. A
    cell that has no digits to show says why.

    Parameters
    ----------
    stability
        What :func:`samplekit.stability` returned.
    scene
        Name of the scene; None: the only one.

    Attributes
    ----------
    extremes, samplers, counts
        What the rows of each map, the columns of maps, and the columns of each map stand for.
    axes_, ax_, figure_
        See :class:`Display`: the upper map of each sampler, then the lower ones.

    Raises
    ------
    UsageError
        There are no cells of this scene, there are cells of several scenes and none was chosen, or cells are missing.

    Examples
    --------
    >>> import samplekit
    >>> display = samplekit.stability("gaussian:sigma=1e-8", "random", [16], realizations=4).plot()
    >>> [text.get_text() for text in display.ax_.texts]
    ['no hits']
    """

    def __init__(self, stability: Stability, scene: str | None = None) -> None:
        cells = stability.cells
        names = list(dict.fromkeys(cell.name for cell in cells))
        if scene is None and len(names) != 1:
            raise UsageError(f"choose the scene of the heat maps: {', '.join(names) or 'there are no cells'}")
        self.scene = names[0] if scene is None else scene
        if self.scene not in names:
            raise UsageError(f"there are no cells of {self.scene}: there are some of {', '.join(names)}")
        self.title = f"{self.scene}: {stability.realizations} realisations, seed {stability.seed}"
        own = [cell for cell in cells if cell.name == self.scene]
        self.extremes = list(dict.fromkeys(cell.extreme for cell in own))
        self.samplers = list(dict.fromkeys(cell.sampler for cell in own))
        self.counts = sorted({cell.count for cell in own})
        self._cells = {(cell.extreme, cell.sampler, cell.count): cell for cell in own}
        if len(self._cells) != len(self.extremes) * len(self.samplers) * len(self.counts):
            raise UsageError(f"the cells of {self.scene} do not have every sampler at every scale and count")

    @style()
    def plot(self, axes: Any = None) -> StabilityDisplay:
        """Draw the heat maps.

        Parameters
        ----------
        axes
            Where to draw: two for each sampler, in any shape, the upper row first. None: a new figure, with a title
            and a legend.

        Returns
        -------
        StabilityDisplay
            This display.

        Raises
        ------
        UsageError
            Another number of axes than there are maps.
        """
        number = len(self.samplers)
        self.choose_axes(None, axes, 2 * number, self._new_axes)
        for column, sampler in enumerate(self.samplers):
            last = column == number - 1
            self._draw(self.axes_[column], sampler, lost=False, first=column == 0, last=last)
            self._draw(self.axes_[number + column], sampler, lost=True, first=column == 0, last=last)
        return self

    def digits(self, sampler: str, *, lost: bool = False) -> NDArray[np.float64]:
        """Return the digits of a sampler's cells that are right, or lost: float64[extremes, counts].

        They are NaN where no estimate was measured. Digits that are right are NaN also where the cell says why it has
        none.
        """
        found = np.full((len(self.extremes), len(self.counts)), np.nan)
        for row, extreme in enumerate(self.extremes):
            for column, count in enumerate(self.counts):
                cell = self._cells[extreme, sampler, count]
                if cell.measured is None or cell.verdict.kind == "invalid":
                    continue
                if lost:
                    found[row, column] = cell.measured.digits_lost
                elif cell.verdict.kind not in _COLOURS:
                    found[row, column] = cell.measured.digits_right
        return found

    def _draw(self, ax: Axes, sampler: str, *, lost: bool, first: bool, last: bool) -> None:
        from matplotlib.colors import LinearSegmentedColormap
        from matplotlib.patches import Rectangle

        digits, most = self.digits(sampler, lost=lost), _MOST_LOST if lost else _MOST_RIGHT
        shades = LinearSegmentedColormap.from_list("digits", ["#ffffff", _LOST if lost else _RIGHT])
        image = ax.imshow(np.ma.masked_invalid(digits), cmap=shades, vmin=0.0, vmax=most, aspect="auto")
        for row, extreme in enumerate(self.extremes):
            for column, count in enumerate(self.counts):
                kind, value = self._cells[extreme, sampler, count].verdict.kind, digits[row, column]
                if np.isnan(value):
                    corner, colour = (column - 0.5, row - 0.5), _COLOURS.get(kind, "#f4f4f4")
                    ax.add_patch(Rectangle(corner, 1.0, 1.0, facecolor=colour, linewidth=0.0, zorder=0.4))
                mark = _SHORT.get(kind, kind)
                text = mark if np.isnan(value) else f"{value:.1f}" + ("" if lost else mark)
                ink = "white" if value > 0.55 * most else INK
                ax.text(column, row, text, color=ink, fontsize=SMALL_SIZE, ha="center", va="center_baseline")
        ax.set_title(plain(f"{sampler}: lost" if lost else sampler), loc="left", pad=14.0)
        ax.set_xticks(range(len(self.counts)), [count_label(count, 2**10) for count in self.counts])
        ax.set_yticks(range(len(self.extremes)), [plain(each or self.scene) for each in self.extremes] if first else [])
        ax.xaxis.tick_top()
        ax.set_xticks(np.arange(len(self.counts) + 1) - 0.5, minor=True)
        ax.set_yticks(np.arange(len(self.extremes) + 1) - 0.5, minor=True)
        ax.grid(which="minor", color="white", linewidth=0.8)
        ax.tick_params(which="both", length=0.0, labelcolor=FRAME)
        ax.spines[:].set_visible(False)
        if last:
            bar = add_bar(ax, image, "", [0.0, most])
            bar.ax.set_title("digits lost" if lost else "digits right", loc="left", pad=14.0)

    def _new_axes(self) -> tuple[Figure, list[Axes]]:
        names = [f"{sampler}: lost" for sampler in self.samplers]
        width = max(_CELL_WIDTH * len(self.counts), *(text_width(name) for name in names))
        places = [(row, column) for row in (0, 1) for column in range(len(self.samplers))]
        labels = max(text_width(each or self.scene, SMALL_SIZE) for each in self.extremes)
        legend = 0.3 + 1.04 * max(text_width(line) for line in _LEGEND)
        right = max(0.75, legend - labels - (width + 0.15) * len(self.samplers))
        return make_axes(
            places, width, _CELL_HEIGHT * len(self.extremes), title=self.title, caption=_LEGEND,
            left=labels + 0.2, right=right, above=0.45, below=0.1, gap=(0.15, 0.5),
        )  # fmt: skip
