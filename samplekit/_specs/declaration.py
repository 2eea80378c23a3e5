"""What every declaration has in common."""

from __future__ import annotations

import contextlib
import importlib
import re
import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from samplekit._errors import SamplekitError, UsageError
from samplekit._quoting import quoted, reason
from samplekit._specs.option import NAME, Option, OptionValue, is_line, require

if TYPE_CHECKING:
    from collections.abc import Mapping

API_VERSION = 1
TARGET = re.compile(r"^[A-Za-z_][\w.]*:[A-Za-z_]\w*\Z")


def is_integer(value: object) -> bool:
    """Whether it is an integer, and no truth value."""
    return isinstance(value, int) and not isinstance(value, bool)


@dataclass(frozen=True)
class Declaration:
    """What every declaration has: a name, where its code is, a line of summary, options, a paper."""

    name: str
    target: str
    summary: str
    options: tuple[Option, ...] = field(default=(), kw_only=True)
    reference: str = field(default="", kw_only=True)
    api_version: int = field(default=API_VERSION, kw_only=True)

    def __post_init__(self) -> None:
        require(
            isinstance(self.name, str) and bool(NAME.match(self.name)), f"bad name {self.name!r}: want [a-z][a-z0-9-]*"
        )
        require(
            isinstance(self.target, str) and bool(TARGET.match(self.target)),
            f"{self.name}: bad target {self.target!r}: want 'package.module:Class'",
        )
        for word in ("summary", "reference"):
            require(is_line(getattr(self, word)), f"{self.name}: the {word} must be text of one line")
        require(isinstance(self.options, tuple), f"{self.name}: options must be a tuple")
        for option in self.options:
            require(isinstance(option, Option), f"{self.name}: {quoted(option)} is no Option")
        names = [option.name for option in self.options]
        require(len(set(names)) == len(names), f"{self.name}: an option is declared twice")
        require(is_integer(self.api_version), f"{self.name}: api_version must be an integer")
        require(
            self.api_version <= API_VERSION,
            f"{self.name}: made for plugin interface {self.api_version}, this samplekit has {API_VERSION}:"
            " upgrade samplekit-core",
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
        """Names of the options without which there is none of these: a file's path, say."""
        return tuple(option.name for option in self.options if option.required)

    def parse_options(self, given: Mapping[str, object]) -> dict[str, OptionValue]:
        """All options with their values: those given, parsed, and the defaults of the rest.

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


@dataclass(frozen=True)
class CommandSpec(Declaration):
    """What a command declares: ``target`` names a function that typer can turn into a command.

    Examples
    --------
    >>> from samplekit import CommandSpec
    >>> CommandSpec("gaps", "mine.command:gaps", "Distances to the nearest neighbours.").name
    'gaps'
    """


@dataclass(frozen=True)
class CommandOption(Declaration):
    """What a plugin declares to add an option to a command.

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
        require(isinstance(self.command, str) and bool(NAME.match(self.command)), f"{self.name}: name the command")
        Option(self.name, self.default, self.summary)

    @property
    def option(self) -> Option:
        """The option with its type."""
        return Option(self.name, self.default, self.summary)
