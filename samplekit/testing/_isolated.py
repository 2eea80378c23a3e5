"""Checks in a process of their own: a sampler that hangs, crashes the interpreter or eats memory is named, and ended.

After an abnormal end another process goes on with the next check.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

from samplekit.testing._process import NoResultError, run_elsewhere
from samplekit.testing._result import Kind, Outcome
from samplekit.testing._subject import Recipe

_MOST_ENDS = 3
"""Abnormal ends after which the remaining checks are not run: each may have taken all of its time."""


def check_isolated(
    recipe: Recipe, kind: Kind, *, only: Sequence[str], quick: bool, seconds: float, memory: float
) -> Iterator[Outcome]:
    """Run checks of one sampler or scene in a process that may die.

    Parameters
    ----------
    recipe, kind
        What is judged.
    only
        Names of the checks, in their order.
    quick
        Smaller samples.
    seconds
        Longest time of one check, and of the import before the first.
    memory
        Most memory of the process, in bytes.

    Yields
    ------
    An outcome for every check. One that passed may become a failure at the end, if the process has printed.
    """
    name = recipe if isinstance(recipe, str) else recipe.name
    left = list(only)
    outcomes: list[Outcome] = []
    ends = 0
    with tempfile.TemporaryFile() as stdout:
        while left and ends < _MOST_ENDS:
            request = (f"{__name__}:answer", recipe, kind, left, quick)
            during = "while it was imported and configured"
            try:
                for result in run_elsewhere(*request, seconds=seconds, memory=memory, stdout=stdout):
                    if isinstance(result, Outcome):
                        left = left[1:]
                        outcomes.append(result)
                        yield result
                    during = f"during {left[0]}" if left else ""
            except NoResultError as end:
                if left:
                    ends += 1
                    outcomes.append(Outcome(name, left.pop(0), "failed", f"{end.problem} {during}{end.line}"))
                    yield outcomes[-1]
        stdout.seek(0)
        printed = stdout.read()
    for check in left:
        yield Outcome(name, check, "failed", f"not run: {outcomes[-1].message}")
    if printed.strip():
        # Output that reached the process's standard output, from whatever language.
        blamed = next((outcome for outcome in outcomes if outcome.check == "purity"), outcomes[-1])
        if blamed.status == "passed":
            blamed.status = "failed"
            blamed.message = f"prints to standard output: {printed[:60].decode(errors='replace')!r}"


def answer(recipe: Recipe, kind: Kind, checks: Sequence[str], quick: bool) -> Iterator[Any]:
    """Run the checks: yields a text once the subject is configured, then the outcomes. Runs in the other process."""
    from samplekit.testing._suite import run_checks

    outcomes = run_checks(recipe, kind, quick=quick, only=checks)
    yield "configured"
    yield from outcomes
