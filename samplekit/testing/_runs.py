"""Runs over many names: planned first, so that a wrong name is told before anything is judged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from samplekit._errors import UsageError
from samplekit.testing._isolated import Kind, Limits, check_isolated
from samplekit.testing._suite import CHECKS, SCENE_CHECKS, check_sampler, check_scene, kinds_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from samplekit.testing._result import Outcome


class Work(NamedTuple):
    """One subject to be judged: plain data."""

    label: str
    name: str
    kind: Kind
    checks: tuple[str, ...]
    quick: bool
    limits: tuple[float, int] | None


def planned(names: Sequence[str], settings: Mapping[str, Any]) -> list[Work]:
    """What is to be done for these names.

    Parameters
    ----------
    settings
        ``quick``; ``only``: names of checks, or None; ``limits``: seconds and bytes, where isolated.

    Raises
    ------
    UsageError
        An unknown name, option or check.
    """
    only, limits = settings.get("only"), settings.get("limits")
    known = [check.name for check in (*CHECKS, *SCENE_CHECKS)]
    for name in only or ():
        if name not in known:
            raise UsageError(f"unknown check {name!r}: the checks are {', '.join(dict.fromkeys(known))}")
    work = []
    for name in names:
        # An isolated plugin is not imported here: its module may be what crashes.
        kinds = kinds_of(name, load=limits is None)
        for kind in kinds:
            own = [check.name for check in (CHECKS if kind == "sampler" else SCENE_CHECKS)]
            checks = tuple(check for check in own if only is None or check in only)
            label = name if len(kinds) == 1 else f"{kind} {name}"
            work.append(Work(label, name, kind, checks, bool(settings.get("quick")), limits))
    return work


def run(work: Work, tick: Callable[[], None] = lambda: None) -> list[Outcome]:
    """Judge one subject."""
    if work.limits is not None:
        limits = Limits(*work.limits)
        return check_isolated(
            work.name, work.kind, work.checks, quick=work.quick, limits=limits, report=lambda _, __: tick()
        )
    judge = check_sampler if work.kind == "sampler" else check_scene
    return judge(work.name, quick=work.quick, only=work.checks, report=lambda _, __: tick())


def run_planned(
    work: Sequence[Work], jobs: int, progress: Callable[[int, int], None]
) -> Iterator[tuple[str, list[Outcome]]]:
    """Labels and outcomes, in the order of the work; ``jobs`` subjects at a time, in processes of their own."""
    if jobs == 1 or len(work) == 1:
        for done, each in enumerate(work):
            yield each.label, run(each, tick=lambda done=done: progress(done, len(work)))  # type: ignore[misc]
        return
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        for each, outcomes in zip(work, pool.map(run, work), strict=True):
            yield each.label, outcomes
