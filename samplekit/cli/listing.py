"""``samplekit list``: what is there, from the declarations alone."""

from __future__ import annotations

import sys
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.cli.options import JsonOption

if TYPE_CHECKING:
    from samplekit.registry import Offer, Plugin
    from samplekit.specs import SamplerSpec

_KINDS = ("samplers", "scenes", "randomizers", "plugins")


def _complete_kind(incomplete: str) -> list[str]:
    return [kind for kind in _KINDS if kind.startswith(incomplete)]


def list_(
    kind: Annotated[
        str, typer.Argument(metavar="[samplers|scenes|randomizers|plugins]", autocompletion=_complete_kind)
    ] = "",
    json: JsonOption = False,
) -> None:
    """List samplers, scenes, randomizers and plugins.

    Example: samplekit list samplers
    """
    from samplekit.errors import UsageError

    if kind and kind not in _KINDS:
        raise UsageError(f"list {kind}: expected {', '.join(_KINDS[:-1])} or {_KINDS[-1]}")
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


def _records(kind: str) -> list[dict[str, Any]]:
    from samplekit.registry import registry

    if kind == "plugins":
        return [asdict(plugin) for plugin in _plugins()]
    records = []
    for name, offer in registry().all(kind[:-1]).items():  # type: ignore[arg-type]
        record = asdict(offer.spec)
        record["name"] = name
        record["plugin"] = offer.plugin.name
        if kind == "samplers":
            # Largest indices pass 2^53, which many JSON readers round.
            record["largest_index"] = str(offer.spec.largest_index)
            record["promises"] = [{"promise": promise.keyword, **asdict(promise)} for promise in offer.spec.promises]
        records.append(record)
    return records


def _plugins() -> list[Plugin]:
    from samplekit.registry import registry

    registry().discover()
    return registry().plugins


def _table(kind: str) -> tuple[list[str], list[list[str]]]:
    from samplekit.registry import registry

    if kind == "plugins":
        return ["plugin", "distribution", "version", "status"], [
            [plugin.name, plugin.distribution, plugin.version, _status(plugin)] for plugin in _plugins()
        ]
    offers = registry().all(kind[:-1])  # type: ignore[arg-type]
    if kind == "samplers":
        header = ["sampler", "dimensions", "points", "progressive", "random", "promises", "what it is"]
        return header, [_sampler_row(name, offer.spec) for name, offer in offers.items()]
    header = [kind[:-1], "options", "what it is"]
    return header, [[name, _options(offer), offer.spec.summary] for name, offer in offers.items()]


def _sampler_row(name: str, spec: SamplerSpec) -> list[str]:
    from samplekit.counts import describe

    least, most = spec.dimensions
    dimensions = f"{least}" if most == least else f"{least} and more" if most is None else f"{least} to {most}"
    progressive = spec.progressive.replace("-", " ")
    promises = ", ".join(dict.fromkeys(promise.keyword for promise in spec.promises))
    return [
        name,
        dimensions,
        describe(spec.counts),
        progressive,
        "yes" if spec.randomized else "no",
        promises,
        spec.summary,
    ]


def _options(offer: Offer) -> str:
    return ", ".join(f"{option.name}={option.default}" for option in offer.spec.options)


def _status(plugin: Plugin) -> str:
    if plugin.blocked:
        return "switched off"
    if plugin.problems:
        return "problem: " + "; ".join(plugin.problems)
    return "; ".join(f"{kind}s: {', '.join(names)}" for kind, names in plugin.offers.items())


def _print_table(title: str, header: list[str], rows: list[list[str]]) -> None:
    if sys.stdout.isatty():
        from rich import box
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left")
        for column in header:
            table.add_column(column, overflow="fold")
        for row in rows:
            table.add_row(*(Text(cell) for cell in row))
        Console().print(table)
        return
    typer.echo("\t".join(header))
    for row in rows:
        typer.echo("\t".join(row))
