"""A sweep as a table of text, as CSV, as JSON, and as files in a folder."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from samplekit._stability.sweep import precision_lost_beyond
from samplekit._stability.verdict import MEANINGS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from samplekit._stability.sweep import Cell, Stability

SCHEMA = "samplekit.stability/1"
_NUMBERS = (
    "exact",
    "reference_error",
    "estimate",
    "error",
    "standard_error",
    "standard_errors",
    "digits_right",
    "digits_lost",
    "arithmetic_error",
    "sampling_error",
    "hits",
    "invalid",
    "samples",
)


def as_record(cell: Cell) -> dict[str, Any]:
    """Return a cell as plain data for JSON; numbers that are not finite are None."""
    record: dict[str, Any] = {
        "scene": _scene_text(cell.name, cell.extreme),
        "sampler": cell.sampler,
        "count": cell.count,
        "verdict": cell.verdict.kind,
        "reason": cell.verdict.reason,
        "measured_twice": cell.repeated,
    }
    measured = cell.measured
    for name in _NUMBERS:
        number = getattr(measured, name) if measured else None
        record[name] = number if number is not None and math.isfinite(number) else None
    return record


def _scene_text(name: str, extreme: str) -> str:
    return f"{name}:{extreme}" if extreme else name


def as_json(sweep: Stability) -> dict[str, Any]:
    """Return a sweep as plain data for JSON."""
    cells, lost = sweep.cells, precision_lost_beyond(sweep.cells)
    return {
        "schema": SCHEMA,
        "realizations": sweep.realizations,
        "seed": sweep.seed,
        "verdicts": _tally(cells),
        "precision_lost_beyond": [
            {"scene": _scene_text(name, extreme), "sampler": sampler, "count": count}
            for (name, extreme, sampler), count in lost.items()
        ],
        "cells": [as_record(cell) for cell in cells],
        "files": [str(file) for file in sweep.files],
    }


def _tally(cells: Sequence[Cell]) -> dict[str, int]:
    """Count the cells of each kind."""
    return {kind: sum(cell.verdict.kind == kind for cell in cells) for kind in MEANINGS}


def table(cells: Sequence[Cell]) -> Iterator[str]:
    """Yield lines of text: a block for each scene and sampler, a row for each extreme, a column for each count."""
    counts = sorted({cell.count for cell in cells})
    lost = precision_lost_beyond(cells)
    for name in dict.fromkeys(cell.name for cell in cells):
        of_scene = [cell for cell in cells if cell.name == name]
        for sampler in dict.fromkeys(cell.sampler for cell in of_scene):
            rows = [cell for cell in of_scene if cell.sampler == sampler]
            width = max(len(cell.extreme) for cell in rows)
            yield f"{name}, {sampler}".ljust(width + 2) + "".join(f"{count:>18}" for count in counts)
            for extreme in dict.fromkeys(cell.extreme for cell in rows):
                row = [cell for cell in rows if cell.extreme == extreme]
                beyond = lost.get((name, extreme, sampler))
                note = "" if beyond is None else f"  precision lost beyond {beyond}" if beyond else "  precision lost"
                yield f"  {extreme:<{width}}" + "".join(f"{_words(cell):>18}" for cell in row) + note
            yield ""
    tally = ", ".join(f"{number} {kind}" for kind, number in _tally(cells).items() if number)
    yield f"{len(cells)} cells: {tally}"
    for kind, meaning in MEANINGS.items():
        if kind != "right" and any(cell.verdict.kind == kind for cell in cells):
            yield f"  {kind}: {meaning}"
    for cell in cells:
        if cell.verdict.kind == "wrong":
            yield f"wrong: {cell.name}:{cell.extreme}, {cell.sampler}, {cell.count}: {cell.verdict.reason}"


def _words(cell: Cell) -> str:
    if cell.verdict.kind == "right" and cell.measured:
        return f"{cell.measured.digits_right:.1f} digits"
    return cell.verdict.kind


def csv_lines(cells: Sequence[Cell]) -> Iterator[str]:
    """Yield the cells as CSV: a header, then a line for each cell, numbers with all their digits."""
    import csv
    import io

    names = list(as_record(cells[0])) if cells else []
    for record in [dict(zip(names, names, strict=True)), *map(as_record, cells)]:
        line = io.StringIO()
        csv.writer(line, lineterminator="\n").writerow(["" if value is None else value for value in record.values()])
        yield line.getvalue()


def write(folder: Path, sweep: Stability) -> list[Path]:
    """Write the cells as CSV and a heat map for each scene, all files or none.

    Parameters
    ----------
    folder, sweep
        An existing folder, and what is written there.

    Returns
    -------
    The paths of the files.

    Raises
    ------
    UsageError
        The folder cannot be written to.
    SamplekitError
        A file cannot be written.
    """
    from samplekit._provenance import versions
    from samplekit.files import text_writer, write_group
    from samplekit.plots import figure_writer

    cells, realizations, seed = sweep.cells, sweep.realizations, sweep.seed
    metadata = {"schema": SCHEMA, "realizations": realizations, "seed": str(seed), "versions": versions()}
    items = [(folder / "stability.csv", text_writer(list(csv_lines(cells))))]
    for name in dict.fromkeys(cell.name for cell in cells):
        facts = {**metadata, "scene": name, "cells": [as_record(cell) for cell in cells if cell.name == name]}
        items.append((folder / f"{name.replace('/', '-')}.png", figure_writer(sweep.plot(name).figure_, ".png", facts)))
    write_group(items)
    return [path for path, _ in items]
