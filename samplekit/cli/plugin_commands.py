"""Commands from plugins: found when a name is not one of ours, imported when they run."""

from __future__ import annotations

from typing import Any

import typer
from typer.core import TyperGroup

OFFICIAL = {"spectrum": "samplekit-spectrum", "predict": "samplekit-spectrum"}
"""Commands of our own plugins, by the distribution that they come with: who misses one is told where it is."""

_CHOSEN = "samplekit.command-chosen"


class PluginGroup(TyperGroup):
    """The group of all commands: ours first, which nobody can replace, then those that plugins declare."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command that was chosen, to be run or completed: only then is its plugin imported."""
        ctx.meta[_CHOSEN] = True
        return super().resolve_command(ctx, args)

    def list_commands(self, ctx: Any) -> list[str]:
        """Our commands in the order of their making, then plugins' commands, sorted."""
        from samplekit.registry import registry

        own = super().list_commands(ctx)
        return [*own, *(name for name in registry().all("command") if name not in own)]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Our command of that name, else the plugin's; unknown names get the nearest."""
        own = super().get_command(ctx, cmd_name)
        if own is not None:
            return own
        from samplekit.errors import UsageError
        from samplekit.registry import registry

        try:
            offer = registry().find("command", cmd_name)
        except UsageError as error:
            raise UsageError(_unknown(cmd_name, super().list_commands(ctx), str(error))) from None
        if not ctx.meta.get(_CHOSEN):
            # Help needs the declaration alone.
            return typer.main.get_command(_described(offer.spec.name, offer.spec.summary))
        single = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        single.command(offer.spec.name, help=_plain(offer.spec.summary))(offer.spec.load())
        return typer.main.get_command(single)


def _plain(summary: str) -> str:
    """The summary with its brackets kept from being taken for markup."""
    return summary.replace("[", r"\[")


def _described(name: str, summary: str) -> typer.Typer:
    app = typer.Typer(add_completion=False)

    @app.command(name, help=_plain(summary))
    def _command() -> None: ...

    return app


def _unknown(name: str, own: list[str], reason: str) -> str:
    import difflib

    _, _, plugins = reason.partition(" (plugins ")
    plugins = f" (plugins {plugins}" if plugins else ""
    if name in OFFICIAL:
        where = f"{OFFICIAL[name]} (plugins/{OFFICIAL[name].removeprefix('samplekit-')} in samplekit's sources)"
        return f"the command {name!r} comes with the plugin {where}, which is not installed or did not load{plugins}"
    from samplekit.registry import registry

    others = registry().all("command")
    near = difflib.get_close_matches(name, [*own, *others], n=1, cutoff=0.5)
    if near:
        return f"unknown command {name!r}: did you mean {near[0]}?"
    return f"unknown command {name!r}: there are {', '.join([*own, *others])}{plugins}"
