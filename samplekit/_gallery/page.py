"""The gallery's page: every picture with what to see and the command that shows it."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._gallery.figure import Figure


def page(figures: Sequence[Figure]) -> str:
    """Return the page as Markdown, which stands in the folder of the pictures."""
    parts = ["# Gallery\n\nEvery picture here is made by `samplekit gallery`.\n"]
    for chapter, members in groupby(figures, key=lambda figure: figure.chapter):
        parts.append(f"\n## {chapter}\n")
        for figure in members:
            parts.append(f"\n### {figure.title}\n\n![{figure.title}]({figure.name}.png)\n\n{figure.caption}\n")
            parts.append(f"\n```sh\n{figure.command}\n```\n")
    return "".join(parts)
