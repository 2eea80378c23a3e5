"""Cases: one check of one subject, as a test framework wants it; and the classes that a test file subclasses.

Nothing here imports a test framework: the pytest plugin makes tests of cases.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit.testing._result import Check, Kind
    from samplekit.testing._subject import Recipe, Subject


@dataclass(frozen=True, eq=False)
class Case:
    """One check of one subject.

    Attributes
    ----------
    expected
        Why the check is declared to fail; empty if it is not.
    """

    subject: Subject
    check: Check
    expected: str = ""

    @property
    def id(self) -> str:
        """Its name in a list of tests."""
        recipe = self.subject.recipe
        return f"{recipe if isinstance(recipe, str) else recipe.name}-{self.check.name}"

    def __call__(self) -> None:
        """Run the check.

        Raises
        ------
        CheckFailed
            The property does not hold.
        NotApplicable
            There is nothing to judge; the message says why.
        """
        self.check(self.subject)


def cases_of(recipe: Recipe, kind: Kind, *, quick: bool) -> list[Case]:
    """Return all checks of one subject; they share what they have drawn.

    Raises
    ------
    UsageError
        An unknown name or option, or a declaration that expects the failure of an unknown check.
    """
    from samplekit.testing._subject import make_subject
    from samplekit.testing._suite import SUITES, expected_failures

    subject = make_subject(recipe, kind, quick=quick)
    expected = expected_failures(subject.spec, SUITES[kind])
    return [Case(subject, check, expected.get(check.name, "")) for check in SUITES[kind]]


class _Conformance:
    kind: ClassVar[Kind]
    quick: ClassVar[bool] = False

    def specs(self) -> Sequence[Any]:
        """Return what is judged: declarations, or names of what is installed."""
        raise NotImplementedError(f"{type(self).__name__} defines no specs")

    def cases(self) -> list[Case]:
        """Return all checks of all that is judged."""
        return [case for recipe in self.specs() for case in cases_of(recipe, self.kind, quick=self.quick)]

    def test_conformance(self, samplekit_case: Case) -> None:
        """Run one check; the pytest plugin gives the cases."""
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
