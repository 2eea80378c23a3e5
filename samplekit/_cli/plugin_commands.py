"""Commands from plugins: looked up when a name is not that of a built-in command, imported when they run."""

from __future__ import annotations

import functools
import os
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperGroup

from samplekit._boundary import Boundary
from samplekit._cli.command import Command, TyperError, arranged
from samplekit._errors import SamplekitError, UnknownNameError, UsageError
from samplekit._quoting import quoted, reason

if TYPE_CHECKING:
    from samplekit._registry import Registration

OFFICIAL = {"spectrum": "samplekit-spectrum", "predict": "samplekit-spectrum"}
"""Commands of the official plugins by their distribution, so that the error for a missing one says where it is."""

_CHOSEN = "samplekit.command-chosen"
_LARGEST_STATUS = 255


class PluginGroup(TyperGroup):
    """The group of all commands: first the built-in ones, which no plugin can replace, then those of plugins."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the parameters, arranged for the help."""
        return arranged(super().get_params(ctx))

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command that was chosen, to be run or completed: only then is its plugin imported."""
        ctx.meta[_CHOSEN] = True
        return super().resolve_command(ctx, args)

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names of the built-in commands in their order, then those of plugins, sorted."""
        from samplekit._registry import registry

        own = super().list_commands(ctx)
        return [*own, *(name for name in registry().all("command") if name not in own)]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Return the built-in command of that name, or else a plugin's; an error names the nearest."""
        own = super().get_command(ctx, cmd_name)
        if own is not None:
            return own
        from samplekit._registry import registry

        try:
            registration = registry().find("command", cmd_name)
        except UsageError as error:
            if ctx.resilient_parsing:
                # The shell asks for completions, and there are none.
                return None
            if isinstance(error, UnknownNameError):
                raise _unknown(error, super().list_commands(ctx)) from None
            raise
        if not ctx.meta.get(_CHOSEN):
            # Help needs the declaration alone.
            return Command(registration.name, help=_plain(registration.spec.summary))
        try:
            return _made(registration)
        except SamplekitError:
            if ctx.resilient_parsing:
                return None
            raise


def _made(registration: Registration) -> Any:
    """Return the command of a plugin. Its faults name the plugin."""
    boundary = Boundary(f"command {registration.name}", registration.plugin)
    run = boundary.call("cannot be set up", registration.spec.load, callable, "a function")

    @functools.wraps(run)
    def guarded(*arguments: Any, **options: Any) -> Any:
        try:
            status = run(*arguments, **options)
        except (SamplekitError, MemoryError, OSError, typer.Exit, typer.Abort, TyperError):
            raise
        except Exception as error:
            if os.environ.get("SAMPLEKIT_TRACEBACK"):
                raise
            raise boundary.error(f"failed: {reason(error)}") from error
        if isinstance(status, int) and not (isinstance(status, bool) or 0 <= status <= _LARGEST_STATUS):
            raise boundary.error(
                f"returned {quoted(status)}: expected an exit status from 0 to {_LARGEST_STATUS}, or None"
            )
        return None if isinstance(status, bool) else status

    single = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    single.command(registration.name, help=_plain(run.__doc__ or registration.spec.summary), cls=Command)(guarded)
    return boundary.call("cannot be set up", lambda: typer.main.get_command(single))


def _plain(summary: str) -> str:
    """Return the summary with its brackets escaped, which typer would take for markup."""
    return summary.replace("[", r"\[")


def _unknown(error: UnknownNameError, own: list[str]) -> UsageError:
    """Return the error for a name that no command has, built-in ones included."""
    name = error.name
    if name in OFFICIAL:
        where = f"{OFFICIAL[name]} (plugins/{OFFICIAL[name].removeprefix('samplekit-')} in samplekit's sources)"
        return UsageError(
            f"the command {name!r} comes with the plugin {where}, which is not installed or did not load"
            f"{error.plugin_hints}"
        )
    return UnknownNameError("command", name, {*own, *error.known}, error.plugin_hints)
