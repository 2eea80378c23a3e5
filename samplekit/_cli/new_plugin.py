"""``samplekit new-plugin``: a complete plugin to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from samplekit.commands import JsonOption


def new_plugin(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of plugin and sampler, such as golden-ratio.")],
    directory: Annotated[
        Path, typer.Option("--directory", metavar="DIR", help="Where the folder samplekit-NAME is made.")
    ] = Path(),
    json: JsonOption = False,
) -> int:
    """Write a complete plugin into the folder samplekit-NAME: a sampler that works, its declaration, its tests.

    Example: samplekit new-plugin golden-ratio
    """
    from samplekit._scaffold.plugin import write_plugin

    files = write_plugin(name, directory)
    if json:
        from json import dumps

        report = {"schema": "samplekit.new-plugin/1", "name": name, "files": [str(file) for file in files]}
        typer.echo(dumps(report, allow_nan=False))
        return 0
    for file in files:
        typer.echo(str(file))
    typer.echo(f"next: python -m pip install -e '{files[0].parent}[test]' && samplekit check {name}", err=True)
    return 0
