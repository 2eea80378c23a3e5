"""``samplekit points``: the points of a sampler as text, as an array or as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands._options import JsonOption, SamplerOption, SeedOption

if TYPE_CHECKING:
    from samplekit._configured.sampler import ConfiguredSampler

SCHEMA = "samplekit.points/1"


def points(
    sampler: SamplerOption,
    count: Annotated[str, typer.Option("--count", "-n", metavar="N", help="Points of a set, such as 16 or 2^4.")],
    dims: Annotated[int, typer.Option("--dims", "-d", metavar="D", help="Dimensions.")] = 2,
    realizations: Annotated[
        int, typer.Option("--realizations", metavar="R", help="Independent sets; a picture shows one.")
    ] = 1,
    seed: SeedOption = "0",
    output: Annotated[
        str,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="A file that ends in .csv, .plain.csv (coordinates alone, as Samplin' Safari reads), .npy, .dat or"
            " .bin (UTK's), .svg, .png or .pdf; without it CSV goes to standard output.",
        ),
    ] = "",
    json: JsonOption = False,
) -> int:
    """Print the points of a sampler, or write them as text, as an array, or as a picture.

    A picture shows the grids in which the sampler promises as many points in each cell as in any other.

    Example: samplekit points --sampler jittered --count 96 --output jittered.svg
    """
    from pathlib import Path

    from samplekit._memory import check_memory
    from samplekit.commands import parse_count, parse_seed
    from samplekit.commands._notices import announce_compilation
    from samplekit.commands._progress import Progress
    from samplekit.files._pointsets.write import PICTURES, check_path, write_points

    path = Path(output) if output else None
    picture = path is not None and check_path(path, realizations) in PICTURES
    if picture:
        from samplekit.plots._points import PointsDisplay, check_dims

        check_dims(dims)
    number, start = parse_count(count, "count"), parse_seed(seed)
    announce_compilation()
    from samplekit._configured.sampler import sampler as configured_sampler
    from samplekit.files._pointsets.csv import csv_text

    source = configured_sampler(sampler)
    source.check(number, dims)
    # A float64 as the sampler makes it, and another in the order of the output.
    check_memory(2 * 8 * number * dims * realizations, "these points")
    with Progress("preparing") as progress:
        source.prepare(number, dims, progress)
    values = source.points(number, dims, realizations=realizations, seed=start)
    if path is not None:
        with Progress("writing") as progress:
            if picture:
                PointsDisplay.of_set(source, values[0], start).save(path, _metadata(source, number, dims, start))
            else:
                write_points(values, path, progress=progress)
    if json:
        from json import dumps

        report: dict[str, Any] = {
            "schema": SCHEMA,
            "sampler": source.text,
            "count": number,
            "dims": dims,
            "realizations": realizations,
            "seed": start,
            "files": [str(path)] if path is not None else [],
        }
        if path is None:
            report["points"] = values.tolist()
        typer.echo(dumps(report, allow_nan=False))
    elif path is not None:
        typer.echo(str(path))
    else:
        for piece in csv_text(values):
            typer.echo(piece, nl=False)
    return 0


def _metadata(source: ConfiguredSampler, count: int, dims: int, seed: int) -> dict[str, Any]:
    """How a picture's points were made; the same for the same command, so no times and no paths."""
    import shlex

    from samplekit._provenance import versions

    words = ["samplekit", "points", "--sampler", source.text, "--count", str(count), "--dims", str(dims)]
    words += ["--seed", str(seed)]
    return {
        "schema": SCHEMA,
        "command": shlex.join(words),
        "versions": versions(),
        # As text, as in the images of renderings: many JSON readers round integers beyond 2^53.
        "seed": str(seed),
        "sampler": source.text,
        "sampler_plugin": str(source.plugin),
        "sampler_notes": source.notes(count, dims),
        "count": count,
        "dims": dims,
        "realizations": 1,
    }
