"""``samplekit gallery``: the pictures of the documentation, made from nothing."""

from __future__ import annotations

from typing import Annotated

import typer

from samplekit.commands._options import JsonOption

SCHEMA = "samplekit.gallery/1"


def gallery(
    output: Annotated[str, typer.Option("--output", "-o", metavar="DIR", help="A folder, made if need be.")] = "images",
    only: Annotated[
        list[str] | None, typer.Option("--only", metavar="NAME", help="This figure alone; can be given several times.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Make pictures anew that are there already.")] = False,
    names: Annotated[bool, typer.Option("--names", help="Print what figures there are, and make none.")] = False,
    json: JsonOption = False,
) -> int:
    """Make the pictures of the documentation: the course's figures, and the samplers side by side.

    Pictures that this version has made already are left, so that a run which was stopped goes on.

    Example: samplekit gallery --output pictures --only depth-of-field
    """
    from json import dumps
    from pathlib import Path

    from samplekit._gallery.figures import all_figures
    from samplekit._gallery.runner import chosen_figures, make_gallery
    from samplekit.commands._notices import announce_compilation
    from samplekit.commands._progress import Progress

    if names:
        figures = all_figures()
        if json:
            rows = [{"name": figure.name, "title": figure.title, "command": figure.command} for figure in figures]
            typer.echo(dumps({"schema": SCHEMA, "figures": rows}))
        else:
            for figure in figures:
                typer.echo(f"{figure.name:<34} {figure.title}")
        return 0
    chosen = chosen_figures(only or [])
    announce_compilation()
    files: dict[str, list[str]] = {"made": [], "kept": []}
    with Progress("drawing") as progress:
        for path, new in make_gallery(Path(output), chosen, fresh=fresh, progress=progress):
            files["made" if new else "kept"].append(str(path))
            if not json:
                typer.echo(f"{'made' if new else 'kept'}  {path}")
    if json:
        typer.echo(dumps({"schema": SCHEMA, **files}))
    return 0
