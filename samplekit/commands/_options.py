"""Options that several commands share."""

from typing import Annotated

import typer

from samplekit.commands._completion import complete_sampler

JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of a table.")]
"""``--json``: print one JSON object on standard output, and nothing else."""
SeedOption = Annotated[str, typer.Option("--seed", metavar="K", help="Seed, from 0 to 2^64 - 1.")]
"""``--seed K``: a text, which :func:`parse_seed` reads."""
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
"""``--sampler``, ``-s``: a sampler with its options and its randomizer, completed by the shell."""
