"""The files of a spectrum: STEM.exr with the numbers, pictures, and the radial mean as CSV and plots. All or none."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit import UsageError
from samplekit.files import check_targets, parts_writer, shown, text_writer, write_group
from samplekit.plots import figure_writer
from samplekit_spectrum.frequencies import Cube, Listed
from samplekit_spectrum.map_display import MapDisplay
from samplekit_spectrum.radial_display import RadialDisplay
from samplekit_spectrum.tables import listed_csv, radial_csv

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit.files import Writer
    from samplekit.plots import Display
    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.spectrum import Spectrum

MAPS = (".exr", ".png")
RADIAL = (".radial.csv", ".radial.png", ".radial.svg")


def check_stem(output: str, name: str, endings: Sequence[str]) -> Path:
    """Find the stem of the files, and check that they can be written before any work is done.

    Parameters
    ----------
    output
        A folder, ``STEM.exr``, or nothing for the current folder.
    name
        Last part of the stem in a folder.
    endings
        Of the files.

    Raises
    ------
    UsageError
        Neither a folder nor ``STEM.exr``, or files that cannot be written there.
    """
    path = Path(output)
    try:
        is_folder = path.is_dir()
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write to {shown(path)}: {error}") from None
    if is_folder:
        stem = path / name.replace(":", "-").replace("/", "-")
    elif path.suffix == ".exr" and not output.endswith(("/", "\\")):
        stem = path.with_suffix("")
    else:
        raise UsageError(f"cannot write to {shown(path)}: it is neither a folder that exists nor ends in .exr")
    check_targets([_named(stem, ending) for ending in endings])
    return stem


def endings(dims: int, spectra: int, *, listed: bool) -> tuple[str, ...]:
    """The endings of the files of such spectra."""
    if listed:
        return (".csv",)
    pictures = MAPS if dims > 1 else MAPS[:1]
    return pictures + (RADIAL if spectra == 1 else RADIAL[:1])


def write_spectra(stem: Path, spectra: Sequence[Spectrum], metadata: dict[str, Any], scale: float | None) -> list[Path]:
    """Write the files of the projections of the same sets."""
    first = spectra[0]
    if isinstance(first.frequencies, Listed):
        return _write({".csv": text_writer([listed_csv(spectra)])}, stem)
    cube = first.frequencies
    writers: dict[str, Writer] = {".exr": parts_writer(_parts(spectra), metadata)}
    if cube.dims > 1:
        display = MapDisplay.from_spectra(spectra, scale)
        _add_pictures(writers, display, {**metadata, "picture": display.facts}, [".png"])
    writers[".radial.csv"] = text_writer([radial_csv(spectra)])
    if len(spectra) == 1:
        _add_pictures(writers, RadialDisplay.from_spectrum(first), metadata, RADIAL[1:])
    return _write(writers, stem)


def write_error_spectrum(stem: Path, spectrum: ErrorSpectrum, metadata: dict[str, Any], name: str) -> list[Path]:
    """Write the files of an error image's spectrum."""
    power = np.where(np.isnan(spectrum.power), 0.0, spectrum.power)
    title = f"error of {name}: {spectrum.verdict}"
    writers: dict[str, Writer] = {".exr": parts_writer({"power": power}, metadata)}
    _add_pictures(writers, MapDisplay.from_error(spectrum, title), metadata, [".png"])
    writers[".radial.csv"] = text_writer([radial_csv([spectrum])])
    _add_pictures(writers, RadialDisplay.from_error(spectrum, title), metadata, RADIAL[1:])
    return _write(writers, stem)


def _write(writers: dict[str, Writer], stem: Path) -> list[Path]:
    items = [(_named(stem, ending), writer) for ending, writer in writers.items()]
    write_group(items)
    return [path for path, _ in items]


def _add_pictures(
    writers: dict[str, Writer], display: Display, metadata: dict[str, Any], endings: Sequence[str]
) -> None:
    figure = display.plot().figure_
    for ending in endings:
        writers[ending] = figure_writer(figure, "." + ending.rpartition(".")[2], metadata)


def _parts(spectra: Sequence[Spectrum]) -> dict[str, Any]:
    """Mean and standard error, a part each; of three dimensions each slice from 0 on, which the others mirror."""
    parts = {}
    for spectrum in spectra:
        cube = spectrum.frequencies
        assert isinstance(cube, Cube)
        suffix = "" if len(spectra) == 1 else "." + "-".join(str(axis) for axis in spectrum.project)
        for name, values in (("mean", spectrum.mean), ("standard-error", spectrum.standard_error)):
            if cube.dims == 3:
                for z in range(cube.reach + 1):
                    parts[f"{name}{suffix}.slice{z}"] = values[cube.reach + z]
            else:
                parts[name + suffix] = np.atleast_2d(values)
    return parts


def _named(stem: Path, ending: str) -> Path:
    # Not with_suffix: a stem may have a dot of its own.
    return stem.parent / (stem.name + ending)
