"""Options that several commands share."""

from typing import Annotated

import typer

JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of a table.")]
SeedOption = Annotated[str, typer.Option("--seed", metavar="K", help="Seed, from 0 to 2^64 - 1.")]
