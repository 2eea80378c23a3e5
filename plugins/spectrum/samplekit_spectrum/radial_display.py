"""A plot of the radial mean: N times the power with its interval, and below it the anisotropy in decibel."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit.plots import COLOURS, Display, make_axes, style
from samplekit_spectrum.map_display import condition, counted, headline

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.radial import Radial
    from samplekit_spectrum.spectrum import Spectrum

_LEVEL = 0.99
_CURVE, _GUIDE, _GRID = COLOURS[1], "#6a7380", "#e3e6eb"
_ROOTS = {1: "$N$", 2: "$N^{1/2}$", 3: "$N^{1/3}$"}


class RadialDisplay(Display):
    """A plot of the mean over rings, with a band of its 99 % interval, and of the anisotropy.

    Parameters
    ----------
    radial
        The means over rings.
    scale
        The factor of the power: N for a sampler.
    title, condition
        Two lines above the plot.
    marks
        Frequencies to mark, with a text for each.
    realizations
        Number of realisations in the mean, which determines the anisotropy that an isotropic spectrum would show; 0: do
        not draw that level.
    labels
        Labels of the axes of power and of frequency.

    Attributes
    ----------
    axes_, ax_, figure_
        See :class:`samplekit.plots.Display`: the first axes show the power, the second the anisotropy.
    """

    def __init__(
        self,
        radial: Radial,
        scale: float,
        *,
        title: str,
        condition: str,
        marks: list[tuple[float, str]],
        realizations: int,
        labels: tuple[str, str] = ("$N$ times the power", "frequency"),
    ) -> None:
        self.radial, self.scale, self.title = radial, scale, title
        self._condition, self._marks, self._realizations, self._labels = condition, marks, realizations, labels

    @classmethod
    def from_spectrum(cls, spectrum: Spectrum) -> RadialDisplay:
        """Make the display of the radial mean of a sampler's spectrum."""
        dims = spectrum.frequencies.dims
        return cls(
            spectrum.radial,
            spectrum.count,
            title=headline(spectrum),
            condition=condition(spectrum),
            marks=[(spectrum.count ** (1.0 / dims), _ROOTS[dims])],
            realizations=spectrum.realizations if spectrum.randomized else 0,
        )

    @classmethod
    def from_error(cls, spectrum: ErrorSpectrum, title: str) -> RadialDisplay:
        """Make the display of the radial mean of an error image's spectrum."""
        return cls(
            spectrum.radial, 1.0, title=title, condition="power over its mean", marks=[], realizations=1,
            labels=("power over its mean", "cycles per pixel"),
        )  # fmt: skip

    @style()
    def plot(self, ax: Axes | None = None, *, axes: Any = None) -> RadialDisplay:
        """Draw the power and the anisotropy.

        Parameters
        ----------
        ax
            Where the power alone is drawn.
        axes
            Where both are drawn: two axes. Without ``ax`` and ``axes``: a new figure, with a title.

        Returns
        -------
        RadialDisplay
            This display.

        Raises
        ------
        UsageError
            Another number of axes.
        """
        self.choose_axes(ax, axes, 1 if ax is not None else 2, self._new_axes)
        self._draw_power(self.ax_)
        if len(self.axes_) == 2:
            self._draw_anisotropy(self.axes_[1])
        self.axes_[-1].set_xlabel(self._labels[1])
        for panel in self.axes_:
            # The behaviour near 0 matters most.
            panel.set_xlim(0.0, float(self.radial.frequency[-1]))
            panel.grid(color=_GRID, linewidth=0.6)
        return self

    def _new_axes(self) -> tuple[Figure, list[Axes]]:
        band = ", band: 99 % interval" if np.nan_to_num(self.radial.standard_error).any() else ""
        figure, axes = make_axes(
            [(0, 0), (1, 0)], 4.4, (2.2, 1.0), title=self.title,
            caption=[f"{self._condition}; mean over rings{band}"],
            left=0.6, right=1.2, above=0.3, gap=(0.0, 0.25),
        )  # fmt: skip
        axes[0].tick_params(labelbottom=False)
        return figure, axes

    def _draw_power(self, ax: Axes) -> None:
        x = self.radial.frequency
        power = self.scale * self.radial.power
        error = self.scale * np.nan_to_num(self.radial.standard_error) * self._standard_errors()
        for frequency, word in self._marks:
            if 0.0 < frequency < x[-1]:
                ax.axvline(frequency, color=_GUIDE, linewidth=0.7, linestyle="--")
                ax.annotate(
                    word, (frequency, 1.0), (0.0, 3.0), ax.get_xaxis_transform(), "offset points", color=_GUIDE,
                    ha="center", annotation_clip=False,
                )  # fmt: skip
        _level(ax, 1.0, "white noise")
        ax.fill_between(x, np.maximum(power - error, 0.0), power + error, color=_CURVE, alpha=0.25, linewidth=0.0)
        _curve(ax, x, power)
        ax.set_ylim(0.0, max(1.2, 1.05 * float((power + error).max(initial=0.0))))
        ax.set_ylabel(self._labels[0])

    def _standard_errors(self) -> float:
        """Return half the width of the interval in standard errors, by Student's t over the realisations."""
        from scipy.special import stdtrit

        return float(stdtrit(max(self._realizations - 1, 1), 0.5 + 0.5 * _LEVEL))

    def _draw_anisotropy(self, ax: Axes) -> None:
        anisotropy = self.radial.anisotropy
        expected = -10.0 * math.log10(self._realizations or 1)
        finite = np.isfinite(anisotropy)
        values = np.clip(np.append(anisotropy[finite], [expected, 0.0]), -100.0, 100.0)
        low = 10.0 * math.floor(float(values.min()) / 10.0 - 0.2)
        high = 10.0 * math.ceil(float(values.max()) / 10.0 + 0.2)
        if self._realizations:
            sets = counted(self._realizations, "realization")
            _level(ax, expected, f"isotropic,\n{sets}:\n{expected + 0.0:.3g} dB".replace("-", "\N{MINUS SIGN}"))
        _curve(ax, self.radial.frequency[finite], np.clip(anisotropy[finite], low, high))
        ax.set_ylim(low, high)
        ax.set_ylabel("anisotropy, dB")


def _curve(ax: Axes, x: NDArray[np.float64], y: NDArray[np.float64]) -> None:
    """Draw a curve, or a dot for a single value, which may lie on the frame."""
    single = x.size == 1
    ax.plot(x, y, color=_CURVE, linewidth=1.2, marker="o" if single else "", markersize=4.0, clip_on=not single)


def _level(ax: Axes, value: float, word: str) -> None:
    """Draw a value as a dashed horizontal line, and name it to the right of the axes, where there is no curve."""
    ax.axhline(value, color=_GUIDE, linewidth=0.7, linestyle="--")
    ax.annotate(
        word, (1.0, value), (4.0, 0.0), ax.get_yaxis_transform(), "offset points", color=_GUIDE, va="center",
        annotation_clip=False,
    )  # fmt: skip
