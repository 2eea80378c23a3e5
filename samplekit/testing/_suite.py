"""The suite: all checks in their order, and a run of them over one sampler or scene."""

from __future__ import annotations

import difflib
import time
from typing import TYPE_CHECKING, Any, Literal

from samplekit._errors import AmbiguousNameError, UnknownNameError, UsageError
from samplekit.testing import _scenes as scenes
from samplekit.testing._determinism import check_determinism, check_seed
from samplekit.testing._dimensions import check_across_dimensions
from samplekit.testing._distance import check_minimum_distance
from samplekit.testing._imports import check_light_import
from samplekit.testing._large import check_large_index, check_pixel_extremes
from samplekit.testing._limits import check_limits
from samplekit.testing._nets import check_elementary_intervals
from samplekit.testing._pixels import check_across_pixels
from samplekit.testing._prefix import check_prefix, check_slices
from samplekit.testing._purity import check_purity
from samplekit.testing._range import check_range, check_shape
from samplekit.testing._result import CheckFailed, NotApplicable, Outcome
from samplekit.testing._scene_subject import SceneRecipe, SceneSubject
from samplekit.testing._strata import check_strata
from samplekit.testing._subject import Recipe, Subject
from samplekit.testing._underdeclared import check_under_declaring
from samplekit.testing._uniformity import check_unbiasedness, check_uniformity
from samplekit.testing._variance import check_variance

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from samplekit.testing._result import Check

CHECKS: tuple[Check, ...] = (
    check_range,
    check_shape,
    check_determinism,
    check_seed,
    check_prefix,
    check_slices,
    check_elementary_intervals,
    check_strata,
    check_minimum_distance,
    check_uniformity,
    check_unbiasedness,
    check_variance,
    check_across_pixels,
    check_across_dimensions,
    check_limits,
    check_large_index,
    check_pixel_extremes,
    check_purity,
    check_light_import,
    check_under_declaring,
)
SCENE_CHECKS: tuple[Check, ...] = scenes.CHECKS


def expected_failures(spec: Any, checks: Sequence[Check] = CHECKS) -> Mapping[str, str]:
    """The failures that a declaration expects: check to reason.

    Raises
    ------
    UsageError
        It names a check that does not exist, or gives no reason.
    """
    declared: Mapping[str, str] = getattr(spec, "expected_failures", {})
    known = [check.name for check in checks]
    for name, reason in declared.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
            hint = f"did you mean {near[0]}?" if near else f"the checks are {', '.join(known)}"
            raise UsageError(f"{spec.name}: expected_failures names the unknown check {name!r}: {hint}")
        if not str(reason).strip():
            raise UsageError(f"{spec.name}: expected_failures gives no reason for {name!r}")
    return declared


def run_check(check: Check, subject: Subject | SceneSubject, expected: str = "") -> Outcome:
    """Run one check; ``expected`` is the reason why it is declared to fail."""
    outcome = Outcome(subject.text, check.name, "passed")
    reason = check.requires(subject.spec)
    if reason:
        outcome.status, outcome.message = "not applicable", reason
        if expected:
            outcome.status = "unexpected pass"
            outcome.message = f"declared to fail ({expected}), but it does not apply: {reason}"
        return outcome
    subject.hints, subject.notes = [], []
    drawn, began = subject.drawn, time.perf_counter()
    try:
        check(subject)
    except CheckFailed as failed:
        outcome.status, outcome.message, outcome.example = "failed", failed.message, failed.example
    except NotApplicable as nothing:
        outcome.status, outcome.message = "not applicable", str(nothing)
    except Exception as error:
        what = " ".join(str(error).split())
        outcome.status, outcome.message = "failed", f"raised {type(error).__name__}: {what}"
    outcome.seconds, outcome.points = time.perf_counter() - began, subject.drawn - drawn
    outcome.hints, outcome.notes = subject.hints, subject.notes
    if expected and outcome.status == "failed":
        outcome.status, outcome.message = "expected failure", f"{expected} ({outcome.message})"
    elif expected:
        outcome.status, outcome.message = "unexpected pass", f"declared to fail ({expected}), but it {outcome.status}"
    return outcome


def check_sampler(
    recipe: Recipe,
    *,
    quick: bool = False,
    only: Sequence[str] | None = None,
    report: Callable[[Check, Outcome | None], None] = lambda _, __: None,
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
    report
        Called before each check with None, and after it with its outcome.

    Raises
    ------
    UsageError
        An unknown sampler, option or check.
    """
    return _run(Subject(recipe, quick=quick), CHECKS, only, report)


def check_scene(
    recipe: SceneRecipe,
    *,
    quick: bool = False,
    only: Sequence[str] | None = None,
    report: Callable[[Check, Outcome | None], None] = lambda _, __: None,
) -> list[Outcome]:
    """Run the checks over a scene; parameters as for :func:`check_sampler`."""
    return _run(SceneSubject(recipe, quick=quick), SCENE_CHECKS, only, report)


def _run(
    subject: Subject | SceneSubject,
    checks: Sequence[Check],
    only: Sequence[str] | None,
    report: Callable[[Check, Outcome | None], None],
) -> list[Outcome]:
    expected = expected_failures(subject.spec, checks)
    unknown = set(only or ()) - {check.name for check in checks}
    if unknown:
        raise UsageError(
            f"unknown check {', '.join(sorted(unknown))}: the checks are {', '.join(c.name for c in checks)}"
        )
    outcomes = []
    for check in checks:
        if only is not None and check.name not in only:
            continue
        report(check, None)
        outcome = run_check(check, subject, expected.get(check.name, ""))
        report(check, outcome)
        outcomes.append(outcome)
    return outcomes


def kinds_of(name: str, *, load: bool = True) -> list[Literal["sampler", "scene"]]:
    """What a name is, as written on the command line: sampler, scene, or both.

    ``load``: try whether its options are right, which imports it.

    Raises
    ------
    UsageError
        Neither, or wrong options.
    """
    from samplekit._choices import parse_choice
    from samplekit._configured.sampler import sampler as configured_sampler
    from samplekit._configured.scene import scene as configured_scene
    from samplekit._registry import registry

    plain = parse_choice(name, "sampler").name.rpartition("/")[2]
    both: tuple[Literal["sampler", "scene"], ...] = ("sampler", "scene")
    kinds = [kind for kind in both if _is_known(registry().find, kind, plain)]
    if not kinds:
        try:
            registry().find("sampler", plain)
        except UsageError as error:
            raise UsageError(f"{error}; and no scene has that name") from None
    for kind in kinds if load else ():
        if kind == "sampler":
            configured_sampler(name)
        elif len(kinds) == 1:
            configured_scene(name)
    return kinds


def _is_known(find: Callable[..., Any], kind: str, name: str) -> bool:
    try:
        find(kind, name)
    except UnknownNameError:
        return False
    except AmbiguousNameError:
        return True
    return True
