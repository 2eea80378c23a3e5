"""The tables of samplers and scenes in the Markdown pages, from the declarations.

`python docs/hooks/tables.py` writes them between their markers; a test compares them.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from samplekit._cli import declaration_words as words
from samplekit._registry import registry

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parent.parent.parent
PAGES = ("README.md", "docs/choosing-a-sampler.md")
OURS = ("samplekit", "bluenoise", "lattice", "spectrum")


def _table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |\n" for line in lines)


def _options(spec: object) -> str:
    return ", ".join(f"`{option.name}`" for option in spec.options)  # type: ignore[attr-defined]


def samplers() -> str:
    """Each sampler with what it is and what one chooses by."""
    rows = [
        [
            f"`{name}`",
            offer.spec.summary,
            words.short_dimensions(offer.spec),
            offer.spec.counts.short(),
            words.short_progressive(offer.spec),
            words.short_promises(offer.spec.promises),
            _options(offer.spec),
        ]
        for name, offer in registry().all("sampler").items()
        if offer.plugin.name in OURS
    ]
    return _table(["sampler", "what it is", "dims", "points", "progressive", "promises", "options"], rows)


def scenes() -> str:
    """Each scene with its options."""
    rows = [
        [f"`{name}`", offer.spec.summary, ", ".join(f"{p} {n}" for p, n in offer.spec.purposes), _options(offer.spec)]
        for name, offer in registry().all("scene").items()
        if offer.plugin.name in OURS
    ]
    return _table(["scene", "what it is", "dimensions", "options"], rows)


def randomizers() -> str:
    """Each randomizer with what it keeps."""
    rows = [
        [f"`+{name}`", offer.spec.summary, ", ".join(offer.spec.keeps) or "nothing"]
        for name, offer in registry().all("randomizer").items()
        if offer.plugin.name in OURS
    ]
    return _table(["randomizer", "what it does", "promises that it keeps"], rows)


TABLES: dict[str, Callable[[], str]] = {"samplers": samplers, "scenes": scenes, "randomizers": randomizers}


def filled(page: str) -> str:
    """Return the page with every table between its markers as the declarations have it."""
    for name, table in TABLES.items():
        begin, end = f"<!-- table: {name} -->\n", "<!-- end of table -->"
        before, found, rest = page.partition(begin)
        if found:
            page = f"{before}{begin}\n{table()}\n{end}{rest.partition(end)[2]}"
    return page


if __name__ == "__main__":
    for page in PAGES:
        path = ROOT / page
        path.write_text(filled(path.read_text(encoding="utf-8")), encoding="utf-8")
