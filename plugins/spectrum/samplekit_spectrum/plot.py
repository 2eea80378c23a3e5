"""The radial mean as a plot: N times the power with its interval, and below it the anisotropy in dB."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import CURVE, GRID, GUIDE, Band, Drawing, Line, Text, label, round_ticks

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit_spectrum.radial import Radial
    from samplekit_spectrum.spectrum import Spectrum

_LEFT, _RIGHT, _TOP, _WIDTH = 70, 696, 78, 720
_POWER, _ANISOTROPY = 300, 130
_INTERVAL = 2.576


def spectrum_plot(spectrum: Spectrum) -> Drawing:
    """The plot of the radial mean of a sampler's spectrum."""
    from samplekit_spectrum.picture import condition_of, headline_of

    cube = spectrum.frequencies
    root = spectrum.count ** (1.0 / cube.dims)
    word = {1: "N", 2: "square root of N", 3: "cube root of N"}[cube.dims]
    return radial_plot(
        spectrum.radial,
        spectrum.count,
        headline=headline_of(spectrum),
        condition=condition_of(spectrum),
        marks=[(root, word)],
        realizations=spectrum.realizations if spectrum.randomized else 0,
    )


def radial_plot(
    radial: Radial,
    scale: float,
    *,
    headline: str,
    condition: str,
    marks: list[tuple[float, str]],
    realizations: int,
    power_label: str = "N times the power, mean over rings (band: 99 % interval)",
    unit: str = "frequency",
) -> Drawing:
    """Lay out the plot.

    Parameters
    ----------
    radial
        The means over rings.
    scale
        What the power is multiplied with: N.
    headline, condition
        Two lines above.
    marks
        Frequencies to mark, with a word each.
    realizations
        For the anisotropy that an isotropic spectrum would show; 0 leaves it out.
    power_label, unit
        What the axes say.
    """
    bottom = _TOP + _POWER
    height = bottom + 66 + _ANISOTROPY + 46
    drawing = Drawing(_WIDTH, height, headline)
    drawing.add(Text(headline, 24, 30, 17), Text(condition, 24, 50, 12))
    x = radial.frequency
    # From 0: what happens there is what matters.
    last = float(x[-1])
    power, error = scale * radial.power, scale * np.nan_to_num(radial.standard_error) * _INTERVAL
    top = max(1.2, 1.05 * float((power + error).max(initial=0.0)))
    place = _axis(0.0, last, _LEFT, _RIGHT)
    up = _axis(0.0, top, bottom, _TOP)
    _grid(drawing, place, up, (0.0, last), (0.0, top), _TOP, bottom)
    for frequency, word in marks:
        if 0.0 < frequency < last:
            at = float(place(np.array([frequency]))[0])
            drawing.segment(at, _TOP, at, bottom, GUIDE, dashed=True)
            drawing.add(Text(word, at + 4, _TOP + 14, 11, "left", GUIDE))
    one = float(up(np.array([1.0]))[0])
    drawing.segment(_LEFT, one, _RIGHT, one, GUIDE, dashed=True)
    drawing.add(_beside("white noise", one, place(x), up(power)))
    drawing.add(Band(place(x), up(np.maximum(power - error, 0.0)), up(power + error)))
    drawing.add(Line(_curve(place(x), up(power)), CURVE, 1.6))
    drawing.add(Text(power_label, _LEFT, _TOP - 4, 12))
    _anisotropy(drawing, radial, place, last, bottom + 66, realizations)
    drawing.add(Text(unit, (_LEFT + _RIGHT) / 2, height - 10, 12, "center"))
    return drawing


def _anisotropy(
    drawing: Drawing,
    radial: Radial,
    place: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    last: float,
    top: int,
    realizations: int,
) -> None:
    bottom = top + _ANISOTROPY
    finite = radial.anisotropy[np.isfinite(radial.anisotropy)]
    expected = 0.0 - 10.0 * math.log10(realizations or 1)
    values = np.clip(np.append(finite, [expected, 0.0]), -100.0, 100.0)
    low, high = 10.0 * math.floor(float(values.min()) / 10.0 - 0.2), 10.0 * math.ceil(float(values.max()) / 10.0 + 0.2)
    up = _axis(low, high, bottom, top)
    _grid(drawing, place, up, (0.0, last), (low, high), top, bottom, most=4)
    if realizations:
        at = float(up(np.array([expected]))[0])
        drawing.segment(_LEFT, at, _RIGHT, at, GUIDE, dashed=True)
        sets = "1 realization" if realizations == 1 else f"{realizations} realizations"
        word = f"isotropic, {sets}: {label(round(expected, 1))}"
        drawing.add(_beside(word, at, place(radial.frequency), up(np.clip(radial.anisotropy, low, high))))
    shown = np.isfinite(radial.anisotropy)
    if shown.any():
        heights = up(np.clip(radial.anisotropy[shown], low, high))
        drawing.add(Line(_curve(place(radial.frequency[shown]), heights), CURVE, 1.4))
    drawing.add(Text("anisotropy, dB", _LEFT, top - 6, 12))


def _beside(word: str, at: float, x: NDArray[np.float64], y: NDArray[np.float64]) -> Text:
    """The name of a level, where the curve leaves most room: above it or below, at its right end or its left."""
    width = 6.0 * len(word)
    places: list[tuple[float, int, float, float]] = []
    for left in (_RIGHT - 4 - width, _LEFT + 4):
        near = np.interp(np.linspace(left, left + width, 32), x, y)
        for baseline in (at - 5, at + 13):
            room = float(np.nanmin(np.abs(near - (baseline - 4)), initial=np.inf))
            places.append((min(room, 20.0), -len(places), left, baseline))
    _, _, left, baseline = max(places)
    align = "right" if left > _LEFT + 4 else "left"
    return Text(word, left + (width if align == "right" else 0.0), baseline, 11, align, GUIDE)


def _curve(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of a polyline; a single one becomes a dash."""
    if x.size == 1:
        x, y = np.array([x[0] - 8.0, x[0]]), np.repeat(y, 2)
    return np.stack([x, y], axis=1)


def _axis(low: float, high: float, start: float, end: float) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    return lambda values: start + (np.asarray(values, np.float64) - low) * ((end - start) / (high - low))


def _grid(
    drawing: Drawing,
    place: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    up: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    x_range: tuple[float, float],
    y_range: tuple[float, float],
    top: float,
    bottom: float,
    most: int = 6,
) -> None:
    for tick in round_ticks(*x_range, 8):
        at = float(place(np.array([tick]))[0])
        drawing.segment(at, top, at, bottom, GRID)
        drawing.add(Text(label(tick), at, bottom + 16, 12, "center"))
    for tick in round_ticks(*y_range, most):
        at = float(up(np.array([tick]))[0])
        drawing.segment(_LEFT, at, _RIGHT, at, GRID)
        drawing.add(Text(label(tick), _LEFT - 6, at + 4, 12, "right"))
    drawing.frame(_LEFT, top, _RIGHT, bottom)
