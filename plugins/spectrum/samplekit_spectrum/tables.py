"""Spectra as tables: CSV, and lines for a terminal."""

from __future__ import annotations

import csv
import html
import io
import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.frequencies import Cube

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from samplekit_spectrum.bias import Bias
    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.radial import Radial
    from samplekit_spectrum.spectrum import Spectrum


def radial_csv(spectra: Sequence[Spectrum | ErrorSpectrum]) -> str:
    """Return the radial means, a row for each ring: power is E|S|^2, without the factor N."""
    head = ["frequency", "frequencies", "power", "standard_error", "anisotropy_db"]
    rings = [spectrum.radial for spectrum in spectra]
    tables = [(ring.frequency, ring.frequencies, ring.power, ring.standard_error, ring.anisotropy) for ring in rings]
    return _csv(head, spectra, tables)


def listed_csv(spectra: Sequence[Spectrum]) -> str:
    """Return the power at listed frequencies, a row for each."""
    axes = spectra[0].project
    names = [f"m{axis}" for axis in (axes if len(spectra) == 1 else range(len(axes)))]
    tables = [(*_vectors(spectrum).T, spectrum.mean, spectrum.standard_error) for spectrum in spectra]
    return _csv([*names, "power", "standard_error"], spectra, tables)


def _csv(head: list[str], spectra: Sequence[Spectrum | ErrorSpectrum], tables: Sequence[Sequence[NDArray[Any]]]) -> str:
    """Return the columns of each spectrum's table as CSV, after its projection where there are several spectra.

    Numbers that are not finite, such as the standard error of a single realisation, are empty.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    several = len(spectra) > 1
    writer.writerow(["project", *head] if several else head)
    for spectrum, columns in zip(spectra, tables, strict=True):
        project = ["-".join(map(str, getattr(spectrum, "project", ())))] if several else []
        for row in zip(*(column.tolist() for column in columns), strict=True):
            writer.writerow([*project, *(value if math.isfinite(value) else None for value in row)])
    return text.getvalue()


def _vectors(spectrum: Spectrum) -> NDArray[np.float64]:
    return spectrum.frequencies.values(0, spectrum.frequencies.half)


def listed_html(spectrum: Spectrum) -> str:
    """Return the power at listed frequencies as an HTML table for a notebook."""
    head, *rows = csv.reader(io.StringIO(listed_csv([spectrum])))
    lines = ["".join(f"<th>{html.escape(word)}</th>" for word in head)]
    lines += ["".join(f"<td>{cell and f'{float(cell):.10g}'}</td>" for cell in row) for row in rows]
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def spectrum_lines(spectrum: Spectrum) -> list[str]:
    """Return the lines that the terminal shows for a spectrum."""
    lines = []
    if len(spectrum.project) != spectrum.dims:
        lines.append("projection on " + ", ".join(f"x{axis}" for axis in spectrum.project))
    lines.append(f"  {'bias':<16}{_bias_text(spectrum.bias, randomized=spectrum.randomized)}")
    if not isinstance(spectrum.frequencies, Cube):
        lines.append(f"  {'frequency':<28}{'N power':>12}{'+-':>12}")
        errors = spectrum.count * spectrum.standard_error
        for vector, power, error in zip(_vectors(spectrum), spectrum.normalized, errors, strict=True):
            lines.append(f"  {_vector(vector):<28}{power:>12.5g}{_known(error, '.2g'):>12}")
        return lines
    radial = spectrum.radial
    lines.append(f"  {'ring':<10}{'N power':>12}{'+-':>12}{'anisotropy':>14}")
    last = len(radial.frequency)
    # The first ring and the last, and about four rings for each factor of 8 between them.
    steps = np.arange(0.0, math.log2(last) + 0.75, 0.75)
    for ring in sorted({min(last, round(2**step)) for step in steps}):
        power, error = spectrum.count * radial.power[ring - 1], spectrum.count * radial.standard_error[ring - 1]
        decibels = f"{_known(radial.anisotropy[ring - 1], '.1f')} dB"
        lines.append(f"  {radial.frequency[ring - 1]:<10.6g}{power:>12.5g}{_known(error, '.2g'):>12}{decibels:>14}")
    return lines


def _known(value: float, digits: str) -> str:
    """Return a number, or a dash for one that is not finite: a single realisation has no standard error."""
    return f"{value:{digits}}" if math.isfinite(value) else "-"


def _bias_text(bias: Bias, *, randomized: bool) -> str:
    if bias.verdict == "too few realizations":
        return "not tested: at least 16 realizations are needed"
    if bias.verdict == "biased":
        return f"biased: |E S({_vector(bias.frequency)})| = {bias.amplitude:.4g} +- {bias.standard_error:.2g}"
    if not randomized:
        return "none found: S is 0 at all of these frequencies"
    return f"none found: |E S|^2 at most {bias.score:.3g} of its expectation (limit {bias.threshold:.3g})"


def error_lines(spectrum: ErrorSpectrum) -> list[str]:
    """Return the lines that the terminal shows for the spectrum of an error image."""
    lines = [f"  {'verdict':<16}{spectrum.verdict}"]
    if spectrum.verdict != "exact":
        low = f"{spectrum.low:.4g} +- {spectrum.low_standard_error:.2g} of the mean power, below 1/8 a pixel"
        lines.append(f"  {'low frequencies':<16}{low}")
    lines += [f"  {'rmse':<16}{spectrum.rmse:.6g}", f"  {'bias':<16}{spectrum.bias:.6g}"]
    return lines


def _vector(vector: Any) -> str:
    return ",".join(f"{component:.10g}" for component in vector)


def finite(value: Any) -> Any:
    """Return data for JSON, which has neither infinity nor NaN: None replaces them, in dictionaries and lists too."""
    if isinstance(value, dict):
        return {name: finite(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def radial_json(radial: Radial) -> dict[str, list[float]]:
    """Return the radial mean as lists."""
    return {
        "frequency": radial.frequency.tolist(),
        "power": radial.power.tolist(),
        "standard_error": radial.standard_error.tolist(),
        "anisotropy_db": radial.anisotropy.tolist(),
    }


def spectrum_json(spectrum: Spectrum) -> dict[str, Any]:
    """Return a spectrum as a dictionary for :func:`finite` and JSON."""
    result: dict[str, Any] = {"project": spectrum.project, "dc": 1.0, "bias": asdict(spectrum.bias)}
    if isinstance(spectrum.frequencies, Cube):
        result["radial"] = radial_json(spectrum.radial)
    else:
        result["frequencies"] = _vectors(spectrum).tolist()
        result["power"] = spectrum.mean.tolist()
        result["standard_error"] = spectrum.standard_error.tolist()
    return result
