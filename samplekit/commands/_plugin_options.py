"""Options that plugins add to commands: each sees the command's result, and adds facts to what the command prints."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from samplekit._boundary import Boundary

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from samplekit._registry import Registration
    from samplekit._specs import OptionValue

_given: ContextVar[Sequence[tuple[Registration, OptionValue]]] = ContextVar("plugin options", default=())


@contextmanager
def given(options: Sequence[tuple[Registration, OptionValue]]) -> Iterator[None]:
    """Remember the options that were given to the command that runs inside."""
    token = _given.set(options)
    try:
        yield
    finally:
        _given.reset(token)


def plugin_facts(result: Any) -> dict[str, Any]:
    """Hand a command's result to the plugins whose options were given, and return what they found.

    Parameters
    ----------
    result
        What the public function behind the command returned, such as a :class:`samplekit.Rendering`.

    Returns
    -------
    Names to values that JSON holds, in the order of the options.

    Raises
    ------
    PluginError
        A plugin failed, or returned something else.
    """
    facts: dict[str, Any] = {}
    for registration, value in _given.get():
        boundary = Boundary(f"option --{registration.spec.name}", registration.plugin)
        function = boundary.call("cannot be set up", registration.spec.load, callable, "a function")
        facts |= boundary.call(
            "failed",
            lambda function=function, value=value: function(result, value) or {},  # type: ignore[misc]
            lambda found: isinstance(found, dict) and all(isinstance(name, str) for name in found),
            "a dictionary with text as keys, or None",
        )
    return facts


def fact_lines(facts: dict[str, Any]) -> list[str]:
    """Return the facts of plugins as lines of a table."""
    return [f"  {name:<16}{value}" for name, value in facts.items()]
