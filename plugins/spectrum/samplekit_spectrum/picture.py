"""Spectra as pictures: N times the power in grey on a stated scale, DC left out, with axes and a bar of the greys."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from samplekit._drawing.drawing import Bitmap, Drawing, Text, label, rgb
from samplekit._drawing.raster import draw_pixels
from samplekit.files import write_png
from samplekit_spectrum.frequencies import Cube

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from samplekit_spectrum.spectrum import Spectrum

SCALE = 2.0
"""N times the power that is drawn white: white noise is in the middle."""

BEYOND = "#f5a623"
MISSING = "#7fa8d9"
_MARGIN, _LEFT, _GAP, _SIZE = 24, 62, 58, 13
_LARGEST_PANEL = 1026
_LEAST = {1: 512, 2: 300}


class Panel(NamedTuple):
    """One map float64[h, w] of N times the power (NaN is left out), its title, what its axes are and their ends."""

    values: NDArray[np.float64]
    title: str
    axes: str
    ends: tuple[float, float]


def spectrum_picture(
    spectra: Sequence[Spectrum], scale: float | None = None
) -> tuple[NDArray[np.uint8], dict[str, Any]]:
    """Draw spectra of two dimensions, or slices of one of three.

    Parameters
    ----------
    spectra
        Of the same sets: one, or all pairs of dimensions as a lower triangle.
    scale
        N times the power that is drawn white; larger values are orange, and counted. None: 2.

    Returns
    -------
    pixels
        uint8[h, w, 3], encoded as sRGB.
    facts
        ``scale``, ``largest``, ``beyond``, ``reduced``: what the picture states, for metadata.
    """
    white = SCALE if scale is None else scale
    panels, places = _panels(spectra)
    return _drawn(panels, places, white, headline_of(spectra[0]), condition_of(spectra[0]))


def maps_picture(
    panels: Sequence[Panel], headline: str, condition: str, words: tuple[str, str], scale: float = SCALE
) -> NDArray[np.uint8]:
    """Draw maps side by side; ``words``: what is drawn, and what is left out."""
    places = [(0, column) for column in range(len(panels))]
    return _drawn(list(panels), places, scale, headline, condition, words)[0]


def png_bytes(pixels: NDArray[np.uint8]) -> bytes:
    """Return the pixels as a PNG file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        write_png(path, pixels, {})
        return path.read_bytes()


def headline_of(spectrum: Spectrum) -> str:
    """Say which sets the spectrum is of."""
    points = "1 point" if spectrum.count == 1 else f"{spectrum.count} points"
    return f"{spectrum.sampler}, {points}"


def condition_of(spectrum: Spectrum) -> str:
    """Say how many sets the mean is over."""
    if not spectrum.randomized:
        return "one set: it is not random"
    sets = "1 realization" if spectrum.realizations == 1 else f"{spectrum.realizations} realizations"
    return f"mean of {sets}" + (f", interrupted: {spectrum.requested} were asked for" if spectrum.interrupted else "")


