"""Cases: one check of one subject, as a test framework wants it; and the classes that a test file subclasses.

Nothing here imports a test framework: the pytest plugin makes tests of cases.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit.testing._result import Check


class Subjects:
    """Subjects by recipe, made when first needed and kept: checks share what they have drawn and asked."""

    def __init__(self, *, quick: bool) -> None:
        self.quick = quick
        self._made: list[tuple[Any, Any]] = []

    def get(self, kind: str, recipe: Any) -> Any:
        """The subject of a recipe."""
        for known, subject in self._made:
            if known is recipe or known == recipe:
                return subject
        from samplekit.testing._scene_subject import SceneSubject
        from samplekit.testing._subject import Subject

        made = (Subject if kind == "sampler" else SceneSubject)(recipe, quick=self.quick)
        self._made.append((recipe, made))
        return made


@dataclass(frozen=True, eq=False)
class Case:
    """One check of one subject.

    Attributes
    ----------
    expected
        Why the check is declared to fail; empty: it is not.
    """

    subjects: Subjects
    kind: Literal["sampler", "scene"]
    recipe: Any
    check: Check
    expected: str = ""

    @property
    def id(self) -> str:
        """Its name in a list of tests."""
        name = self.recipe if isinstance(self.recipe, str) else self.recipe.name
        return f"{name}-{self.check.name}"

    def __call__(self) -> None:
        """Run the check.

        Raises
        ------
        CheckFailed
            The property does not hold.
        NotApplicable
            There is nothing to judge; the message says why.
        """
        from samplekit.testing._result import NotApplicable

        subject = self.subjects.get(self.kind, self.recipe)
        reason = self.check.requires(subject.spec)
        if reason:
            raise NotApplicable(reason)
        self.check(subject)


def cases_of(kind: Literal["sampler", "scene"], recipe: Any, subjects: Subjects) -> list[Case]:
    """All checks of one subject.

    Raises
    ------
    UsageError
        An unknown name or option, or a declaration that expects the failure of an unknown check.
    """
    from samplekit.testing._suite import CHECKS, SCENE_CHECKS, expected_failures

    checks = CHECKS if kind == "sampler" else SCENE_CHECKS
    expected = expected_failures(subjects.get(kind, recipe).spec, checks)
    return [Case(subjects, kind, recipe, check, expected.get(check.name, "")) for check in checks]


class _Conformance:
    kind: ClassVar[Literal["sampler", "scene"]]
    quick: ClassVar[bool] = False

    def specs(self) -> Sequence[Any]:
        """What is judged: declarations, or names of what is installed."""
        raise NotImplementedError(f"{type(self).__name__} defines no specs")

    def cases(self) -> list[Case]:
        """All checks of all that is judged."""
        subjects = Subjects(quick=self.quick)
        return [case for recipe in self.specs() for case in cases_of(self.kind, recipe, subjects)]

    def test_conformance(self, samplekit_case: Case) -> None:
        """One check; the pytest plugin gives the cases."""
        samplekit_case()


class SamplerConformance(_Conformance):
    """The suite for samplers that are not installed: subclass it in a test file and define ``specs``.

    ``quick = True`` in the subclass takes smaller samples and starts no other process.

    Examples
    --------
    >>> from samplekit import SamplerSpec
    >>> class TestMine(SamplerConformance):
    ...     def specs(self):
    ...         return [SamplerSpec("mine", "my_package.points:Mine", "my own points")]
    """

    kind = "sampler"


class SceneConformance(_Conformance):
    """The suite for scenes that are not installed; see :class:`SamplerConformance`."""

    kind = "scene"
