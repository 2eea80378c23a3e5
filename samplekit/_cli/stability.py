"""``samplekit stability``: whether estimates of stiff scenes are right, and why they are not."""

from __future__ import annotations

from typing import Annotated

import typer

from samplekit.commands import CHECK_FAILED, JsonOption, SeedOption, complete_sampler, complete_scene


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
            help="A scene; may be repeated. A name alone: all extremes that it declares. By default all scenes.",
            autocompletion=complete_scene,
        ),
    ] = None,
    counts: Annotated[
        str, typer.Option("--count", "-n", metavar="LIST", help="Samples per estimate, such as 16,256 or 2^4..2^16.")
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
    """Sweep scenes from mild to stiff: exit status 3 if an estimate is wrong without an explanation.

    Each cell compares estimates with the exact mean, in units of their own standard error, and with the same estimates
    in extended precision.

    Example: samplekit stability --scene gaussian --sampler sobol+owen
    """
    from samplekit import stability as sweep
    from samplekit.commands import (
        Progress,
        announce_compilation,
        fact_lines,
        parse_count,
        parse_counts,
        parse_seed,
        plugin_facts,
    )

    chosen = {"samplers": samplers} if samplers else {}
    number, start, counted = parse_count(realizations, "realizations"), parse_seed(seed), parse_counts(counts, "count")
    announce_compilation()
    with Progress("sweeping") as progress:
        swept = sweep(
            scenes or (),
            counts=counted,
            realizations=number,
            seed=start,
            output=output or None,
            progress=progress,
            **chosen,
        )
    facts = plugin_facts(swept)
    if json:
        from json import dumps

        typer.echo(dumps(swept.as_json() | facts, allow_nan=False))
    else:
        for line in [*swept.table(), *(f"wrote {file}" for file in swept.files), *fact_lines(facts)]:
            typer.echo(line)
    return CHECK_FAILED if swept.wrong else 0
