"""The parts that all declarations share, and the declarations of commands and of options."""

from __future__ import annotations

import contextlib
import importlib
import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from samplekit._errors import SamplekitError, UsageError
from samplekit._quoting import reason
from samplekit._specs.fields import NAME, instance_of, integer, is_line, matching, require_fields, tuple_of
from samplekit._specs.option import Option, OptionValue

if TYPE_CHECKING:
    from collections.abc import Mapping

API_VERSION = 1


@dataclass(frozen=True)
class Declaration:
    """The fields that every declaration has.

    Parameters
    ----------
    name
        As written on the command line: ``[a-z][a-z0-9-]*``.
    target
        Where the implementation is: ``"package.module:Class"``. It is imported when it is first used.
    summary
        One line for lists.
    options
        What can be set, and its defaults.
    reference
        The paper that describes it.
    api_version
        The plugin interface that it was written for.
    """

    name: str
    target: str
    summary: str
    options: tuple[Option, ...] = field(default=(), kw_only=True)
    reference: str = field(default="", kw_only=True)
    api_version: int = field(default=API_VERSION, kw_only=True)

    def __post_init__(self) -> None:
        require_fields(
            self,
            self.name,
            name=(matching(NAME), f"of the form {NAME}"),
            target=(matching(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*"), "of the form 'package.module:Class'"),
            summary=(is_line, "text of one line"),
            reference=(is_line, "text of one line"),
            options=(tuple_of(instance_of(Option)), "a tuple of options, each an Option"),
            api_version=(integer(1), "a positive integer"),
        )
        if len({option.name for option in self.options}) < len(self.options):
            raise ValueError(f"{self.name}: an option is declared twice")
        if self.api_version > API_VERSION:
            raise ValueError(
                f"{self.name}: made for plugin interface {self.api_version}, this samplekit has {API_VERSION}:"
                " upgrade samplekit-core"
            )

    def load(self) -> Any:
        """Import the implementation and return it.

        Raises
        ------
        SamplekitError
            The target cannot be imported.
        """
        module, _, attribute = self.target.partition(":")
        try:
            # Results go to standard output: what a module prints while it is imported must not stand among them.
            with contextlib.redirect_stdout(sys.stderr):
                return getattr(importlib.import_module(module), attribute)
        except (Exception, SystemExit) as error:
            raise SamplekitError(f"{self.name}: cannot import {self.target}: {reason(error)}") from error

    @property
    def required_options(self) -> tuple[str, ...]:
        """Names of the options that must be given, such as the path of a file."""
        return tuple(option.name for option in self.options if option.required)

    def parse_options(self, given: Mapping[str, object]) -> dict[str, OptionValue]:
        """Return the values of all options: those given, parsed, and the defaults of the rest.

        Raises
        ------
        UsageError
            An unknown option, a required one that is missing, or a value that its option does not take.
        """
        known = {option.name: option for option in self.options}
        for name in given:
            if name not in known:
                takes = ", ".join(known) if known else "none"
                raise UsageError(f"{self.name} has no option {name!r}: it takes {takes}")
        for name, option in known.items():
            if option.required and name not in given:
                example = f"{self.name}:{name}={name.upper()}"
                raise UsageError(f"{self.name} needs the option {name} ({option.summary}): write {example}")
        try:
            return {
                name: option.parse(given[name]) if name in given else option.default for name, option in known.items()
            }
        except UsageError as error:
            raise UsageError(f"{self.name}: {error}") from None


class CommandSpec(Declaration):
    """The declaration of a command; ``target`` names a function that typer can turn into a command.

    Examples
    --------
    >>> from samplekit import CommandSpec
    >>> CommandSpec("gaps", "mine.command:gaps", "Distances to the nearest neighbours.").name
    'gaps'
    """


@dataclass(frozen=True)
class CommandOption(Declaration):
    """The declaration of an option that a plugin adds to a command.

    ``target`` names a function that is called as ``function(result, value)`` when the command has its result: the
    object that the public function behind the command returned, and the value of the option. It returns a dictionary of
    facts, which the command prints and puts into its JSON, or None.

    Parameters
    ----------
    name
        The option is written ``--NAME``.
    command
        The command that takes it, such as ``"render"``.
    default
        Its type is the type of the value: int, float, str or bool; an option of type bool is a flag.

    Examples
    --------
    >>> from samplekit import CommandOption
    >>> CommandOption("peak", "mine.peak:peak", "Report the largest pixel.", command="render", default=False).command
    'render'
    """

    command: str = field(default="", kw_only=True)
    default: OptionValue = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        require_fields(self, self.name, command=(matching(NAME), "the name of a command"))
        Option(self.name, self.default, self.summary)

    @property
    def option(self) -> Option:
        """The option with its type."""
        return Option(self.name, self.default, self.summary)
