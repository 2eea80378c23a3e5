"""Pictures of spectra: N times the power in grey on a stated scale, one square for each frequency, without DC."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from samplekit.plots import Display, add_bar, make_axes, style
from samplekit_spectrum.frequencies import Cube

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.spectrum import Spectrum

SCALE = 2.0
"""The value of N times the power that is drawn white: white noise, which is 1, is medium grey."""

BEYOND, MISSING = "#f5a623", "#7fa8d9"
"""Colours of frequencies whose power is beyond the scale, and of those that are left out."""

_DPI = 200
_ONE, _SEVERAL, _LARGEST = 720, 360, 1026
"""Pixels along a panel: about 720 if it is the only one, about 360 if there are several, and never more than 1026."""


class Map(NamedTuple):
    """One panel of a picture.

    Attributes
    ----------
    place
        Row and column of the panel.
    values
        float64[h, w], axes (y, x): N times the power, NaN where it is left out.
    title, labels
        The text above the panel, and the labels of the axes x and y.
    extent
        Frequencies at the left, right, lower and upper edge.
    ticks
        Frequencies with a tick on both axes.
    """

    place: tuple[int, int]
    values: NDArray[np.float64]
    title: str
    labels: tuple[str, str]
    extent: tuple[float, float, float, float]
    ticks: list[float]


class MapDisplay(Display):
    """A picture of a spectrum over the plane of frequencies, or of several spectra or slices.

    Frequency 0 is in the middle, x goes to the right and y goes down. Grey is proportional to the power. Values larger
    than the scale are orange; DC, which is left out, is blue.

    Parameters
    ----------
    maps
        The panels.
    title, condition
        Two lines above the picture.
    scale
        Power that is drawn white.
    words
        What the greys stand for, what white noise is, and what is left out: three texts.

    Attributes
    ----------
    facts
        ``scale``; ``largest``, the largest power that is not left out; ``beyond``, the number of frequencies above the
        scale; ``reduced``, the side of the squares of frequencies whose mean is drawn as one pixel.
    axes_, ax_, figure_
        See :class:`samplekit.plots.Display`: one axes for each map.
    """

    def __init__(
        self,
        maps: Sequence[Map],
        title: str,
        condition: str,
        scale: float = SCALE,
        words: tuple[str, str, str] = ("$N$ times the power", "white noise is 1", "DC, which is N,"),
    ) -> None:
        self.maps = list(maps)
        self.title, self._condition, self._words = title, condition, words
        finite = np.concatenate([one.values[np.isfinite(one.values)] for one in maps])
        self.facts = {
            "scale": scale,
            "largest": float(finite.max(initial=0.0)),
            "beyond": int((finite > scale).sum()),
            "reduced": -(-max(max(one.values.shape) for one in maps) // _LARGEST),
        }

    @classmethod
    def from_spectra(cls, spectra: Sequence[Spectrum], scale: float | None = None) -> MapDisplay:
        """Make the display of spectra of two dimensions, or of slices of one of three.

        Parameters
        ----------
        spectra
            One spectrum, or those of all pairs of dimensions of the same sets, drawn as a lower triangle.
        scale
            N times the power that is drawn white; None: 2.
        """
        maps = [one for spectrum in spectra for one in _maps(spectrum, several=len(spectra) > 1)]
        return cls(maps, headline(spectra[0]), condition(spectra[0]), SCALE if scale is None else scale)

    @classmethod
    def from_error(cls, spectrum: ErrorSpectrum, title: str) -> MapDisplay:
        """Make the display of the spectrum of an error image."""
        height, width = spectrum.power.shape
        left, right = _edges(width)
        upper, lower = _edges(height)
        labels = ("cycles per pixel along $x$", "cycles per pixel along $y$")
        one = Map((0, 0), spectrum.power, "", labels, (left, right, lower, upper), [-0.5, -0.25, 0.0, 0.25])
        return cls([one], title, "power over its mean", words=("power over its mean", "", "DC"))

    @style()
    def plot(self, ax: Axes | None = None, *, axes: Any = None) -> MapDisplay:
        """Draw the maps.

        Parameters
        ----------
        ax
            Where a single map is drawn; None: on a new figure, with a title.
        axes
            Where several maps are drawn: one for each of ``maps``, in any shape.

        Returns
        -------
        MapDisplay
            This display.

        Raises
        ------
        UsageError
            Another number of axes than there are maps.
        """
        from matplotlib import colormaps

        self.choose_axes(ax, axes, len(self.maps), self._new_axes)
        exact = ax is None and axes is None
        greys = colormaps["gray"].with_extremes(bad=MISSING, over=BEYOND)
        scale = self.facts["scale"]
        for panel, one in zip(self.axes_, self.maps, strict=True):
            values = np.ma.masked_invalid(_reduced(one.values, int(self.facts["reduced"])))
            image = panel.imshow(
                values, cmap=greys, vmin=0.0, vmax=scale, extent=one.extent, aspect="auto",
                interpolation="nearest" if exact else "auto",
            )  # fmt: skip
            panel.set_box_aspect(one.values.shape[0] / one.values.shape[1])
            panel.set(xlabel=one.labels[0], ylabel=one.labels[1], xticks=one.ticks, yticks=one.ticks)
            panel.set_title(one.title)
        # There is room for the bar beside the panel at the right end of the last row.
        last = max(range(len(self.maps)), key=lambda number: self.maps[number].place)
        extend = "max" if self.facts["beyond"] else "neither"
        add_bar(self.axes_[last], image, self._words[0], [0.0, scale / 2.0, scale], extend)
        return self

    def _new_axes(self) -> tuple[Figure, list[Axes]]:
        several = len(self.maps) > 1
        rows, columns = (-(-side // int(self.facts["reduced"])) for side in self.maps[0].values.shape)
        # Each frequency is a square of whole pixels of the file.
        factor = max(1, round((_SEVERAL if several else _ONE) / max(rows, columns))) / _DPI
        above = 0.25 if any(one.title for one in self.maps) else 0.1
        return make_axes(
            [one.place for one in self.maps], columns * factor, rows * factor,
            title=self.title, caption=[line for line in self._caption() if line],
            left=0.65, right=0.8, above=above, below=0.45, gap=(0.7, above + 0.4),
        )  # fmt: skip

    def _caption(self) -> list[str]:
        _, noise, missing = self._words
        facts = self.facts
        largest = "; ".join([noise] * bool(noise) + [f"largest {facts['largest']:.4g}"])
        beyond = f"; {facts['beyond']} frequencies beyond the scale (orange)" if facts["beyond"] else ""
        side = facts["reduced"]
        return [
            self._condition,
            largest + beyond,
            f"{missing} is left out (blue)",
            f"each pixel is the mean of {side} x {side} frequencies" if side > 1 else "",
        ]


def headline(spectrum: Spectrum) -> str:
    """Return the title of a picture: the sampler and the number of points."""
    return f"{spectrum.sampler}, {counted(spectrum.count, 'point')}"


def condition(spectrum: Spectrum) -> str:
    """Return the second line of a picture: the number of sets in the mean."""
    if not spectrum.randomized:
        return "one set: it is not random"
    interrupted = f", interrupted: {spectrum.requested} were asked for" if spectrum.interrupted else ""
    return f"mean of {counted(spectrum.realizations, 'realization')}{interrupted}"


def counted(number: int, noun: str) -> str:
    """Return the number with its noun, such as "1 point" or "2 points"."""
    return f"{number} {noun}" + "s" * (number != 1)


def slice_numbers(reach: int) -> list[int]:
    """Choose up to six slices of a cube: 0 and powers of 2, up to the largest within the reach."""
    numbers = [0, *(2**power for power in range(reach.bit_length()))]
    return numbers if len(numbers) <= 6 else [0, 1, *numbers[-4:]]


def _maps(spectrum: Spectrum, *, several: bool) -> list[Map]:
    cube = spectrum.frequencies
    assert isinstance(cube, Cube)
    values = spectrum.normalized
    values.reshape(-1)[values.size // 2] = np.nan
    end = cube.reach * cube.step
    edge = end + cube.step / 2.0
    x, y = spectrum.project[:2]
    labels = f"frequency along $x_{{{x}}}$", f"frequency along $x_{{{y}}}$"
    extent, ticks = (-edge, edge, edge, -edge), [-end, 0.0, end]
    if cube.dims == 2:
        return [Map((y - 1, x) if several else (0, 0), values, "", labels, extent, ticks)]
    slices = slice_numbers(cube.reach)
    columns = min(len(slices), 3)
    return [
        Map(
            divmod(number, columns),
            values[cube.reach + z],
            f"frequency {z * cube.step:.4g} along $x_{{{spectrum.project[2]}}}$",
            labels, extent, ticks,
        )
        for number, z in enumerate(slices)
    ]  # fmt: skip


def _edges(side: int) -> tuple[float, float]:
    """Return the frequencies at both edges of a discrete spectrum of ``side`` frequencies, with DC in the middle."""
    return (-(side // 2) - 0.5) / side, (side - side // 2 - 0.5) / side


def _reduced(values: NDArray[np.float64], block: int) -> NDArray[np.float64]:
    """Return the means over square blocks, without NaNs; the last blocks may be cut off."""
    if block == 1:
        return values
    height, width = values.shape
    padded = np.pad(values, ((0, -height % block), (0, -width % block)), constant_values=np.nan)
    blocks = padded.reshape(padded.shape[0] // block, block, padded.shape[1] // block, block)
    return np.asarray(np.nanmean(blocks, axis=(1, 3)))
