"""Check several samplers and scenes: all names are looked up first, then each is judged."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial

from samplekit._arguments import check_positive
from samplekit._choices import parse_choice
from samplekit._errors import UnknownNameError, UsageError
from samplekit._registry import registry
from samplekit._specs import SamplerSpec
from samplekit.testing._isolated import check_isolated
from samplekit.testing._report import Report, SubjectReport
from samplekit.testing._result import Kind, Outcome
from samplekit.testing._subject import Recipe, make_subject
from samplekit.testing._suite import SUITES, choose_checks, run_checks


def check(
    names: Recipe | Iterable[Recipe] = (),
    *,
    everything: bool = False,
    quick: bool = False,
    only: Sequence[str] | None = None,
    isolated: bool = False,
    time_limit: float = 120.0,
    memory_limit: float = 4.0,
    jobs: int = 1,
    progress: Callable[[int, int], None] = lambda _, __: None,
    report: Callable[[SubjectReport], None] = lambda _: None,
) -> Report:
    """Check that samplers and scenes are what they declare.

    Parameters
    ----------
    names
        Samplers and scenes: texts such as ``"sobol+owen"``, or declarations of what is not installed. A name that a
        sampler and a scene share is judged as both.
    everything
        Judge every sampler, alone and with each randomizer, and every scene as well.
    quick
        Smaller samples, no other processes: a few seconds for each.
    only
        Names of the checks to run; None: all.
    isolated
        Judge each in a process of its own, which may hang, crash or take too much memory.
    time_limit, memory_limit
        With ``isolated``: longest time of one check, in seconds, and most memory of the process, in GiB.
    jobs
        Number of subjects that are judged at a time, in as many processes.
    progress
        Called with the numbers of subjects that are done and to do.
    report
        Called with the report of each subject as soon as it is ready.

    Returns
    -------
    Report
        The outcomes of all checks.

    Raises
    ------
    UsageError
        An unknown name, option or check, or no name at all; raised before anything is judged.

    Examples
    --------
    >>> from samplekit.testing import check
    >>> check(["sobol", "disk"], only=["light-import"]).failed
    []
    """
    recipes = [names] if isinstance(names, Recipe) else list(names)
    recipes += _all_names() if everything else []
    recipes = [recipe for i, recipe in enumerate(recipes) if recipe not in recipes[:i]]
    if not recipes:
        raise UsageError("check: expected NAME..., or --all (in Python everything=True)")
    choose_checks([*SUITES["sampler"], *SUITES["scene"]], only)
    check_positive("jobs", jobs)
    judge = partial(check_isolated, seconds=time_limit, memory=memory_limit * 2**30) if isolated else run_checks
    labels, tasks = [], []
    for recipe in recipes:
        for label, kind in _kinds(recipe, configure=not isolated):
            chosen = [each.name for each in SUITES[kind] if not only or each.name in only]
            labels.append(label)
            tasks.append(partial(judge, recipe, kind, only=chosen, quick=quick))
    reports = []
    for label, outcomes in zip(labels, _run(tasks, jobs, progress), strict=True):
        reports.append(SubjectReport(label, outcomes))
        progress(len(reports), len(tasks))
        report(reports[-1])
    return Report(reports, quick)


def _all_names() -> list[str]:
    """Return the names of every sampler, alone and with each randomizer, and of every scene."""
    # A sampler or scene with an option that has no default cannot be made without it.
    samplers, scenes = (
        [name for name, each in registry().all(kind).items() if not any(o.required for o in each.spec.options)]
        for kind in SUITES
    )
    endings = ("", *(f"+{randomizer}" for randomizer in registry().all("randomizer")))
    return [sampler + ending for sampler in samplers for ending in endings] + scenes


def _kinds(recipe: Recipe, *, configure: bool) -> list[tuple[str, Kind]]:
    """Return a label and a kind for the sampler and for the scene that a recipe names: one of them, or both.

    Parameters
    ----------
    configure
        Whether to try its options, which imports it: the import of what is judged in isolation may crash.

    Raises
    ------
    UsageError
        It names neither, or its options are wrong.
    """
    if not isinstance(recipe, str):
        return [(recipe.name, "sampler" if isinstance(recipe, SamplerSpec) else "scene")]
    choice = parse_choice(recipe, "sampler")
    kinds: list[Kind] = []
    unknown: UnknownNameError | None = None
    for kind in SUITES:
        try:
            registry().find(kind, choice.name)
            kinds.append(kind)
        except UnknownNameError as error:
            unknown = unknown or error
    if not kinds:
        raise UsageError(f"{unknown}; and no scene has that name")
    if choice.randomizer and "sampler" in kinds:
        # Only a sampler takes a randomizer.
        kinds = ["sampler"]
    for kind in kinds if configure else ():
        make_subject(recipe, kind)
    return [(recipe if len(kinds) == 1 else f"{kind} {recipe}", kind) for kind in kinds]


def _run(
    tasks: Sequence[Callable[[], Iterator[Outcome]]], jobs: int, progress: Callable[[int, int], None]
) -> Iterator[list[Outcome]]:
    """Yield the outcomes of each task in turn; ``jobs`` tasks run at a time."""
    if jobs == 1 or len(tasks) == 1:
        for done, task in enumerate(tasks):
            yield _collect(task, partial(progress, done, len(tasks)))
        return
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from pool.map(_collect, tasks)


def _collect(task: Callable[[], Iterator[Outcome]], tick: Callable[[], None] = lambda: None) -> list[Outcome]:
    outcomes = []
    for outcome in task():
        outcomes.append(outcome)
        tick()
    return outcomes
