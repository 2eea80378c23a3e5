"""How the pictures look: fonts, lines, colours that all eyes can tell apart, and panels of a stated size."""

from __future__ import annotations

import math
import textwrap
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.colorbar import Colorbar
    from matplotlib.figure import Figure

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b5b00", "#2b323c")
"""Okabe and Ito 2008, "Color Universal Design", their yellow darkened for white paper."""

INK, FRAME, GUIDE, GRID = "#2b323c", "#4a5361", "#6a7380", "#e3e6eb"
DPI = 200
"""Pixels of a PNG for each inch of a figure."""

TITLE_SIZE, TEXT_SIZE, SMALL_SIZE = 10.0, 8.0, 7.0
"""Sizes of letters in points: titles; labels and legends; numbers along axes."""

_MARKERS = ("o", "s", "^", "D", "x", "+", "v")
_LINES = ("-", "--", "-.", ":")
_TICKS: dict[str, Any] = {
    "color": FRAME,
    "labelcolor": INK,
    "labelsize": SMALL_SIZE,
    "major.width": 0.6,
    "major.size": 2.5,
    "minor.width": 0.4,
    "minor.size": 1.5,
}
_RC: Any = {
    **{f"xtick.{name}": value for name, value in _TICKS.items()},
    **{f"ytick.{name}": value for name, value in _TICKS.items()},
    "font.family": ["DejaVu Sans"],
    "font.size": TEXT_SIZE,
    "text.usetex": False,
    "text.color": INK,
    "mathtext.fontset": "dejavusans",
    "axes.labelcolor": INK,
    "axes.edgecolor": FRAME,
    "axes.linewidth": 0.6,
    "axes.axisbelow": True,
    "axes.titlesize": TEXT_SIZE,
    "axes.titlepad": 4.0,
    "axes.labelsize": TEXT_SIZE,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "legend.fontsize": TEXT_SIZE,
    "legend.frameon": False,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "savefig.bbox": None,
    "svg.fonttype": "none",
    "svg.hashsalt": "samplekit",
    "pdf.fonttype": 42,
}


@contextmanager
def style() -> Iterator[None]:
    """Draw in samplekit's style inside of the block, and leave the settings of matplotlib as they were.

    It decorates a function as well. Letters that the font does not have are drawn as boxes, without a warning.

    Examples
    --------
    >>> from samplekit.plots import make_axes, style
    >>> with style():
    ...     figure, (ax,) = make_axes([(0, 0)], 3.0, 2.0, title="a line")
    ...     lines = ax.plot([0, 1], [0, 1])
    """
    import matplotlib

    with matplotlib.rc_context(_RC), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)
        yield


def curve_style(number: int, *, marked: bool = True) -> dict[str, Any]:
    """Return the keywords of ``Axes.plot`` for curve ``number``, from 0.

    Parameters
    ----------
    number
        Fifty-six curves with markers, and thirty-two without, have styles of their own; then they repeat.
    marked
        Whether points of the curve have markers. Where they have none, the kind of line differs as the colour does.

    Examples
    --------
    >>> from samplekit.plots import curve_style
    >>> curve_style(1, marked=False)
    {'color': '#d55e00', 'linestyle': '--', 'linewidth': 1.2}
    """
    cycle, place = divmod(number, len(COLOURS))
    colour = COLOURS[place]
    if not marked:
        return {"color": colour, "linestyle": _LINES[(number + cycle) % len(_LINES)], "linewidth": 1.2}
    return {
        "color": colour,
        "linestyle": _LINES[cycle % len(_LINES)],
        "linewidth": 1.1,
        "marker": _MARKERS[number % len(_MARKERS)],
        "markersize": 4.0,
        "markerfacecolor": colour if number % 2 == 0 else "white",
    }


