"""``samplekit spectrum``: the expected power spectrum of a sampler, or the spectrum of an error image."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands import DONE, INTERRUPTED, JsonOption, SamplerOption, SeedOption

if TYPE_CHECKING:
    from samplekit import ConfiguredSampler
    from samplekit_spectrum.spectrum import Spectrum

SCHEMA = "samplekit.spectrum/1"
IMAGE_SCHEMA = "samplekit.error-spectrum/1"
QUANTITY = "E|S(m)|^2 with S(m) = (1/N) sum exp(-2 pi i m.x)"


def spectrum(
    sampler: SamplerOption = "",
    count: Annotated[str, typer.Option("--count", "-n", metavar="N", help="Points of a set, such as 256 or 2^8.")] = "",
    realizations: Annotated[
        str, typer.Option("--realizations", "-r", metavar="R", help="Number of independent sets in the mean.")
    ] = "100",
    max_frequency: Annotated[
        str,
        typer.Option("--max-frequency", "-f", metavar="F", help="Largest frequency; by default about 4 sqrt N."),
    ] = "",
    dims: Annotated[str, typer.Option("--dims", "-d", metavar="D", help="Dimensions of the sets; by default 2.")] = "",
    project: Annotated[
        str,
        typer.Option("--project", metavar="I,J", help="Dimensions to project on, from 0; 'all': every pair."),
    ] = "",
    homogenize: Annotated[
        bool, typer.Option("--homogenize", help="Follow the sampler with a random toroidal shift, as +shift does.")
    ] = False,
    step: Annotated[
        str, typer.Option("--step", metavar="H", help="Distance of neighbouring frequencies; by default 1.")
    ] = "",
    frequencies: Annotated[
        str,
        typer.Option("--frequencies", metavar="X,Y;X,Y;...", help="Only these frequencies, of any size up to 2^40."),
    ] = "",
    image: Annotated[
        str,
        typer.Option("--image", metavar="FILE.exr", help="Show the spectrum of this rendering's error instead."),
    ] = "",
    scale: Annotated[
        str,
        typer.Option("--scale", metavar="P", help="N times the power that is drawn white; by default 2."),
    ] = "",
    seed: SeedOption = "0",
    output: Annotated[
        str,
        typer.Option("--output", "-o", metavar="PATH", help="A folder, or STEM.exr; by default the current folder."),
    ] = "",
    threads: Annotated[
        str, typer.Option("--threads", "-t", metavar="T", help="Threads; by default one for each processor.")
    ] = "",
    json: JsonOption = False,
) -> int:
    """Show the expected power spectrum E|S(m)|^2 of a sampler, S(m) = 1/N sum exp(-2 pi i m.x).

    Writes STEM.exr (mean and standard error), STEM.png, and the radial mean as STEM.radial.csv, .png and .svg.

    Example: samplekit spectrum --sampler jittered --count 256
    """
    from samplekit import UsageError

    if image:
        if sampler or count:
            raise UsageError("--image takes no --sampler and no --count: it shows the spectrum of a rendering's error")
        return _spectrum_of_image(image, output, json)
    if not sampler or not count:
        raise UsageError("expected --sampler and --count, or --image")
    from samplekit.commands import announce_compilation

    announce_compilation()
    import time

    import samplekit
    from samplekit.commands import Progress, parse_count, parse_seed
    from samplekit.files import check_stem
    from samplekit_spectrum.cli.values import parse_positive, parse_projections, parse_vectors
    from samplekit_spectrum.frequencies import Cube
    from samplekit_spectrum.homogenized import homogenized
    from samplekit_spectrum.map_display import counted
    from samplekit_spectrum.output import endings, write_spectra
    from samplekit_spectrum.spectrum import powers
    from samplekit_spectrum.tables import finite, spectrum_json, spectrum_lines

    number = parse_count(count, "count")
    size = parse_count(dims, "dims") if dims else None
    projects = parse_projections(project, size)
    listed = parse_vectors(frequencies) if frequencies else None
    white = parse_positive(scale, "scale") if scale else None
    chosen = samplekit.sampler(sampler)
    width = len(projects[0]) if projects[0] is not None else size or 2
    name = homogenized(chosen).text if homogenize else chosen.text
    stem = check_stem(output, f"spectrum-{name}-{number}", endings(width, len(projects), listed=listed is not None))
    began = time.perf_counter()
    with Progress("spectra") as progress:
        spectra = powers(
            chosen,
            number,
            projects,
            realizations=parse_count(realizations, "realizations"),
            max_frequency=parse_count(max_frequency, "max-frequency") if max_frequency else None,
            step=parse_positive(step, "step") if step else 1.0,
            frequencies=listed,
            dims=size,
            homogenize=homogenize,
            seed=parse_seed(seed),
            threads=parse_count(threads, "threads") if threads else None,
            progress=progress,
            keep_interrupted=bool(output),
        )
    seconds = time.perf_counter() - began
    first = spectra[0]
    described = [spectrum_json(one) for one in spectra]
    metadata = {**_metadata(first, homogenize, project, chosen), "bias": [one["bias"] for one in described]}
    files = write_spectra(stem, spectra, finite(metadata), white)
    sets = counted(first.realizations, "realization") if first.randomized else "one set: it is not random"
    lines = [f"{first.sampler}, {first.count} points in {first.dims}D, {sets}, seed {first.seed}"]
    lines += [line for one in spectra for line in spectrum_lines(one)]
    report: dict[str, Any] = {
        **_facts(first),
        "quantity": QUANTITY,
        "spectra": described,
        "seconds": seconds,
        "files": [str(file) for file in files],
    }
    if isinstance(first.frequencies, Cube):
        report["max_frequency"], report["step"] = first.frequencies.reach, first.frequencies.step
    _show(report, [*lines, f"  {'seconds':<16}{seconds:.3f}"], json)
    if first.interrupted:
        done = f"{first.realizations} of {first.requested} realizations"
        typer.echo(f"samplekit: interrupted after {done}, which are kept", err=True)
        return INTERRUPTED
    return DONE


def _show(report: dict[str, Any], lines: list[str], as_json: bool) -> None:
    """Print the report as JSON, or lines and the files of the report."""
    if as_json:
        from json import dumps

        from samplekit_spectrum.tables import finite

        typer.echo(dumps(finite(report), allow_nan=False))
        return
    for line in [*lines, *(f"  {'wrote':<16}{file}" for file in report["files"])]:
        typer.echo(line)


def _facts(spectrum: Spectrum) -> dict[str, Any]:
    names = ("sampler", "count", "dims", "realizations", "requested", "interrupted", "randomized", "seed")
    return {"schema": SCHEMA, **{name: getattr(spectrum, name) for name in names}}


def _metadata(spectrum: Spectrum, homogenize: bool, project: str, chosen: ConfiguredSampler) -> dict[str, Any]:
    """Return how the spectrum was made, without times and paths: the same for the same command."""
    from importlib.metadata import version

    from samplekit import versions
    from samplekit_spectrum.frequencies import Cube

    words = [f"samplekit spectrum --sampler {chosen.text} --count {spectrum.count}"]
    words.append(f"--realizations {spectrum.requested} --dims {spectrum.dims}")
    cube = spectrum.frequencies
    if isinstance(cube, Cube):
        words.append(f"--max-frequency {cube.reach}" + (f" --step {cube.step!r}" if cube.step != 1.0 else ""))
    words += [f"--project {project}"] * bool(project) + ["--homogenize"] * homogenize + [f"--seed {spectrum.seed}"]
    return {
        **_facts(spectrum),
        "seed": str(spectrum.seed),
        "command": " ".join(words),
        "versions": versions() | {"ducc0": version("ducc0"), "samplekit-spectrum": version("samplekit-spectrum")},
        "sampler_plugin": str(chosen.plugin),
        "sampler_notes": chosen.fresh().notes(spectrum.count, spectrum.dims),
        "quantity": f"{QUANTITY}; DC, which is 1, in the middle",
    }


def _spectrum_of_image(image: str, output: str, as_json: bool) -> int:
    from pathlib import Path

    from samplekit import versions
    from samplekit.files import check_stem
    from samplekit_spectrum.error_image import error_spectrum, read_error
    from samplekit_spectrum.output import MAPS, RADIAL, write_error_spectrum
    from samplekit_spectrum.tables import error_lines, finite, radial_json

    path = Path(image)
    stem = check_stem(output, f"spectrum-{path.stem}", MAPS + RADIAL)
    found = error_spectrum(read_error(path))
    height, width = found.power.shape
    facts: dict[str, Any] = {
        "schema": IMAGE_SCHEMA,
        "image": path.name,
        "size": [width, height],
        "verdict": found.verdict,
        "low": found.low,
        "low_standard_error": found.low_standard_error,
        "rmse": found.rmse,
        "bias": found.bias,
    }
    files = write_error_spectrum(stem, found, finite({**facts, "versions": versions()}), path.name)
    report = {**facts, "radial": radial_json(found.radial), "files": [str(file) for file in files]}
    _show(report, [f"error of {path.name}, {width}x{height}", *error_lines(found)], as_json)
    return DONE
