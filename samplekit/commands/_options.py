"""Options that several commands share."""

from typing import Annotated

import typer

from samplekit.commands._completion import complete_sampler

JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of a table.")]
SeedOption = Annotated[str, typer.Option("--seed", metavar="K", help="Seed, from 0 to 2^64 - 1.")]
SamplerOption = Annotated[
    str,
    typer.Option(
        "--sampler",
        "-s",
        metavar="NAME[:OPTION=VALUE,...][+RANDOMIZER]",
        help="The sampler, such as hammersley or sobol+owen.",
        autocompletion=complete_sampler,
    ),
]
