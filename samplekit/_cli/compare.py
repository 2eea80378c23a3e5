"""``samplekit compare``: error against samples and against run time, for several samplers and scenes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from samplekit.commands._completion import complete_sampler, complete_scene
from samplekit.commands._options import JsonOption, SeedOption

if TYPE_CHECKING:
    from pathlib import Path

    from samplekit._study.request import Request
    from samplekit._study.results import Results
    from samplekit._study.study import Study
    from samplekit._study.subjects import Subjects

INTERRUPTED = 130


def compare(
    samplers: Annotated[
        list[str],
        typer.Option(
            "--sampler",
            "-s",
            metavar="NAME[:OPTION=VALUE,...][+RANDOMIZER]",
            help="A sampler; give one for each that is compared.",
            autocompletion=complete_sampler,
        ),
    ],
    scenes: Annotated[
        list[str],
        typer.Option(
            "--scene",
            metavar="NAME[:OPTION=VALUE,...]",
            help="What is integrated; one or several.",
            autocompletion=complete_scene,
        ),
    ],
    spp: Annotated[
        str, typer.Option("--spp", "-n", metavar="LIST", help="Samples of a pixel, such as 4,16,64 or 2^2..2^12.")
    ],
    trials: Annotated[str, typer.Option("--trials", metavar="R", help="Independent realisations.")] = "32",
    size: Annotated[
        str, typer.Option("--size", metavar="W[xH]", help="Size in pixels; 1: the unit square as one pixel.")
    ] = "128",
    seed: SeedOption = "0",
    output: Annotated[str, typer.Option("--output", "-o", metavar="DIR", help="A folder for all files.")] = "",
    resume: Annotated[bool, typer.Option("--resume", help="Go on with the study in that folder.")] = False,
    threads: Annotated[
        str, typer.Option("--threads", "-t", metavar="T", help="Threads for errors; by default one a processor.")
    ] = "",
    processes: Annotated[
        str, typer.Option("--processes", metavar="P", help="Processes for errors, in place of threads.")
    ] = "1",
    dask: Annotated[
        str, typer.Option("--dask", metavar="ADDRESS", help="A Dask scheduler whose workers compute the errors.")
    ] = "",
    no_time: Annotated[bool, typer.Option("--no-time", help="Take no run times.")] = False,
    budget: Annotated[
        str,
        typer.Option(
            "--budget",
            metavar="SECONDS",
            help="For measuring run times; by default a tenth of what errors take, at least 1.",
        ),
    ] = "",
    cost: Annotated[
        str, typer.Option("--cost", metavar="NS", help="Nanoseconds that each sample costs besides.")
    ] = "0",
    target: Annotated[
        str, typer.Option("--target", metavar="MSE", help="The mean squared error whose price is told.")
    ] = "",
    fit: Annotated[
        str, typer.Option("--fit", metavar="N..M", help="Counts that slopes are fitted to; by default all.")
    ] = "",
    json: JsonOption = False,
) -> int:
    """Compare samplers: error against samples and against run time.

    Every sampler on every scene at every count, with intervals over independent trials, run times, fitted slopes and
    what they mean. With --output also a report, plots, tables and images.

    Example: samplekit compare -s random -s jittered --scene disk --spp 2^4..2^10 --trials 1000 --size 1
    """
    from pathlib import Path

    from samplekit._study.manner import Manner
    from samplekit.commands import parse_count, parse_counts, parse_number, parse_range, parse_seed, parse_size

    counts, trial_count, width_height = parse_counts(spp, "spp"), parse_count(trials, "trials"), parse_size(size)
    start = parse_seed(seed)
    manner = Manner(
        threads=parse_count(threads, "threads") if threads else None,
        processes=parse_count(processes, "processes"),
        dask=dask or None,
        times=not no_time,
        budget=parse_number(budget, "budget", "seconds, such as 10") if budget else None,
        cost=parse_number(cost, "cost", "nanoseconds, such as 100"),
        target=parse_number(target, "target", "a mean squared error, such as 1e-4") if target else None,
        fitted=parse_range(fit, "fit") if fit else None,
    )
    from samplekit.commands._notices import announce_compilation

    announce_compilation()
    from samplekit._study.request import checked_request
    from samplekit._study.study import Study
    from samplekit._study.subjects import Subjects

    subjects = Subjects()
    request = checked_request(
        [subjects.scene(scene).text for scene in scenes],
        [subjects.studied(sampler, width_height).text for sampler in samplers],
        counts,
        trial_count,
        width_height,
        start,
    )
    folder = Path(output) if output else None
    with Study(request, manner, subjects, folder, resume=resume) as study:
        interrupted = _run(study)
        results = study.results()
        if folder is not None:
            results = _write(results, request, subjects, folder, manner.threads)
    _report(results, folder, json)
    if interrupted:
        return INTERRUPTED
    return _invalid(results, json)


def _run(study: Study) -> bool:
    """Run it with a bar for each stage; whether it was interrupted."""
    from samplekit.commands._progress import Stages

    with Stages() as progress:
        try:
            study.run(progress)
        except KeyboardInterrupt:
            typer.echo("samplekit: interrupted: this is what was done", err=True)
            return True
    return False


def _write(results: Results, request: Request, subjects: Subjects, folder: Path, threads: int | None) -> Results:
    from samplekit._study.outputs import write_outputs
    from samplekit.commands._progress import Progress

    with Progress("writing images") as progress:
        return write_outputs(results, request, subjects, folder, threads, progress)


def _report(results: Results, folder: Path | None, as_json: bool) -> None:
    from samplekit._cli.comparison import left_out_lines, lines

    for line in left_out_lines(results):
        typer.echo(f"samplekit: {line}", err=True)
    if as_json:
        import json

        from samplekit._study.results import to_json

        typer.echo(json.dumps(json.loads(to_json(results)), allow_nan=False))
        return
    for line in lines(results):
        typer.echo(line)
    if folder is not None:
        typer.echo(f"wrote {folder}")


def _invalid(results: Results, as_json: bool) -> int:
    """1, with a line that says why, if samples were not finite."""
    rows = [row for row in results.rows if row.invalid_pixels]
    if not rows:
        return 0
    pixels = sum(row.invalid_pixels for row in rows)
    message = f"{pixels} pixels of {rows[0].scene} were not finite in all trials together: left out of the errors"
    if not as_json:
        from samplekit._errors import SamplekitError

        raise SamplekitError(message)
    typer.echo(f"samplekit: {message}", err=True)
    return 1
