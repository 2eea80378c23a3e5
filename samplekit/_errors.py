"""Errors: each is one line that a user can act on, and an object that carries what a program needs."""

from __future__ import annotations

import copyreg
import difflib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


class SamplekitError(Exception):
    """Something failed while running: the message is one clear line. Exit status 1.

    Examples
    --------
    >>> import samplekit
    >>> issubclass(samplekit.UsageError, samplekit.SamplekitError)
    True
    """

    def __reduce__(self) -> tuple[Any, ...]:
        # Errors come back from other processes with all that they carry, whatever their constructors take.
        return copyreg.__newobj__, (type(self), *self.args), vars(self)  # type: ignore[attr-defined]


class UsageError(SamplekitError):
    """The request was wrong: the message says what would be right. Exit status 2.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.points("jittered", count=97)
    ... except samplekit.UsageError as error:
    ...     print("nearest" in str(error))
    True
    """


class UnknownNameError(UsageError):
    """No sampler, scene, randomizer or command has the given name.

    Attributes
    ----------
    kind, name
        What was looked for: ``"sampler"`` and the like, and the name.
    known
        All names of that kind, sorted.
    near
        The known names that are spelled most alike, at most three.
    plugin_hints
        Plugins that failed or are switched off, as the end of a message; empty if there are none.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.sampler("sobel")
    ... except samplekit.UnknownNameError as error:
    ...     print(error.near[0])
    sobol
    """

    def __init__(self, kind: str, name: str, known: Iterable[str], plugin_hints: str = "") -> None:
        self.kind, self.name = kind, name
        self.known = sorted(known)
        self.near = difflib.get_close_matches(name, self.known, n=3, cutoff=0.5)
        self.plugin_hints = plugin_hints
        hint = f"did you mean {' or '.join(self.near)}?" if self.near else f"there are {', '.join(self.known)}"
        super().__init__(f"unknown {kind} {name!r}: {hint}{plugin_hints}")


class AmbiguousNameError(UsageError):
    """Several plugins offer the given name.

    Attributes
    ----------
    choices
        The full names, ``PLUGIN/NAME``, of which each chooses one.

    Examples
    --------
    >>> from samplekit import AmbiguousNameError
    >>> AmbiguousNameError("sampler", "blue", ["plugin a", "plugin b"], ["a/blue", "b/blue"]).choices
    ['a/blue', 'b/blue']
    """

    def __init__(self, kind: str, name: str, plugins: Sequence[str], choices: Sequence[str]) -> None:
        self.choices = list(choices)
        super().__init__(f"{kind} {name!r} is offered by {' and '.join(plugins)}: write {' or '.join(choices)}")


class CountError(UsageError):
    """A sampler cannot make the number of points that was asked for.

    Attributes
    ----------
    count
        The number that was asked for.
    below, above
        The nearest numbers that it makes; None where there is none.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.points("jittered", count=97)
    ... except samplekit.CountError as error:
    ...     print(error.below, error.above)
    96 98
    """

    def __init__(self, message: str, count: int, below: int | None, above: int | None) -> None:
        self.count, self.below, self.above = count, below, above
        super().__init__(message)


class DimensionsError(UsageError):
    """A sampler does not make points in the number of dimensions that was asked for.

    Attributes
    ----------
    dims
        The number that was asked for.
    least, most
        The numbers that it makes; ``most`` None: any from ``least`` on.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.points("fibonacci", count=8, dims=3)
    ... except samplekit.DimensionsError as error:
    ...     print(error.most)
    2
    """

    def __init__(self, name: str, dims: int, least: int, most: int | None) -> None:
        self.dims, self.least, self.most = dims, least, most
        span = f"{least}" if most == least else f"at least {least}" if most is None else f"{least} to {most}"
        super().__init__(f"{name} makes points in {span} dimension{'' if most == 1 else 's'}, not {dims}")


class PluginError(SamplekitError):
    """The code of a plugin failed, or returned something that is not allowed.

    Attributes
    ----------
    plugin
        Name, distribution and version of the plugin.

    Examples
    --------
    >>> from samplekit import PluginError
    >>> PluginError("sampler toy", "toys (toys 1.0)", "failed: ZeroDivisionError").plugin
    'toys (toys 1.0)'
    """

    def __init__(self, what: str, plugin: str, fault: str) -> None:
        self.plugin = plugin
        super().__init__(f"{what} of plugin {plugin} {fault}")


class InvalidPointsError(PluginError):
    """A plugin's sampler or randomizer wrote values outside [0, 1), or left some unwritten.

    Examples
    --------
    >>> import samplekit
    >>> issubclass(samplekit.InvalidPointsError, samplekit.PluginError)
    True
    """
