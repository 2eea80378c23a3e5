"""The parts that configured samplers, scenes and randomizers share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from samplekit._boundary import Boundary
from samplekit._registry import Plugin, Registration
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

    text: str
    spec: Any
    options: dict[str, OptionValue]
    plugin: Plugin

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


def not_installed(spec: Any) -> Registration:
    """Register a declaration that no installed plugin offers."""
    return Registration(spec, Plugin("not-installed", "none", "0"), spec.name)


def option_names(keywords: Mapping[str, object]) -> dict[str, object]:
    """Return options that were given as Python keywords under the names of the command line."""
    return {name.replace("_", "-"): value for name, value in keywords.items()}


def are_texts(notes: Any) -> bool:
    """Tell whether ``notes`` is a list of strings."""
    return isinstance(notes, (list, tuple)) and all(isinstance(note, str) for note in notes)
