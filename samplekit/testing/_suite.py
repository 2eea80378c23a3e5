"""The suite: all checks in their order, and a run of them over one sampler or scene."""

from __future__ import annotations

import pkgutil
import time
from collections.abc import Collection, Iterator, Mapping, Sequence
from importlib import import_module
from typing import NamedTuple, get_args

from samplekit._errors import UnknownNameError, UsageError
from samplekit._quoting import reason
from samplekit._specs import SamplerSpec, SceneSpec
from samplekit.testing import _checks
from samplekit.testing._result import Check, CheckFailed, Kind, NotApplicable, Outcome
from samplekit.testing._subject import Recipe, Subject, make_subject

_MODULES = [import_module(f"{_checks.__name__}.{each.name}") for each in pkgutil.iter_modules(_checks.__path__)]
_FOUND = [each for module in _MODULES for each in vars(module).values() if isinstance(each, Check)]
SUITES: Mapping[Kind, list[Check]] = {
    kind: sorted((check for check in _FOUND if check.kind == kind), key=lambda check: check.number)
    for kind in get_args(Kind)
}
"""The checks of samplers, and those of scenes."""


class Case(NamedTuple):
    """One check of one subject; ``expected`` is the reason why it is declared to fail, empty if it is not."""

    subject: Subject
    check: Check
    expected: str


def check_sampler(
    recipe: str | SamplerSpec, *, quick: bool = False, only: Sequence[str] | None = None
) -> list[Outcome]:
    """Run the checks over a sampler.

    Parameters
    ----------
    recipe
        ``"sobol+owen"``, or the declaration of a sampler that is not installed.
    quick
        Smaller samples and no other processes: seconds in place of tens of seconds.
    only
        Names of the checks to run; None: all.

    Returns
    -------
    An outcome for each check.

    Raises
    ------
    UsageError
        An unknown sampler, option or check.
    """
    return list(run_checks(recipe, "sampler", quick=quick, only=only))


def check_scene(recipe: str | SceneSpec, *, quick: bool = False, only: Sequence[str] | None = None) -> list[Outcome]:
    """Run the checks over a scene; parameters as for :func:`check_sampler`."""
    return list(run_checks(recipe, "scene", quick=quick, only=only))


def run_checks(recipe: Recipe, kind: Kind, *, quick: bool, only: Sequence[str] | None) -> Iterator[Outcome]:
    """Return outcomes one by one, as the checks are run; parameters as for :func:`check_sampler`.

    Raises
    ------
    UsageError
        An unknown name, option or check; raised before any check runs.
    """
    return map(_run_check, make_cases(recipe, kind, quick=quick, only=only))


def make_cases(recipe: Recipe, kind: Kind, *, quick: bool, only: Sequence[str] | None = None) -> list[Case]:
    """Return the cases of one subject, which share what they have drawn; parameters as for :func:`check_sampler`.

    Raises
    ------
    UsageError
        An unknown name, option or check, or a declaration that expects the failure of an unknown check.
    """
    subject = make_subject(recipe, kind, quick=quick)
    expected = _expected_failures(subject.spec, SUITES[kind])
    return [Case(subject, check, expected.get(check.name, "")) for check in choose_checks(SUITES[kind], only)]


def choose_checks(checks: Sequence[Check], only: Collection[str] | None) -> list[Check]:
    """Return the checks with the given names, in the order of the suite; all of them if ``only`` is None.

    Raises
    ------
    UnknownNameError
        No check has one of the names.
    """
    known = {check.name for check in checks}
    for name in only or ():
        if name not in known:
            raise UnknownNameError("check", name, known)
    return [check for check in checks if only is None or check.name in only]


def _expected_failures(spec: SamplerSpec | SceneSpec, checks: Sequence[Check]) -> Mapping[str, str]:
    """Return the failures that a declaration expects: the reason for each, by the name of the check.

    Raises
    ------
    UsageError
        It names a check that does not exist, or gives no reason.
    """
    declared: Mapping[str, str] = getattr(spec, "expected_failures", {})
    try:
        choose_checks(checks, declared)
    except UnknownNameError as error:
        raise UsageError(f"{spec.name}: expected_failures: {error}") from None
    for name, why in declared.items():
        if not why.strip():
            raise UsageError(f"{spec.name}: expected_failures gives no reason for {name!r}")
    return declared


def _run_check(case: Case) -> Outcome:
    subject, check, expected = case
    outcome = Outcome(subject.text, check.name, "passed")
    subject.hints, subject.notes = outcome.hints, outcome.notes
    drawn, began = subject.drawn, time.perf_counter()
    surprise = "it passed"
    try:
        check.function(subject)
    except CheckFailed as failed:
        outcome.status, outcome.message, outcome.example = "failed", failed.message, failed.example
    except NotApplicable as nothing:
        outcome.status, outcome.message = "not applicable", str(nothing)
        surprise = f"it does not apply: {nothing}"
    except Exception as error:
        outcome.status, outcome.message = "failed", f"raised {reason(error)}"
    outcome.seconds, outcome.points = time.perf_counter() - began, subject.drawn - drawn
    if expected and outcome.status == "failed":
        outcome.status, outcome.message = "expected failure", f"{expected} ({outcome.message})"
    elif expected:
        outcome.status, outcome.message = "unexpected pass", f"declared to fail ({expected}), but {surprise}"
    return outcome
