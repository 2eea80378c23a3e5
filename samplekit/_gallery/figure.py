"""What a figure of the gallery is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit._drawing.drawing import Drawing


@dataclass(frozen=True)
class Figure:
    """A picture, what to see in it, and how to see it for oneself.

    Attributes
    ----------
    name
        Of the file, without ``.png``.
    title, caption
        What it shows, and what to see there.
    command
        One that shows the same, or a part of it, on the command line.
    draw
        Makes it. Equal calls give equal pixels, unless it is ``measured``.
    plugins
        Distributions that it needs beside the core.
    chapter
        Figures of one chapter stand together.
    measured
        It shows run times, which no two runs have the same: it is made only where there is none.
    """

    name: str
    title: str
    caption: str
    command: str
    draw: Callable[[], Drawing]
    plugins: tuple[str, ...] = ()
    chapter: str = ""
    measured: bool = False
