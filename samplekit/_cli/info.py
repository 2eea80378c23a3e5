"""``samplekit info``: how an image was made."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from samplekit.commands._options import JsonOption


def info(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="An image that samplekit wrote, EXR or PNG.")],
    json: JsonOption = False,
) -> None:
    """Show how an image was made: the command that makes it again, versions, seed, metrics.

    Example: samplekit info zoneplate-hammersley-16spp.exr
    """
    from samplekit.files._images.reading import read_info

    found = read_info(file)
    if json:
        from json import dumps

        typer.echo(dumps({"schema": "samplekit.info/1", "file": str(file), **found}, allow_nan=False))
        return
    for line in _lines(found, ""):
        typer.echo(line)


def _lines(values: dict[str, Any], indent: str) -> list[str]:
    lines: list[str] = []
    width = max((len(name) for name in values), default=0)
    for name, value in values.items():
        if isinstance(value, dict):
            lines += [f"{indent}{name}", *_lines(value, indent + "  ")]
        else:
            lines.append(f"{indent}{name:<{width}}  {_text(value)}".rstrip())
    return lines


def _text(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(_text(item) for item in value)
    if isinstance(value, dict):
        return " ".join(_text(item) for item in value.values())
    return str(value)
