"""The classes that a test file subclasses. Nothing here imports a test framework: the pytest plugin makes the tests."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit.testing._result import Kind
    from samplekit.testing._suite import Case


class _Conformance:
    kind: ClassVar[Kind]
    quick: ClassVar[bool] = False

    def specs(self) -> Sequence[Any]:
        """Return what is judged: declarations, or names of what is installed."""
        raise NotImplementedError(f"{type(self).__name__} defines no specs")

    def cases(self) -> list[Case]:
        """Return all checks of everything that is judged."""
        from samplekit.testing._suite import make_cases

        return [case for recipe in self.specs() for case in make_cases(recipe, self.kind, quick=self.quick)]

    def test_conformance(self, samplekit_case: Callable[[], None]) -> None:
        """Run one check, which the pytest plugin passes."""
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
