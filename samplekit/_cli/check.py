"""``samplekit check``: check that samplers and scenes are what they declare."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from samplekit.commands import CHECK_FAILED, JsonOption, complete_sampler, complete_scene

if TYPE_CHECKING:
    from samplekit.testing import SubjectReport


def _complete(incomplete: str) -> list[tuple[str, str]]:
    return [*complete_sampler(incomplete), *complete_scene(incomplete)]


def check(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="NAME...", help="Samplers or scenes, such as sobol+owen.", autocompletion=_complete),
    ] = None,
    json: JsonOption = False,
    quick: Annotated[bool, typer.Option("--quick", help="Smaller samples, no other processes: a few seconds.")] = False,
    everything: Annotated[
        bool, typer.Option("--all", help="Every sampler, alone and with each randomizer, and every scene.")
    ] = False,
    only: Annotated[
        list[str] | None, typer.Option("--only", metavar="CHECK", help="Run this check only; may be repeated.")
    ] = None,
    html: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="Write a page with pictures of the sets that fail.")
    ] = None,
    isolated: Annotated[
        bool, typer.Option("--isolated", help="Judge in a process of its own, which may hang, crash or eat memory.")
    ] = False,
    time_limit: Annotated[
        float,
        typer.Option("--time-limit", metavar="SECONDS", help="Longest time of a check, with --isolated.", min=0.1),
    ] = 120.0,
    memory_limit: Annotated[
        float,
        typer.Option("--memory-limit", metavar="GIB", help="Most memory of a process, with --isolated.", min=0.01),
    ] = 4.0,
    jobs: Annotated[int, typer.Option("--jobs", metavar="J", help="Number of names checked at a time.", min=1)] = 1,
) -> int:
    """Check that samplers and scenes are what they declare: exit status 3 if one is not.

    Example: samplekit check sobol+owen
    """
    from samplekit import UsageError, testing
    from samplekit.commands import Progress, announce_compilation

    if html is not None and not html.parent.is_dir():
        raise UsageError(f"--html {html}: there is no folder {html.parent}")

    def show(subject: SubjectReport) -> None:
        if not json:
            typer.echo("\n".join(subject.table()))

    announce_compilation()
    with Progress("checking") as progress:
        report = testing.check(
            names or (),
            everything=everything,
            quick=quick,
            only=only,
            isolated=isolated,
            time_limit=time_limit,
            memory_limit=memory_limit,
            jobs=jobs,
            progress=progress,
            report=show,
        )
    if html is not None:
        html.write_text(report.page(), encoding="utf-8")
    if json:
        from json import dumps

        typer.echo(dumps(report.as_json(), allow_nan=False))
    else:
        typer.echo(report.summary)
    return CHECK_FAILED if report.failed else 0
