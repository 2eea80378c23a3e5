"""Write the files of a spectrum, all or none: STEM.exr with the numbers, pictures, the radial mean as CSV and plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit.files import parts_writer, text_writer, write_stem
from samplekit.plots import figure_writer
from samplekit_spectrum.frequencies import Cube
from samplekit_spectrum.map_display import MapDisplay
from samplekit_spectrum.radial_display import RadialDisplay
from samplekit_spectrum.tables import listed_csv, radial_csv

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from samplekit.files import Writer
    from samplekit.plots import Display
    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.spectrum import Spectrum

MAPS = (".exr", ".png")
RADIAL = (".radial.csv", ".radial.png", ".radial.svg")


def endings(dims: int, spectra: int, *, listed: bool) -> tuple[str, ...]:
    """Return the endings of the files that :func:`write_spectra` writes."""
    if listed:
        return (".csv",)
    pictures = MAPS if dims > 1 else MAPS[:1]
    return pictures + (RADIAL if spectra == 1 else RADIAL[:1])


def write_spectra(stem: Path, spectra: Sequence[Spectrum], metadata: dict[str, Any], scale: float | None) -> list[Path]:
    """Write the files of several projections of the same sets."""
    first = spectra[0]
    if not isinstance(first.frequencies, Cube):
        return write_stem(stem, {".csv": text_writer([listed_csv(spectra)])})
    writers: dict[str, Writer] = {".exr": parts_writer(_parts(spectra), metadata)}
    if first.frequencies.dims > 1:
        display = MapDisplay.from_spectra(spectra, scale)
        _add_pictures(writers, display, {**metadata, "picture": display.facts}, [".png"])
    writers[".radial.csv"] = text_writer([radial_csv(spectra)])
    if len(spectra) == 1:
        _add_pictures(writers, RadialDisplay.from_spectrum(first), metadata, RADIAL[1:])
    return write_stem(stem, writers)


def write_error_spectrum(stem: Path, spectrum: ErrorSpectrum, metadata: dict[str, Any], name: str) -> list[Path]:
    """Write the files of an error image's spectrum."""
    power = np.where(np.isnan(spectrum.power), 0.0, spectrum.power)
    title = f"error of {name}: {spectrum.verdict}"
    writers: dict[str, Writer] = {".exr": parts_writer({"power": power}, metadata)}
    _add_pictures(writers, MapDisplay.from_error(spectrum, title), metadata, [".png"])
    writers[".radial.csv"] = text_writer([radial_csv([spectrum])])
    _add_pictures(writers, RadialDisplay.from_error(spectrum, title), metadata, RADIAL[1:])
    return write_stem(stem, writers)


def _add_pictures(
    writers: dict[str, Writer], display: Display, metadata: dict[str, Any], endings: Sequence[str]
) -> None:
    figure = display.plot().figure_
    for ending in endings:
        writers[ending] = figure_writer(figure, ending.removeprefix(".radial"), metadata)


def _parts(spectra: Sequence[Spectrum]) -> dict[str, Any]:
    """Return mean and standard error as parts of an EXR file.

    A spectrum of three dimensions has a part for each slice from 0 on; the other slices are their mirror images.
    """
    parts: dict[str, Any] = {}
    for spectrum in spectra:
        suffix = "" if len(spectra) == 1 else "." + "-".join(map(str, spectrum.project))
        for name, values in (("mean", spectrum.mean), ("standard-error", spectrum.standard_error)):
            if values.ndim == 3:
                middle = values.shape[0] // 2
                parts |= {f"{name}{suffix}.slice{z}": plane for z, plane in enumerate(values[middle:])}
            else:
                parts[name + suffix] = np.atleast_2d(values)
    return parts
