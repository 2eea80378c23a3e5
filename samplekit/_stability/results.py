"""The results of a sweep: what ``samplekit.stability`` returns, as a table, as JSON, as heat maps and as files."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from samplekit._stability.verdict import MEANINGS, Verdict

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from samplekit._stability.measurement import Measurement
    from samplekit.plots import StabilityDisplay

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
    "realizations",
    "effective_realizations",
    "invalid",
    "samples",
)
"""Attributes of a measurement that JSON and CSV have."""


@dataclass(frozen=True)
class Cell:
    """A scene, a sampler and a count, with their measurement and verdict.

    Attributes
    ----------
    name, extreme
        Name and options of the scene, such as ``gaussian`` and ``sigma=1e-12``.
    sampler, count
        Text of the sampler, and the number of samples of an estimate.
    measured
        The measurement; None if the sampler cannot make such sets.
    verdict
        The kind of the cell, and the reason.
    repeated
        Whether chance did not explain the error of a first measurement, and this is a second one with another seed and
        at least 256 realisations.
    """

    name: str
    extreme: str
    sampler: str
    count: int
    measured: Measurement | None
    verdict: Verdict
    repeated: bool = False

    def as_json(self) -> dict[str, Any]:
        """Return the cell as plain data for JSON; numbers that are not finite are None."""
        record: dict[str, Any] = {
            "scene": scene_text(self.name, self.extreme),
            "sampler": self.sampler,
            "count": self.count,
            "verdict": self.verdict.kind,
            "reason": self.verdict.reason,
            "measured_twice": self.repeated,
        }
        for name in _NUMBERS:
            number = getattr(self.measured, name) if self.measured else None
            record[name] = number if number is not None and math.isfinite(number) else None
        return record


def scene_text(name: str, extreme: str) -> str:
    """Return a scene as on the command line."""
    return f"{name}:{extreme}" if extreme else name


@dataclass(frozen=True)
class Stability:
    """A sweep of scenes from mild to stiff.

    Attributes
    ----------
    cells
        A :class:`Cell` for each scene, sampler and count.
    realizations, seed
        Number of independent estimates of each cell, and their seed.
    files
        Paths of the files that were written.

    Examples
    --------
    >>> import samplekit
    >>> sweep = samplekit.stability("disk:radius=0.3", "jittered", [16, 64])
    >>> [cell.verdict.kind for cell in sweep.cells]
    ['right', 'right']
    """

    cells: list[Cell]
    realizations: int
    seed: int
    files: tuple[Path, ...] = ()

    @property
    def wrong(self) -> list[Cell]:
        """The cells whose estimates are wrong without an explanation."""
        return [cell for cell in self.cells if cell.verdict.kind == "wrong"]

    def _tally(self) -> dict[str, int]:
        """Count the cells of each kind."""
        return {kind: sum(cell.verdict.kind == kind for cell in self.cells) for kind in MEANINGS}

    def as_json(self) -> dict[str, Any]:
        """Return the object that ``samplekit stability --json`` prints."""
        return {
            "schema": SCHEMA,
            "realizations": self.realizations,
            "seed": self.seed,
            "verdicts": self._tally(),
            "precision_lost_beyond": [
                {"scene": scene_text(name, extreme), "sampler": sampler, "count": count}
                for (name, extreme, sampler), count in precision_lost_beyond(self.cells).items()
            ],
            "cells": [cell.as_json() for cell in self.cells],
            "files": [str(file) for file in self.files],
        }

    def table(self) -> list[str]:
        """Return the lines of text that ``samplekit stability`` prints.

        There is a block for each scene and sampler, with a row for each extreme and a column for each count.
        """
        lines: list[str] = []
        counts = sorted({cell.count for cell in self.cells})
        lost = precision_lost_beyond(self.cells)
        for name, sampler in dict.fromkeys((cell.name, cell.sampler) for cell in self.cells):
            block = [cell for cell in self.cells if (cell.name, cell.sampler) == (name, sampler)]
            width = max(len(cell.extreme) for cell in block)
            lines.append(f"{name}, {sampler}".ljust(width + 2) + "".join(f"{count:>18}" for count in counts))
            for extreme in dict.fromkeys(cell.extreme for cell in block):
                words = "".join(f"{_words(cell):>18}" for cell in block if cell.extreme == extreme)
                beyond = lost.get((name, extreme, sampler))
                note = "" if beyond is None else f"  precision lost beyond {beyond}" if beyond else "  precision lost"
                lines.append(f"  {extreme:<{width}}{words}{note}")
            lines.append("")
        tally = {kind: number for kind, number in self._tally().items() if number}
        words = ", ".join(f"{number} {kind}" for kind, number in tally.items())
        lines.append(f"{len(self.cells)} cell{'' if len(self.cells) == 1 else 's'}: {words}")
        lines += [f"  {kind}: {meaning}" for kind, meaning in MEANINGS.items() if kind != "right" and kind in tally]
        lines += [
            f"wrong: {scene_text(cell.name, cell.extreme)}, {cell.sampler}, {cell.count}: {cell.verdict.reason}"
            for cell in self.wrong
        ]
        return lines

    def plot(self, scene: str | None = None, *, axes: Any = None) -> StabilityDisplay:
        """Draw the correct digits, and the digits that summation lost, as heat maps.

        Parameters
        ----------
        scene
            Name of the scene; None: the only one.
        axes
            The axes of matplotlib to draw on: two for each sampler, the upper row first; None: a new figure.

        Returns
        -------
        samplekit.plots.StabilityDisplay

        Raises
        ------
        UsageError
            The scene is not in the sweep, or none is given and there are several; the number of axes is wrong.
        """
        from samplekit.plots import StabilityDisplay

        return StabilityDisplay(self, scene).plot(axes)

    def save(self, folder: str | os.PathLike[str]) -> Stability:
        """Write ``stability.csv`` and a heat map for each scene, all of them or none.

        Parameters
        ----------
        folder
            An existing folder.

        Returns
        -------
        The sweep with its ``files``.

        Raises
        ------
        UsageError
            The folder cannot be written to.
        SamplekitError
            A file cannot be written.
        """
        from samplekit._provenance import versions
        from samplekit._report.results_csv import records_text
        from samplekit.files import text_writer, write_group
        from samplekit.plots import figure_writer

        folder = Path(folder)
        metadata = {
            "schema": SCHEMA,
            "realizations": self.realizations,
            "seed": str(self.seed),
            "versions": versions(),
        }
        records = [cell.as_json() for cell in self.cells]
        items = [(folder / "stability.csv", text_writer([records_text(records)]))]
        for name in dict.fromkeys(cell.name for cell in self.cells):
            own = [record for cell, record in zip(self.cells, records, strict=True) if cell.name == name]
            writer = figure_writer(self.plot(name).figure_, ".png", {**metadata, "scene": name, "cells": own})
            items.append((folder / f"{name.replace('/', '-')}.png", writer))
        write_group(items)
        return replace(self, files=tuple(path for path, _ in items))


def _words(cell: Cell) -> str:
    if cell.verdict.kind == "right" and cell.measured:
        return f"{cell.measured.digits_right:.1f} digits"
    return cell.verdict.kind


def precision_lost_beyond(cells: Sequence[Cell]) -> dict[tuple[str, str, str], int]:
    """Return the largest count before rounding exceeds the error of sampling.

    Parameters
    ----------
    cells
        The cells of a sweep.

    Returns
    -------
    The count for each (name, extreme, sampler) that loses precision; 0 if all of its counts lose it.
    """
    rows: dict[tuple[str, str, str], list[Cell]] = {}
    for cell in cells:
        rows.setdefault((cell.name, cell.extreme, cell.sampler), []).append(cell)
    beyond = {}
    for row, of_row in rows.items():
        lost = [cell.count for cell in of_row if cell.verdict.kind == "precision lost"]
        if lost:
            beyond[row] = max((cell.count for cell in of_row if cell.count < min(lost)), default=0)
    return beyond
