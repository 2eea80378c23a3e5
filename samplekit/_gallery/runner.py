"""Making the gallery: figure after figure, leaving those that are there already."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, distribution
from typing import TYPE_CHECKING

from samplekit._drawing.raster import draw_pixels
from samplekit._errors import SamplekitError, UsageError
from samplekit._gallery.figures import all_figures
from samplekit._gallery.page import page
from samplekit._gallery.sources import made_from
from samplekit._provenance import versions
from samplekit.files._images.png import read_png, write_png
from samplekit.files._verified import text_writer
from samplekit.files._writing import check_targets, shown, write_group

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from samplekit._gallery.figure import Figure

SCHEMA = "samplekit.figure/1"
PAGE = "README.md"


def chosen_figures(names: Sequence[str]) -> list[Figure]:
    """The figures of these names; all, if there are none.

    Raises
    ------
    UsageError
        An unknown name, or a figure whose plugin is not installed.
    """
    figures = all_figures()
    known = {figure.name: figure for figure in figures}
    for name in names:
        if name not in known:
            raise UsageError(f"unknown figure {name!r}: there are {', '.join(known)}")
    chosen = [figure for figure in figures if not names or figure.name in names]
    missing = sorted({plugin for figure in chosen for plugin in figure.plugins if not _installed(plugin)})
    if missing:
        raise UsageError(f"the gallery needs {', '.join(missing)}: install them from plugins/ beside samplekit")
    return chosen


def make_gallery(
    folder: Path, figures: Sequence[Figure], *, fresh: bool = False, progress: Callable[[int, int], None]
) -> Iterator[tuple[Path, bool]]:
    """Make the figures, each written whole or not at all; give each path, and whether the picture is new.

    A picture that was made from the same sources is left as it is, so that a run which was stopped goes on.

    Parameters
    ----------
    folder
        It is made if it does not exist; its parent must.
    fresh
        Make all of them anew.
    progress
        Called with the numbers of figures done and to do.

    Raises
    ------
    UsageError
        A folder that cannot be written to.
    """
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot make the folder {shown(folder)}: {error.strerror}") from None
    paths = [folder / f"{figure.name}.png" for figure in figures]
    check_targets([*paths, folder / PAGE])
    for done, (figure, path) in enumerate(zip(figures, paths, strict=True)):
        progress(done, len(figures))
        new = fresh or not _is_current(figure, path)
        if new:
            write_png(path, draw_pixels(figure.draw()), _metadata(figure))
        yield path, new
    if len(figures) == len(all_figures()):
        write_group([(folder / PAGE, text_writer([page(figures)]))])


def _metadata(figure: Figure) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "command": f"samplekit gallery --only {figure.name}",
        "shows": figure.command,
        "title": figure.title,
        "caption": figure.caption,
        "made_from": made_from(),
        "versions": versions(),
    }


def _is_current(figure: Figure, path: Path) -> bool:
    try:
        _, metadata = read_png(path)
    except SamplekitError:
        return False
    return metadata.get("made_from") == made_from() or (figure.measured and metadata.get("title") == figure.title)


def _installed(name: str) -> bool:
    try:
        distribution(name)
    except PackageNotFoundError:
        return False
    return True
