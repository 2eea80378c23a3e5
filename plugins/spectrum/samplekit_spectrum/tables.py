"""Spectra as tables: CSV, and lines for a terminal."""

from __future__ import annotations

import csv
import html
import io
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit_spectrum.frequencies import Listed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit_spectrum.error_image import ErrorSpectrum
    from samplekit_spectrum.radial import Radial
    from samplekit_spectrum.spectrum import Spectrum


def radial_csv(spectra: Sequence[Spectrum | ErrorSpectrum]) -> str:
    """The radial means, a row for each ring: power is E|S|^2, without the factor N."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    several = len(spectra) > 1
    head = ["frequency", "frequencies", "power", "standard_error", "anisotropy_db"]
    writer.writerow(["project", *head] if several else head)
    for spectrum in spectra:
        name = ["-".join(map(str, getattr(spectrum, "project", ())))] if several else []
        for row in _rows(spectrum.radial):
            writer.writerow([*name, *row])
    return text.getvalue()


def _rows(radial: Radial) -> list[list[Any]]:
    columns = (radial.frequency, radial.frequencies, radial.power, radial.standard_error, radial.anisotropy)
    return [
        [repr(value) if isinstance(value, float) else value for value in row]
        for row in zip(*map(_listed, columns), strict=True)
    ]


def _listed(column: Any) -> list[Any]:
    return list(column.tolist())


def listed_csv(spectra: Sequence[Spectrum]) -> str:
    """The power at listed frequencies, a row for each."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    several = len(spectra) > 1
    axes = spectra[0].project
    names = [f"m{number if several else axis}" for number, axis in enumerate(axes)]
    head = [*names, "power", "standard_error"]
    writer.writerow(["project", *head] if several else head)
    for spectrum in spectra:
        assert isinstance(spectrum.frequencies, Listed)
        name = ["-".join(map(str, spectrum.project))] if several else []
        for vector, power, error in zip(
            spectrum.frequencies.vectors.tolist(), spectrum.mean.tolist(), spectrum.standard_error.tolist(), strict=True
        ):
            writer.writerow([*name, *map(repr, vector), repr(power), repr(error)])
    return text.getvalue()


def listed_html(spectrum: Spectrum) -> str:
    """The power at listed frequencies as a table for a notebook."""
    head, *rows = csv.reader(io.StringIO(listed_csv([spectrum])))
    lines = ["".join(f"<th>{html.escape(word)}</th>" for word in head)]
    lines += ["".join(f"<td>{float(cell):.10g}</td>" for cell in row) for row in rows]
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def spectrum_lines(spectrum: Spectrum) -> list[str]:
    """Return the lines that the terminal shows of a spectrum."""
    lines = []
    if len(spectrum.project) != spectrum.dims:
        lines.append("projection on " + ", ".join(f"x{axis}" for axis in spectrum.project))
    bias = spectrum.bias
    words = {
        "none found": f"none found: |E S|^2 at most {bias.score:.3g} of its expectation (limit {bias.threshold:.3g})",
        "biased": f"biased: |E S({_vector(bias.frequency)})| = {bias.amplitude:.4g} +- {bias.standard_error:.2g}",
        "too few realizations": "not tested: at least 16 realizations are needed",
    }
    if not spectrum.randomized and bias.verdict == "none found":
        words["none found"] = "none found: S is 0 at all of these frequencies"
    lines.append(f"  {'bias':<16}{words[bias.verdict]}")
    if isinstance(spectrum.frequencies, Listed):
        lines.append(f"  {'frequency':<28}{'N power':>12}{'+-':>12}")
        for vector, power, error in zip(
            spectrum.frequencies.vectors, spectrum.normalized, spectrum.count * spectrum.standard_error, strict=True
        ):
            lines.append(f"  {_vector(vector):<28}{power:>12.5g}{error:>12.2g}")
        return lines
    radial = spectrum.radial
    lines.append(f"  {'ring':<10}{'N power':>12}{'+-':>12}{'anisotropy':>14}")
    last = len(radial.frequency)
    chosen = sorted({min(last, round(2**power)) for power in np.arange(0.0, math.log2(last) + 0.75, 0.75)} | {1, last})
    for ring in chosen:
        power, error = spectrum.count * radial.power[ring - 1], spectrum.count * radial.standard_error[ring - 1]
        decibels = f"{radial.anisotropy[ring - 1]:.1f} dB"
        lines.append(f"  {radial.frequency[ring - 1]:<10.6g}{power:>12.5g}{error:>12.2g}{decibels:>14}")
    return lines


def error_lines(spectrum: ErrorSpectrum) -> list[str]:
    """Return the lines that the terminal shows of an error image's spectrum."""
    lines = [f"  {'verdict':<16}{spectrum.verdict}"]
    if spectrum.verdict != "exact":
        low = f"{spectrum.low:.4g} +- {spectrum.low_standard_error:.2g} of the mean power, below 1/8 a pixel"
        lines.append(f"  {'low frequencies':<16}{low}")
    lines += [f"  {'rmse':<16}{spectrum.rmse:.6g}", f"  {'bias':<16}{spectrum.bias:.6g}"]
    return lines


def _vector(vector: Any) -> str:
    return ",".join(f"{component:.10g}" for component in vector)


def finite(value: float) -> float | None:
    """The number for JSON, which knows neither infinity nor NaN."""
    return float(value) if math.isfinite(value) else None


def radial_json(radial: Radial) -> dict[str, list[float | None]]:
    """The radial mean for JSON."""
    return {
        "frequency": radial.frequency.tolist(),
        "power": [finite(v) for v in radial.power],
        "standard_error": [finite(v) for v in radial.standard_error],
        "anisotropy_db": [finite(v) for v in radial.anisotropy],
    }


def spectrum_json(spectrum: Spectrum) -> dict[str, Any]:
    """A spectrum for JSON."""
    bias = spectrum.bias
    result: dict[str, Any] = {
        "project": list(spectrum.project),
        "dc": 1.0,
        "bias": {
            "verdict": bias.verdict,
            "frequency": list(bias.frequency),
            "amplitude": finite(bias.amplitude),
            "standard_error": finite(bias.standard_error),
            "score": finite(bias.score),
            "threshold": finite(bias.threshold),
            "root_mean_square": finite(bias.root_mean_square),
        },
    }
    if isinstance(spectrum.frequencies, Listed):
        result["frequencies"] = spectrum.frequencies.vectors.tolist()
        result["power"] = spectrum.mean.tolist()
        result["standard_error"] = [finite(v) for v in spectrum.standard_error]
    else:
        result["radial"] = radial_json(spectrum.radial)
    return result
