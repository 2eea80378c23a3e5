"""``samplekit points``: the points of a sampler as text, as an array or as a picture."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from samplekit.commands import JsonOption, SamplerOption, SeedOption

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
    import samplekit
    from samplekit.commands import Stages, announce_compilation, fact_lines, parse_count, parse_seed, plugin_facts

    number, start = parse_count(count, "count"), parse_seed(seed)
    announce_compilation()
    source = samplekit.sampler(sampler)
    with Stages() as progress:
        values = samplekit.points(
            source, number, dims, realizations=realizations, seed=start, output=output or None, progress=progress
        )
    facts = plugin_facts(values)
    if json:
        from json import dumps

        report: dict[str, Any] = {
            "schema": SCHEMA,
            "sampler": source.text,
            "count": number,
            "dims": dims,
            "realizations": realizations,
            "seed": start,
            "files": [output] if output else [],
        }
        if not output:
            report["points"] = values.tolist()
        typer.echo(dumps(report | facts, allow_nan=False))
        return 0
    if output:
        typer.echo(output)
    else:
        from samplekit.files import csv_text

        for piece in csv_text(values):
            typer.echo(piece, nl=False)
    for line in fact_lines(facts):
        typer.echo(line, err=not output)
    return 0
