"""The suite: all checks in their order, and a run of them over one sampler or scene."""

from __future__ import annotations

import difflib
import pkgutil
import time
from importlib import import_module
from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit._quoting import reason
from samplekit.testing import _checks
from samplekit.testing._result import Check, CheckFailed, NotApplicable, Outcome
from samplekit.testing._subject import make_subject

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from samplekit._specs import SamplerSpec, SceneSpec
    from samplekit.testing._result import Kind
    from samplekit.testing._subject import Recipe, Subject

_MODULES = [import_module(f"{_checks.__name__}.{each.name}") for each in pkgutil.iter_modules(_checks.__path__)]
_FOUND = [each for module in _MODULES for each in vars(module).values() if isinstance(each, Check)]
CHECKS, SCENE_CHECKS = (
    tuple(sorted((check for check in _FOUND if check.kind == kind), key=lambda check: check.number))
    for kind in ("sampler", "scene")
)
SUITES: Mapping[Kind, tuple[Check, ...]] = {"sampler": CHECKS, "scene": SCENE_CHECKS}


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
    subject = make_subject(recipe, kind, quick=quick)
    expected = expected_failures(subject.spec, SUITES[kind])
    chosen = chosen_checks(SUITES[kind], only)
    return (_run_check(check, subject, expected.get(check.name, "")) for check in chosen)


def chosen_checks(checks: Sequence[Check], only: Sequence[str] | None) -> list[Check]:
    """Return the checks with the given names, in their order; all of them if ``only`` is None.

    Raises
    ------
    UsageError
        A name is not that of a check.
    """
    known = dict.fromkeys(check.name for check in checks)
    for name in only or ():
        if name not in known:
            raise UsageError(f"unknown check {name!r}: the checks are {', '.join(known)}")
    return [check for check in checks if only is None or check.name in only]


def expected_failures(spec: SamplerSpec | SceneSpec, checks: Sequence[Check]) -> Mapping[str, str]:
    """Return the failures that a declaration expects: reasons by the name of the check.

    Raises
    ------
    UsageError
        It names a check that does not exist, or gives no reason.
    """
    declared: Mapping[str, str] = getattr(spec, "expected_failures", {})
    known = [check.name for check in checks]
    for name, why in declared.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
            hint = f"did you mean {near[0]}?" if near else f"the checks are {', '.join(known)}"
            raise UsageError(f"{spec.name}: expected_failures names the unknown check {name!r}: {hint}")
        if not str(why).strip():
            raise UsageError(f"{spec.name}: expected_failures gives no reason for {name!r}")
    return declared


def _run_check(check: Check, subject: Subject, expected: str) -> Outcome:
    """Run one check; ``expected`` is the reason why it is declared to fail."""
    outcome = Outcome(subject.text, check.name, "passed")
    subject.hints, subject.notes = outcome.hints, outcome.notes
    drawn, began = subject.drawn, time.perf_counter()
    surprise = "it passed"
    try:
        check(subject)
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
