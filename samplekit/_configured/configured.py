"""The parts that configured samplers, scenes and randomizers share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from samplekit._boundary import Boundary
from samplekit._choices import parse_choice
from samplekit._errors import UsageError
from samplekit._registry import SPEC_TYPES, Plugin, Registration, registry
from samplekit._specs import written

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from samplekit._specs import OptionValue


class Configured:
    """An implementation with its options.

    Attributes
    ----------
    text
        The choice as it would be written on the command line.
    spec
        The declaration.
    options
        All options with their values: those that were given, and the defaults of the rest.
    plugin
        The plugin that offers the implementation.
    """

    spec: Any
    options: dict[str, OptionValue]

    def __init__(self, kind: str, registration: Registration, options: Mapping[str, object]) -> None:
        self.plugin, self.spec = registration.plugin, registration.spec
        self.options = self.spec.parse_options(options)
        self.text = written(registration.name, options, self.options)
        self._boundary = Boundary(f"{kind} {registration.name}", registration.plugin)
        self._kind = kind

    def __repr__(self) -> str:
        return f"<{self._kind} {self.text}>"

    def _create(self, values: Mapping[str, OptionValue], valid: Callable[[Any], bool], expected: str) -> Any:
        """Import the implementation and make an instance of it."""
        implementation = self.spec.load()
        keywords = {name.replace("-", "_"): value for name, value in values.items()}
        return self._boundary.call("cannot be set up", lambda: implementation(**keywords), valid, expected)


def find_choice(
    kind: Literal["sampler", "scene"], choice: Any, keywords: Mapping[str, object]
) -> tuple[Registration, dict[str, object], str | None]:
    """Find what a text chooses, or register a declaration that no installed plugin offers.

    Parameters
    ----------
    kind, choice
        What is chosen: a text as on the command line, or a declaration of that kind.
    keywords
        More options, as Python keywords: a dash in the name of an option is an underscore here.

    Returns
    -------
    The registration, the options that were given, and the name of the randomizer if there is one.

    Raises
    ------
    UsageError
        The text is wrong or names nothing, or the choice is neither a text nor a declaration.
    """
    given = {name.replace("_", "-"): value for name, value in keywords.items()}
    if isinstance(choice, str):
        parsed = parse_choice(choice, kind)
        return registry().find(kind, parsed.name), {**parsed.options, **given}, parsed.randomizer
    if not isinstance(choice, SPEC_TYPES[kind]):
        raise UsageError(f"{kind} {choice!r}: expected a text, or a declaration with options")
    return Registration(choice, Plugin("not-installed", "none", "0"), choice.name), given, None
