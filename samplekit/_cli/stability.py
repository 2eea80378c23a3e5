"""``samplekit stability``: whether estimates are right where scenes are stiff, and where not, why."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from samplekit.commands._completion import complete_sampler, complete_scene
from samplekit.commands._options import JsonOption, SeedOption

_CHECK_FAILED = 3


def stability(
    samplers: Annotated[
        list[str] | None,
        typer.Option(
            "--sampler",
            "-s",
            metavar="NAME[:OPTION=VALUE,...][+RANDOMIZER]",
            help="A sampler; may be repeated. By default random, jittered, correlated-multi-jittered, halton+owen and"
            " sobol+owen.",
            autocompletion=complete_sampler,
        ),
    ] = None,
    scenes: Annotated[
        list[str] | None,
        typer.Option(
            "--scene",
            metavar="NAME[:OPTION=VALUE,...]",
            help="A scene; may be repeated. A name alone: all the extremes that it declares. By default all scenes.",
            autocompletion=complete_scene,
        ),
    ] = None,
    counts: Annotated[
        str, typer.Option("--count", "-n", metavar="LIST", help="Samples of an estimate, such as 16,256 or 2^4..2^16.")
    ] = "2^4,2^8,2^12,2^16",
    realizations: Annotated[
        str, typer.Option("--realizations", metavar="R", help="Independent estimates of each cell.")
    ] = "32",
    seed: SeedOption = "0",
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="DIR", help="A folder for heat maps and a table of all numbers.")
    ] = "",
    json: JsonOption = False,
) -> int:
    """Sweep scenes from mild to stiff: exit status 3 if an estimate is wrong and nothing says why.

    Each cell compares estimates with the exact mean, in units of their own standard error and against a run in
    extended precision from the same points.

    Example: samplekit stability --scene gaussian --sampler sobol+owen
    """
    from samplekit._errors import UsageError
    from samplekit.commands import parse_count, parse_counts, parse_seed
    from samplekit.commands._notices import announce_compilation
    from samplekit.commands._progress import Progress

    number, start = parse_count(realizations, "realizations"), parse_seed(seed)
    counted = parse_counts(counts, "count")
    folder = Path(output) if output else None
    if folder is not None and not folder.is_dir():
        raise UsageError(f"--output {output}: there is no such folder")
    announce_compilation()
    from samplekit._stability import report
    from samplekit._stability.sweep import SAMPLERS, scenes_of, sweep

    chosen = scenes_of(list(dict.fromkeys(scenes or ())))
    with Progress("sweeping") as progress:
        cells = sweep(
            chosen,
            list(dict.fromkeys(samplers or SAMPLERS)),
            counted,
            realizations=number,
            seed=start,
            progress=progress,
        )
    files = report.write(folder, cells, number, start) if folder else []
    if json:
        from json import dumps

        typer.echo(dumps(report.as_json(cells, number, start, files), allow_nan=False))
    else:
        for line in report.table(cells):
            typer.echo(line)
        for file in files:
            typer.echo(f"wrote {file}")
    return _CHECK_FAILED if any(cell.verdict.kind == "wrong" for cell in cells) else 0
