"""``samplekit check``: whether samplers and scenes are what they declare."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands import CHECK_FAILED, JsonOption, complete_sampler, complete_scene

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit.testing._result import Outcome

SCHEMA = "samplekit.check/1"


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
        list[str] | None, typer.Option("--only", metavar="CHECK", help="This check; may be repeated.")
    ] = None,
    html: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="Write a page with pictures of the sets that fail.")
    ] = None,
    isolated: Annotated[
        bool, typer.Option("--isolated", help="In a process of its own, which may hang, crash or eat memory.")
    ] = False,
    time_limit: Annotated[
        float, typer.Option("--time-limit", metavar="SECONDS", help="Of one check, with --isolated.", min=0.1)
    ] = 120.0,
    memory_limit: Annotated[
        float, typer.Option("--memory-limit", metavar="GIB", help="Of the process, with --isolated.", min=0.01)
    ] = 4.0,
    jobs: Annotated[int, typer.Option("--jobs", metavar="J", help="Names checked at a time.", min=1)] = 1,
) -> int:
    """Check that samplers and scenes are what they declare: exit status 3 if one is not.

    Example: samplekit check sobol+owen
    """
    from samplekit._errors import UsageError

    if html is not None and not html.parent.is_dir():
        raise UsageError(f"--html {html}: there is no folder {html.parent}")
    chosen = list(dict.fromkeys(names or ())) + (_all_names() if everything else [])
    if not chosen:
        raise UsageError("check: expected NAME..., or --all")
    from samplekit.commands._notices import announce_compilation

    announce_compilation()
    settings: dict[str, Any] = {"quick": quick, "only": only or None}
    if isolated:
        settings["limits"] = (time_limit, int(memory_limit * 2**30))
    runs = _run_all(chosen, settings, jobs, show=None if json else _show)
    from samplekit.testing._result import broken

    failed = [name for name, outcomes in runs.items() if broken(outcomes)]
    if html is not None:
        from samplekit.testing._html import page

        html.write_text(page(runs), encoding="utf-8")
    if json:
        from json import dumps

        typer.echo(dumps(_report(runs, failed, quick), allow_nan=False))
    else:
        from samplekit.testing._html import rate_line

        typer.echo(f"{len(runs) - len(failed)} of {len(runs)} conform; {rate_line(len(runs))}")
    return CHECK_FAILED if failed else 0


def _all_names() -> list[str]:
    from samplekit._registry import registry

    randomizers = list(registry().all("randomizer"))
    # What needs an option that has no default is nothing without it.
    samplers, scenes = (
        [name for name, offer in registry().all(kind).items() if not any(o.required for o in offer.spec.options)]
        for kind in ("sampler", "scene")
    )
    names = [name for sampler in samplers for name in (sampler, *(f"{sampler}+{r}" for r in randomizers))]
    return names + [name for name in scenes if name not in samplers]


def _run_all(
    names: Sequence[str],
    settings: dict[str, Any],
    jobs: int,
    show: Callable[[str, Sequence[Outcome]], None] | None,
) -> dict[str, list[Outcome]]:
    """Outcomes by name, shown as they come, in the order of the names."""
    from samplekit.commands._progress import Progress
    from samplekit.testing._runs import planned, run_planned

    work = planned(names, settings)
    runs: dict[str, list[Outcome]] = {}
    with Progress("checking") as progress:
        for done, (name, outcomes) in enumerate(run_planned(work, jobs, progress), start=1):
            runs[name] = outcomes
            progress(done, len(work))
            if show is not None:
                show(name, outcomes)
    return runs


def _show(name: str, outcomes: Sequence[Outcome]) -> None:
    from samplekit.testing._html import counted

    seconds, points = sum(o.seconds for o in outcomes), sum(o.points for o in outcomes)
    typer.echo(f"{name}: {counted(outcomes)} ({seconds:.1f} s, {points} points)")
    for outcome in outcomes:
        detail = outcome.message + (f" [{outcome.example}]" if outcome.example else "")
        typer.echo(f"  {outcome.check:<21} {outcome.status:<17} {detail}".rstrip())
        for hint in outcome.hints:
            typer.echo(f"  {'':<21} {'hint':<17} {hint}")
        for note in outcome.notes:
            typer.echo(f"  {'':<21} {'note':<17} {note}")


def _report(runs: dict[str, list[Outcome]], failed: Sequence[str], quick: bool) -> dict[str, Any]:
    from samplekit.testing._result import STATUSES
    from samplekit.testing._statistics import family_rate

    return {
        "schema": SCHEMA,
        "quick": quick,
        "conform": not failed,
        "false_alarm_rate": family_rate(len(runs)),
        "subjects": [
            {
                "name": name,
                "conforms": name not in failed,
                "counts": {status: sum(o.status == status for o in outcomes) for status in STATUSES},
                "seconds": round(sum(o.seconds for o in outcomes), 3),
                "points": sum(o.points for o in outcomes),
                "checks": [outcome.as_json() for outcome in outcomes],
            }
            for name, outcomes in runs.items()
        ],
    }