@style()
def make_axes(
    places: Sequence[tuple[int, int]],
    width: float,
    height: float | Sequence[float],
    *,
    title: str = "",
    caption: Sequence[str] = (),
    left: float = 0.55,
    right: float = 0.15,
    above: float = 0.1,
    below: float = 0.45,
    gap: tuple[float, float] = (0.2, 0.2),
) -> tuple[Figure, list[Axes]]:
    """Make a figure whose panels have a stated size, with title and caption above them.

    The figure is as large as its parts need. ``matplotlib.pyplot`` does not know it, so it needs no closing. Panels lie
    on whole pixels where all sizes are multiples of 1/200.

    Parameters
    ----------
    places
        Row and column of each panel, from 0.
    width, height
        Size of a panel in inches; ``height`` may give one for each row.
    title, caption
        Text above the panels: a line of larger type, and lines below it. Long lines are broken.
    left, right, above, below
        Room around all panels in inches, for what their axes say.
    gap
        Room between columns, and between rows, in inches.

    Returns
    -------
    figure
        A ``matplotlib.figure.Figure``.
    axes
        The panels in the order of ``places``.

    Examples
    --------
    >>> from samplekit.plots import make_axes
    >>> figure, axes = make_axes([(0, 0), (0, 1)], 3.0, 2.0, left=0.5, right=0.1, gap=(0.4, 0.0))
    >>> figure.get_size_inches()[0]
    np.float64(7.0)
    """
    from matplotlib.figure import Figure

    rows, columns = (max(place[axis] for place in places) + 1 for axis in (0, 1))
    heights = [height] * rows if isinstance(height, (int, float)) else list(height)
    lines: list[tuple[str, float]] = []
    total_width = left + columns * width + (columns - 1) * gap[0] + right
    for text, size in ((title, TITLE_SIZE), *((line, TEXT_SIZE) for line in caption)):
        lines += [(line, size) for line in _wrapped(text, size, total_width - 0.2)]
    heading = _on_pixels(0.1 * bool(lines) + sum(1.4 * size / 72 for _, size in lines))
    total_height = heading + above + sum(heights) + (rows - 1) * gap[1] + below
    figure = Figure(figsize=(total_width, total_height), dpi=DPI)
    y = total_height - 0.05
    for line, size in lines:
        y -= 1.4 * size / 72
        figure.text(0.1 / total_width, y / total_height, line, fontsize=size, va="bottom", parse_math=False)
    axes = []
    for row, column in places:
        x = left + column * (width + gap[0])
        bottom = total_height - heading - above - sum(heights[: row + 1]) - row * gap[1]
        bounds = x / total_width, bottom / total_height, width / total_width, heights[row] / total_height
        axes.append(figure.add_axes(bounds))
    return figure, axes


def plain(text: str) -> str:
    """Return the text on one line, as matplotlib draws it without taking any of it for mathematics."""
    return printable(text).replace("$", r"\$")


def printable(text: str) -> str:
    """Return the text with question marks for control characters, which no font has and XML does not allow."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def text_width(text: str, size: float = TEXT_SIZE) -> float:
    """Measure a text in inches, on whole pixels of a PNG; it may hold mathematics between dollar signs."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(family=_RC["font.family"], size=size)
    mathematics = text.replace(r"\$", "").count("$") > 1
    width, _, _ = text_to_path.get_text_width_height_descent(text, font, mathematics)
    return _on_pixels(width / 72)


def _wrapped(text: str, size: float, width: float) -> list[str]:
    text = printable(text)
    letters = int(0.97 * len(text) * width / max(text_width(text, size), 0.01))
    return textwrap.wrap(text, max(letters, 10))


def _on_pixels(inches: float) -> float:
    return math.ceil(inches * DPI) / DPI


def add_bar(ax: Axes, image: ScalarMappable, label: str, ticks: Sequence[float], extend: str = "neither") -> Colorbar:
    """Draw the bar of an image's colours at the right of its axes, 0.1 inch wide.

    Parameters
    ----------
    ax, image
        The axes, and what was drawn in them.
    label
        What the colours stand for.
    ticks
        The values that are written beside it.
    extend
        ``"max"`` or ``"both"`` where there are values beyond the ends of the bar, which have a colour of their own.

    Returns
    -------
    matplotlib.colorbar.Colorbar

    Examples
    --------
    >>> from samplekit.plots import add_bar, make_axes
    >>> figure, (ax,) = make_axes([(0, 0)], 3.0, 3.0, right=0.8)
    >>> bar = add_bar(ax, ax.imshow([[0.0, 1.0], [2.0, 3.0]], vmax=2.0), "power", [0.0, 1.0, 2.0], "max")
    >>> bar.ax.get_ylabel()
    'power'
    """
    width = 0.1 * ax.figure.dpi / ax.bbox.width
    bar = ax.figure.colorbar(image, cax=ax.inset_axes((1.0 + width, 0.0, width, 1.0)), extend=extend)
    bar.set_ticks(list(ticks), labels=[written(value) for value in ticks])
    bar.ax.tick_params(length=2.0)
    if label:
        bar.set_label(label)
    return bar


def written(value: float) -> str:
    r"""Write a number as mathematics: ``0.05``, ``$-2.5\times 10^{-6}$``."""
    mantissa, _, exponent = f"{value:.4g}".partition("e")
    digits = mantissa.replace("-", "\N{MINUS SIGN}")
    if not exponent:
        return digits
    factor = "" if mantissa == "1" else r"-" if mantissa == "-1" else rf"{mantissa}\times "
    return rf"${factor}10^{{{int(exponent)}}}$"


def count_label(count: int, most: int) -> str:
    """Write a number of samples; a power of two from ``most`` on as a power."""
    power = count.bit_length() - 1
    return f"$2^{{{power}}}$" if count >= most and count == 2**power else str(count)