def _panels(spectra: Sequence[Spectrum]) -> tuple[list[Panel], list[tuple[int, int]]]:
    panels, places = [], []
    for spectrum in spectra:
        cube = spectrum.frequencies
        assert isinstance(cube, Cube)
        values = spectrum.normalized
        values.reshape(-1)[values.size // 2] = np.nan
        end = cube.reach * cube.step
        axes = f"frequency along x{spectrum.project[0]}; down: x{spectrum.project[1]}"
        if cube.dims == 3:
            slices = slice_numbers(cube.reach)
            columns = min(len(slices), 3)
            for number, z in enumerate(slices):
                title = f"frequency {label(z * cube.step)} along x{spectrum.project[2]}"
                panels.append(Panel(values[cube.reach + z], title, axes, (-end, end)))
                places.append(divmod(number, columns))
            continue
        title = f"x{spectrum.project[0]}, x{spectrum.project[1]}" if len(spectra) > 1 else ""
        panels.append(Panel(values, title, axes, (-end, end)))
        place = (spectrum.project[1] - 1, spectrum.project[0]) if len(spectra) > 1 else (0, 0)
        places.append(place)
    return panels, places


def slice_numbers(reach: int) -> list[int]:
    """Up to six slices of a cube: 0, 1, 2, 4, ... and the last."""
    numbers = [0, *(2**power for power in range(reach.bit_length()) if 2**power <= reach)]
    return numbers if len(numbers) <= 6 else [0, 1, *numbers[-4:]]


def _drawn(
    panels: list[Panel],
    places: list[tuple[int, int]],
    white: float,
    headline: str,
    condition: str,
    words: tuple[str, str] = ("N times the power; white noise is 1", "DC (which is N)"),
) -> tuple[NDArray[np.uint8], dict[str, Any]]:
    maps = [_sized(panel.values, 512 if len(panels) == 1 else 256) for panel in panels]
    side_y, side_x, _ = (
        max(sizes) for sizes in zip(*((*values.shape, factor) for values, factor in maps), strict=True)
    )
    rows, columns = (max(place[axis] for place in places) + 1 for axis in (0, 1))
    finite = np.concatenate([panel.values[np.isfinite(panel.values)] for panel in panels])
    largest = float(finite.max(initial=0.0))
    beyond = int((finite > white).sum())
    reduced = max(-factor for _, factor in maps)
    # Titles of panels take a line of their own.
    above = 22 if any(panel.title for panel in panels) else 6
    top = _MARGIN + 44
    cell_x, cell_y = side_x + _GAP, side_y + above + 46
    width = max(_LEFT + columns * cell_x + 30, 560)
    height = top + rows * cell_y + 84
    drawing = Drawing(width, height, headline)
    drawing.add(Text(headline, _MARGIN, _MARGIN + 12, 18), Text(condition, _MARGIN, _MARGIN + 33, _SIZE))
    for panel, (values, _), (row, column) in zip(panels, maps, places, strict=True):
        _draw_panel(drawing, panel, values, _LEFT + column * cell_x, top + row * cell_y + above, white)
    _draw_bar(drawing, top + rows * cell_y + 8, white, largest, beyond, reduced, words)
    facts = {"scale": white, "largest": largest, "beyond": beyond, "reduced": max(reduced, 1)}
    return draw_pixels(drawing), facts


def _sized(values: NDArray[np.float64], least: int) -> tuple[NDArray[np.float64], int]:
    """Enlarge by a whole factor, or take the means of blocks; the second value is 0, or the block's side negated."""
    side = max(values.shape)
    if side <= _LARGEST_PANEL:
        factor = max(1, round(least / side))
        return np.repeat(np.repeat(values, factor, axis=0), factor, axis=1), 0
    block = -(-side // _LARGEST_PANEL)
    padded = [-(-size // block) * block for size in values.shape]
    full = np.full(padded, np.nan)
    full[: values.shape[0], : values.shape[1]] = values
    blocks = full.reshape(padded[0] // block, block, padded[1] // block, block)
    present = np.isfinite(blocks)
    means = np.where(present, blocks, 0.0).sum(axis=(1, 3)) / np.maximum(present.sum(axis=(1, 3)), 1)
    return means, -block


def colours(values: NDArray[np.float64], white: float) -> NDArray[np.uint8]:
    """The code of each grey is proportional to its value, so that the eye sees equal steps: uint8[..., 3]."""
    missing = ~np.isfinite(values)
    levels = np.rint(255.0 * np.clip(np.where(missing, 0.0, values) / white, 0.0, 1.0)).astype(np.uint8)
    pixels = np.repeat(levels[..., None], 3, axis=-1)
    pixels[np.where(missing, 0.0, values) > white] = rgb(BEYOND)
    pixels[missing] = rgb(MISSING)
    return pixels


def _draw_panel(drawing: Drawing, panel: Panel, values: NDArray[np.float64], left: int, top: int, white: float) -> None:
    height, width = values.shape
    drawing.add(Bitmap(colours(values, white), left, top))
    drawing.frame(left - 1, top - 1, left + width, top + height)
    if panel.title:
        drawing.add(Text(panel.title, left + width / 2, top - 7, _SIZE, "center"))
    low, high = panel.ends
    for share in (0.0, 0.5, 1.0):
        value = label(low + share * (high - low))
        align = {0.0: "left", 0.5: "center", 1.0: "right"}[share]
        drawing.add(Text(value, left + share * (width - 1), top + height + 16, 12, align))
        drawing.add(Text(value, left - 6, top + 10 + share * (height - 10), 12, "right"))
    drawing.add(Text(panel.axes, left + width / 2, top + height + 31, 12, "center"))


def _draw_bar(
    drawing: Drawing, top: int, white: float, largest: float, beyond: int, reduced: int, words: tuple[str, str]
) -> None:
    length = 240
    ramp = np.tile(np.linspace(0.0, white, length), (14, 1))
    drawing.add(Bitmap(colours(ramp, white), _MARGIN, top))
    drawing.frame(_MARGIN - 1, top - 1, _MARGIN + length, top + 14)
    for share in (0.0, 0.5, 1.0):
        align = {0.0: "left", 0.5: "center", 1.0: "right"}[share]
        drawing.add(Text(label(share * white), _MARGIN + share * (length - 1), top + 29, 12, align))
    second = f"largest {label(largest)}"
    if reduced > 1:
        second += f"; each pixel the mean of {reduced} x {reduced} frequencies"
    lines: list[tuple[str, str | None]] = [(words[0], None), (second, None)]
    if beyond:
        lines.append((f"{beyond} frequencies beyond the scale", BEYOND))
    lines.append((f"{words[1]} left out", MISSING))
    x, y = _MARGIN + length + 20, top + 11
    for text, colour in lines:
        if colour:
            drawing.add(Bitmap(np.full((11, 11, 3), rgb(colour), np.uint8), x, round(y - 10)))
        drawing.add(Text(text, x + (16 if colour else 0), y, 12))
        y += 16
