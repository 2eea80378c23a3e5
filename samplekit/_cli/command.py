"""Commands: options that are given once, headings in the help, and the options that plugins add."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperCommand, TyperOption

from samplekit._errors import UsageError
from samplekit.commands import _plugin_options as plugin_options

if TYPE_CHECKING:
    from samplekit._registry import Registration

# typer does not export the bases of its own exceptions, and they live in a private module.
TyperUsageError: type[Exception] = typer.BadParameter.__mro__[1]
TyperError: type[Exception] = typer.BadParameter.__mro__[2]

_PANELS = {
    "How it runs": "threads processes dask jobs resume no_time budget isolated time_limit memory_limit",
    "What comes out": "output directory json html explain ssim flip no_error scale",
}
_PANEL_OF = {name: panel for panel, names in _PANELS.items() for name in names.split()}


def arranged(parameters: list[Any]) -> list[Any]:
    """Put each option under its heading in the help, unless the command's author has done so."""
    for parameter in parameters:
        if isinstance(parameter, TyperOption):
            parameter.rich_help_panel = parameter.rich_help_panel or _PANEL_OF.get(parameter.name or "")
            if parameter.is_flag and parameter.metavar is None:
                # A flag takes no value: its type would read as one.
                parameter.metavar = ""
    return parameters


class Command(TyperCommand):
    """A command that refuses a second value of an option, and takes the options that plugins add."""

    _added: list[Registration] | None = None

    def get_params(self, ctx: Any) -> list[Any]:
        """Return all parameters, arranged for the help."""
        added = [_parameter(registration) for registration in self._added or ()]
        return arranged([*super().get_params(ctx), *added])

    def parse_args(self, ctx: Any, args: list[str]) -> Any:
        """Read the arguments; plugins are looked at only where an option is not the command's own."""
        own = {text for parameter in super().get_params(ctx) for text in parameter.opts} - {"-h", "--help"}
        if any(word == "-h" or (word.startswith("--") and word.partition("=")[0] not in own) for word in args):
            self._add_options()
        if not ctx.resilient_parsing:
            _, _, order = self.make_parser(ctx).parse_args(args=list(args))
            given = Counter(
                parameter.opts[0]
                for parameter in order
                if isinstance(parameter, TyperOption) and not (parameter.multiple or parameter.is_flag)
            )
            for name, times in given.items():
                if times > 1:
                    raise UsageError(f"{name} is given {times} times: expected it once")
        return super().parse_args(ctx, args)

    def invoke(self, ctx: Any) -> Any:
        """Run the command; the values of plugins' options wait for its result."""
        given = [
            (registration, registration.spec.option.parse(value))
            for registration in self._added or ()
            if (value := ctx.params.pop(registration.spec.name.replace("-", "_"), None)) not in (None, "", False)
        ]
        with plugin_options.given(given):
            return super().invoke(ctx)

    def _add_options(self) -> None:
        if self._added is None:
            from samplekit._registry import registry

            found = registry().all("option").values()
            self._added = [registration for registration in found if registration.spec.command == self.name]


def _parameter(registration: Registration) -> TyperOption:
    """Return the option of a plugin as typer has it; its value stays text until the command runs."""
    spec = registration.spec
    flag = isinstance(spec.option.default, bool)
    settings = typer.Option(
        f"--{spec.name}", help=spec.summary, metavar=None if flag else spec.name.upper(), rich_help_panel="From plugins"
    )

    def declare(value: Any = False if flag else "") -> None: ...

    declare.__annotations__ = {"value": Annotated[bool if flag else str, settings], "return": None}
    single = typer.Typer(add_completion=False)
    single.command(spec.name)(declare)
    made: Any = typer.main.get_command(single)
    (parameter,) = (each for each in made.params if f"--{spec.name}" in each.opts)
    parameter.name = spec.name.replace("-", "_")
    return parameter  # type: ignore[no-any-return]
