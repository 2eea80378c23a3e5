"""``samplekit compare``: error against samples and against run time, for several samplers and scenes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands import DONE, FAILED, INTERRUPTED, JsonOption, SeedOption, complete_sampler, complete_scene

if TYPE_CHECKING:
    from samplekit import Results


def compare(
    samplers: Annotated[
        list[str],
        typer.Option(
            "--sampler",
            "-s",
            metavar="NAME[:OPTION=VALUE,...][+RANDOMIZER]",
            help="A sampler; repeat the option for each sampler.",
            autocompletion=complete_sampler,
        ),
    ],
    scenes: Annotated[
        list[str],
        typer.Option(
            "--scene",
            metavar="NAME[:OPTION=VALUE,...]",
            help="A scene to integrate; may be repeated.",
            autocompletion=complete_scene,
        ),
    ],
    spp: Annotated[
        str, typer.Option("--spp", "-n", metavar="LIST", help="Samples per pixel, such as 4,16,64 or 2^2..2^12.")
    ],
    trials: Annotated[str, typer.Option("--trials", metavar="R", help="Independent realisations.")] = "32",
    size: Annotated[
        str, typer.Option("--size", metavar="W[xH]", help="Size in pixels; 1: the unit square as one pixel.")
    ] = "128",
    seed: SeedOption = "0",
    output: Annotated[str, typer.Option("--output", "-o", metavar="DIR", help="A folder for all files.")] = "",
    resume: Annotated[bool, typer.Option("--resume", help="Continue the study in that folder.")] = False,
    threads: Annotated[
        str,
        typer.Option("--threads", "-t", metavar="T", help="Threads for errors; by default one for each processor."),
    ] = "",
    processes: Annotated[
        str, typer.Option("--processes", metavar="P", help="Processes for errors, in place of threads.")
    ] = "1",
    dask: Annotated[
        str, typer.Option("--dask", metavar="ADDRESS", help="A Dask scheduler whose workers compute the errors.")
    ] = "",
    no_time: Annotated[bool, typer.Option("--no-time", help="Measure no run times.")] = False,
    budget: Annotated[
        str,
        typer.Option(
            "--budget",
            metavar="SECONDS",
            help="Processor time for measuring run times; by default a tenth of the time for errors, at least 1 s.",
        ),
    ] = "",
    cost: Annotated[
        str,
        typer.Option("--cost", metavar="NS", help="Extra cost per sample in nanoseconds, as if a renderer shaded it."),
    ] = "0",
    target: Annotated[
        str, typer.Option("--target", metavar="MSE", help="Target mean squared error for the time-to-target table.")
    ] = "",
    fit: Annotated[
        str, typer.Option("--fit", metavar="N..M", help="Range of counts that slopes are fitted to; by default all.")
    ] = "",
    json: JsonOption = False,
) -> int:
    """Compare samplers: error against samples and against run time.

    Every sampler runs on every scene at every count. The results are errors with intervals over independent trials, run
    times, fitted slopes, and what they mean in sentences. With --output also a report, plots, tables and images.

    Example: samplekit compare -s random -s jittered --scene disk --spp 2^4..2^10 --trials 1000 --size 1
    """
    from samplekit import InterruptedStudy
    from samplekit import compare as run_study
    from samplekit.commands import (
        Stages,
        announce_compilation,
        parse_count,
        parse_counts,
        parse_number,
        parse_range,
        parse_seed,
        parse_size,
    )

    options: dict[str, Any] = {
        "trials": parse_count(trials, "trials"),
        "size": parse_size(size),
        "seed": parse_seed(seed),
        "threads": parse_count(threads, "threads") if threads else None,
        "processes": parse_count(processes, "processes"),
        "dask": dask or None,
        "times": not no_time,
        "budget": parse_number(budget, "budget", "seconds, such as 10") if budget else None,
        "cost": parse_number(cost, "cost", "nanoseconds, such as 100"),
        "target": parse_number(target, "target", "a mean squared error, such as 1e-4") if target else None,
        "fit": parse_range(fit, "fit") if fit else None,
        "output": output or None,
        "resume": resume,
    }
    counts = parse_counts(spp, "spp")
    announce_compilation()
    with Stages() as progress:
        try:
            results = run_study(samplers, scenes, counts, progress=progress, **options)
        except InterruptedStudy as interrupt:
            typer.echo("samplekit: interrupted: this is what was done", err=True)
            _print_results(interrupt.results, output, json)
            return INTERRUPTED
    _print_results(results, output, json)
    return _report_invalid(results)


def _print_results(results: Results, output: str, as_json: bool) -> None:
    from samplekit._cli.compare_text import left_out_lines, lines
    from samplekit.commands import fact_lines, plugin_facts

    for line in left_out_lines(results):
        typer.echo(f"samplekit: {line}", err=True)
    if as_json:
        from json import dumps

        typer.echo(dumps(results.as_json() | plugin_facts(results), allow_nan=False))
        return
    for line in [*lines(results), *fact_lines(plugin_facts(results))]:
        typer.echo(line)
    if output:
        typer.echo(f"wrote {output}")


def _report_invalid(results: Results) -> int:
    """Return exit status 1, and print why, if pixels were not finite; return 0 otherwise."""
    rows = [row for row in results.rows if row.invalid_pixels]
    if not rows:
        return DONE
    pixels = sum(row.invalid_pixels for row in rows)
    message = f"{pixels} pixels of {rows[0].scene} were not finite in all trials together: left out of the errors"
    typer.echo(f"samplekit: {message}", err=True)
    return FAILED
