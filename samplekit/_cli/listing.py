"""``samplekit list``: samplers, scenes, randomizers and plugins, from their declarations alone."""

from __future__ import annotations

import math
import sys
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands._options import JsonOption

if TYPE_CHECKING:
    from samplekit._registry import Plugin
    from samplekit._specs.declaration import Declaration

_KINDS = ("samplers", "scenes", "randomizers", "plugins")
_WIDE = 100
"""Width of a terminal, in letters, from which on the table of samplers has all its columns."""


def _complete_kind(incomplete: str) -> list[str]:
    return [kind for kind in _KINDS if kind.startswith(incomplete)]


def _complete_name(context: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    from samplekit.commands._completion import complete_sampler, names

    kind = str(context.params.get("kind"))
    return complete_sampler(incomplete) if kind == "samplers" else names(kind.removesuffix("s"))


def list_(
    kind: Annotated[
        str, typer.Argument(metavar="[samplers|scenes|randomizers|plugins]", autocompletion=_complete_kind)
    ] = "",
    name: Annotated[
        str,
        typer.Argument(
            metavar="[NAME]", help="One of them, in full; a sampler as in --sampler.", autocompletion=_complete_name
        ),
    ] = "",
    json: JsonOption = False,
) -> None:
    """List samplers, scenes, randomizers and plugins; with a name, all that is declared of one.

    Examples: samplekit list samplers; samplekit list samplers halton+owen
    """
    from samplekit._errors import UsageError

    if (kind or name) and kind not in _KINDS:
        raise UsageError(f"list {kind}: expected {', '.join(_KINDS[:-1])} or {_KINDS[-1]}")
    if name:
        _print_one(kind, name, json)
        return
    chosen = (kind,) if kind else _KINDS
    if json:
        from json import dumps

        report: dict[str, Any] = {"schema": "samplekit.list/1"}
        for each in chosen:
            report[each] = _records(each)
        typer.echo(dumps(report, allow_nan=False))
        return
    for each in chosen:
        _print_table(each, *_table(each))
    if "samplers" in chosen and sys.stdout.isatty():
        typer.echo("samplekit list samplers NAME shows one with its options, its paper and what it promises.")


def _print_one(kind: str, name: str, json: bool) -> None:
    from samplekit._cli import sheet

    if kind == "plugins":
        plugin = _plugin(name)
        record, rows = asdict(plugin), sheet.describe_plugin(plugin)
    else:
        name, spec, plugin = sheet.choose(kind, name)
        record, rows = _record(name, spec, plugin), sheet.describe(spec, plugin)
    rows = {heading: lines for heading, lines in rows.items() if any(lines)}
    if json:
        from json import dumps

        report = {"schema": "samplekit.list/1", kind: [{**record, "in_words": rows}]}
        typer.echo(dumps(report, allow_nan=False))
        return
    for line in sheet.lines(name, rows):
        typer.echo(line)


def _records(kind: str) -> list[dict[str, Any]]:
    from samplekit._registry import plugins, registry

    if kind == "plugins":
        return [asdict(plugin) for plugin in plugins()]
    offers = registry().all(kind[:-1])  # type: ignore[arg-type]
    return [_record(name, offer.spec, offer.plugin) for name, offer in offers.items()]


def _record(name: str, spec: Declaration, plugin: Plugin) -> dict[str, Any]:
    from samplekit._cli import declaration_words as words
    from samplekit._specs import SamplerSpec

    record = {**asdict(spec), "name": name, "plugin": plugin.name}
    for option in record["options"]:
        # JSON has no infinity.
        option |= {end: str(option[end]) for end in ("minimum", "maximum") if abs(option[end] or 0) == math.inf}
    if isinstance(spec, SamplerSpec):
        # Largest indices pass 2^53, which many JSON readers round.
        record["largest_index"] = str(spec.largest_index)
        record["counts"] = str(spec.counts)
        record["progressive"] = words.progressive_word(spec)
        record["promises"] = [{"promise": promise.keyword, **vars(promise)} for promise in spec.promises]
    return record


def _plugin(name: str) -> Plugin:
    from samplekit._errors import UnknownNameError
    from samplekit._registry import plugins

    found = {plugin.name: plugin for plugin in plugins()}
    if name not in found:
        raise UnknownNameError("plugin", name, found)
    return found[name]


def _table(kind: str) -> tuple[list[str], list[list[str]]]:
    from samplekit._registry import plugins, registry

    if kind == "plugins":
        header = ["plugin", "distribution", "version", "status"]
        return header, [[plugin.name, plugin.distribution, plugin.version, _status(plugin)] for plugin in plugins()]
    offers = registry().all(kind[:-1])  # type: ignore[arg-type]
    if kind == "samplers":
        header = ["sampler", "what it is", "dimensions", "points", "progressive", "random", "promises"]
        return header, [_sampler_row(name, offer.spec) for name, offer in offers.items()]
    header = [kind[:-1], "options", "what it is"]
    return header, [[name, _options(offer.spec), offer.spec.summary] for name, offer in offers.items()]


def _sampler_row(name: str, spec: Any) -> list[str]:
    from samplekit._cli import declaration_words as words

    return [
        name,
        spec.summary,
        words.dimensions(spec),
        spec.counts.describe(),
        words.progressive_word(spec).replace("-", " "),
        "yes" if spec.randomized else "no",
        words.short_promises(spec.promises),
    ]


def _options(spec: Declaration) -> str:
    return ", ".join(f"{option.name}={option.default}" for option in spec.options)


def _status(plugin: Plugin) -> str:
    if plugin.blocked:
        return "switched off"
    if plugin.problems:
        return "problem: " + "; ".join(plugin.problems)
    return "; ".join(f"{kind}s: {', '.join(names)}" for kind, names in plugin.offers.items())


def _compact_samplers(wide: bool) -> tuple[list[str], list[list[str]]]:
    """Return the table of samplers for a terminal: short words, and fewer columns if the terminal is narrow."""
    from samplekit._cli import declaration_words as words
    from samplekit._registry import registry

    header = ["sampler", "dims", "points", "progressive", "random", "promises", "what it is"]
    rows = [
        [
            name,
            words.short_dimensions(offer.spec),
            offer.spec.counts.short(),
            words.short_progressive(offer.spec),
            "yes" if offer.spec.randomized else "no",
            words.short_promises(offer.spec.promises),
            offer.spec.summary,
        ]
        for name, offer in registry().all("sampler").items()
    ]
    kept = range(len(header)) if wide else (0, 1, 2, 6)
    return [header[i] for i in kept], [[row[i] for i in kept] for row in rows]


def _print_table(title: str, header: list[str], rows: list[list[str]]) -> None:
    if sys.stdout.isatty():
        from rich import box
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        console = Console()
        if title == "samplers":
            header, rows = _compact_samplers(console.width >= _WIDE)
        table = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left", padding=(0, 1, 0, 0))
        table.add_column(header[0], no_wrap=True)
        for column in header[1:]:
            table.add_column(column, overflow="fold")
        for row in rows:
            table.add_row(*(Text(cell) for cell in row))
        console.print(table)
        return
    typer.echo("\t".join(header))
    for row in rows:
        typer.echo("\t".join(row))
