"""The table mutant x check: ``python tests/testing/mutation.py [--jobs N] [--quick] [NAME...]``.

Exit status 0 if every mutant is caught by the check that should catch it, else 3.
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TYPE_CHECKING

from mutants import MUTANTS

from samplekit.testing._result import BROKEN, Outcome
from samplekit.testing._suite import SUITES, check_sampler

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mutants import Mutant

CHECKS = SUITES["sampler"]


def caught(mutant: type[Mutant], outcomes: Sequence[Outcome]) -> bool:
    """Whether the check that should catch the mutant does: by a failure, or by a hint if that is all it gives."""
    outcome = next(each for each in outcomes if each.check == mutant.caught_by)
    return outcome.status in BROKEN or (mutant.caught_by == "under-declaring" and bool(outcome.hints))


def run_mutant(name: str, *, quick: bool = False, only: Sequence[str] | None = None) -> list[Outcome]:
    """All checks, or some, over the mutant whose class has this name."""
    mutant = next(each for each in MUTANTS if each.__name__ == name)
    return check_sampler(mutant.spec(), quick=quick, only=only)


def _run(request: tuple[str, bool]) -> list[Outcome]:
    name, quick = request
    outcomes = run_mutant(name, quick=quick)
    for outcome in outcomes:
        outcome.example = None
    return outcomes


def table(rows: Sequence[tuple[type[Mutant], list[Outcome]]]) -> list[str]:
    """Lines: a row a mutant, a column a check by its number; X the check that should catch it, x others that do."""
    lines = [f"{check.number:>3} {check.name}: {check.summary}" for check in CHECKS]
    lines += ["", " " * 28 + "".join(f"{check.number:>3}" for check in CHECKS)]
    for mutant, outcomes in rows:
        marks = ""
        for check, outcome in zip(CHECKS, outcomes, strict=True):
            found = outcome.status in BROKEN or (check.name == "under-declaring" and outcome.hints)
            expected = check.name == mutant.caught_by
            marks += f"{'X' if found and expected else '!' if expected else 'x' if found else '.':>3}"
        lines.append(f"{mutant.__name__:<28}{marks}")
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; see the module."""
    parser = argparse.ArgumentParser(prog="python tests/testing/mutation.py", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args(arguments)
    chosen = [mutant for mutant in MUTANTS if not given.names or mutant.__name__ in given.names]
    requests = [(mutant.__name__, given.quick) for mutant in chosen]
    with ProcessPoolExecutor(given.jobs, mp_context=get_context("spawn")) as pool:
        rows = list(zip(chosen, pool.map(_run, requests), strict=True))
    missed = [mutant for mutant, outcomes in rows if not caught(mutant, outcomes)]
    for line in table(rows):
        print(line)  # noqa: T201
    print(f"{len(rows) - len(missed)} of {len(rows)} mutants are caught by the check that should catch them")  # noqa: T201
    for mutant in missed:
        print(f"missed: {mutant.__name__} by {mutant.caught_by}: {mutant.spec().summary}", file=sys.stderr)  # noqa: T201
    return 3 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
