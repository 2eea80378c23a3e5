"""Make the pictures of the gallery, and its page: ``python docs/gallery/build.py [NAME...]``.

A figure is a script beside this one: its docstring has the title, the caption and a command that shows the same, and
its code saves the picture under the script's own name in ``images/``.
"""

from __future__ import annotations

import argparse
import ast
import runpy
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent
CHAPTERS = {
    "Zone plates": "zoneplate-four-samplers zoneplates-1spp zoneplates-4spp zoneplates-16spp",
    "Samplers: points, expected power spectrum, radial mean": """
        sampler-random sampler-regular sampler-jittered sampler-n-rooks sampler-multi-jittered
        sampler-correlated-multi-jittered sampler-poisson-disk sampler-lloyd sampler-ccvt sampler-halton
        sampler-hammersley sampler-halton-owen sampler-sobol sampler-sobol-xor sampler-sobol-owen sampler-pmj02
        sampler-r2""",
    "Convergence": "convergence-disk convergence-gaussian course-table poisson-disk-and-jitter error-against-time",
    "Images": "random-and-jittered depth-of-field ambient-occlusion motion-blur error-white-and-blue",
    "Conformance": "net-with-a-wrong-bit",
}
NAMES = [name for names in CHAPTERS.values() for name in names.split()]
MEASURED = {"error-against-time"}
"""Figures of run times, which no two runs have the same: made when they are named, or when there is no picture."""


class Text(NamedTuple):
    """What the docstring of a script says about its figure."""

    title: str
    caption: str
    command: str


def read(name: str) -> Text:
    """Read the title, the caption and the command in the docstring of a figure's script."""
    docstring = ast.get_docstring(ast.parse((HERE / f"{name}.py").read_text(encoding="utf-8"))) or ""
    heading, caption, command = docstring.split("\n\n")
    return Text(heading.splitlines()[0], " ".join(caption.split()), command.strip())


def page() -> str:
    """Return the gallery's page in Markdown, which stands in the folder of the pictures."""
    parts = [
        "# Gallery\n\n`python docs/gallery/build.py` makes every picture here, each with the script that its title links.\n"
    ]
    for chapter, names in CHAPTERS.items():
        parts.append(f"\n## {chapter}\n")
        for name in names.split():
            title, caption, command = read(name)
            parts.append(f"\n### [{title}](../docs/gallery/{name}.py)\n\n![{title}]({name}.png)\n\n{caption}\n")
            parts.append(f"\n```sh\n{command}\n```\n")
    return "".join(parts)


def main() -> int:
    """Run the scripts that are named, or all of them, and write the page."""
    parser = argparse.ArgumentParser(description="Make the pictures of the gallery, and its page.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="A figure to make; by default all.")
    parser.add_argument("--output", type=Path, default=HERE.parents[1] / "images", help="An existing folder.")
    given = parser.parse_args()
    if unknown := set(given.names) - set(NAMES):
        parser.error(f"unknown figure {', '.join(sorted(unknown))}: there are {', '.join(NAMES)}")
    import _shared

    _shared.folder = given.output
    for name in given.names or NAMES:
        if not given.names and name in MEASURED and (given.output / f"{name}.png").exists():
            continue
        print(name, flush=True)
        runpy.run_path(str(HERE / f"{name}.py"), run_name="__main__")
    (given.output / "README.md").write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
