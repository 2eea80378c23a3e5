"""The sweep: scenes from mild to stiff, samplers, counts; a verdict on each."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._checks import LARGEST_SEED
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import scene as configured_scene
from samplekit._errors import UsageError
from samplekit._registry import registry
from samplekit._stability.cell import Measured, measure
from samplekit._stability.verdict import Verdict, judge

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit._bases.reference import Reference
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene
    from samplekit.plots import StabilityDisplay

SAMPLERS = ("random", "jittered", "correlated-multi-jittered", "halton+owen", "sobol+owen")
COUNTS = (2**4, 2**8, 2**12, 2**16)
REALIZATIONS = 32


@dataclass(frozen=True)
class Cell:
    """A scene, a sampler and a count; what was measured, None where that was refused; and the verdict.

    ``name`` and ``extreme`` are the scene's parts: ``gaussian`` and ``sigma=1e-12``. ``repeated``: a first measurement
    was beyond 4 standard errors, and this is the second.
    """

    name: str
    extreme: str
    sampler: str
    count: int
    measured: Measured | None
    verdict: Verdict
    repeated: bool = False


def scenes_of(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Name and options of every scene of a sweep: of a name alone all the extremes that it declares.

    Without any: all scenes that need no option.
    """
    chosen: list[tuple[str, str]] = []
    for text in texts or [
        name for name, offer in registry().all("scene").items() if not any(o.required for o in offer.spec.options)
    ]:
        name, _, options = text.partition(":")
        extremes = registry().find("scene", name).spec.extremes
        chosen += [(name, options)] if options or not extremes else [(name, extreme) for extreme in extremes]
    return list(dict.fromkeys(chosen))


@dataclass(frozen=True)
class Stability:
    """A sweep of scenes from mild to stiff.

    Attributes
    ----------
    cells
        A cell for each scene, sampler and count.
    realizations, seed
        Independent estimates of each cell, and their seed.
    files
        The files that were written.

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
        """The cells whose estimates are wrong, with nothing that explains it."""
        return [cell for cell in self.cells if cell.verdict.kind == "wrong"]

    def as_json(self) -> dict[str, Any]:
        """Return what ``samplekit stability --json`` prints."""
        from samplekit._stability.report import as_json

        return as_json(self)

    def table(self) -> list[str]:
        """Return the lines of text that ``samplekit stability`` prints."""
        from samplekit._stability.report import table

        return list(table(self.cells))

    def plot(self, scene: str | None = None, *, axes: Any = None) -> StabilityDisplay:
        """Draw the digits that are right, and those that summation lost, as heat maps.

        Parameters
        ----------
        scene
            Name of the scene; None: the only one.
        axes
            The axes of matplotlib to draw on: two for each sampler, the upper row first. None: a new figure.

        Returns
        -------
        samplekit.plots.StabilityDisplay

        Raises
        ------
        UsageError
            A scene that is not in the sweep, or none where there are several; another number of axes.
        """
        from samplekit.plots import StabilityDisplay

        return StabilityDisplay(self, scene).plot(axes)

    def save(self, folder: str | os.PathLike[str]) -> Stability:
        """Write stability.csv and a heat map for each scene, all of them or none; return the sweep with its ``files``.

        Raises
        ------
        UsageError
            The folder cannot be written to.
        SamplekitError
            A file cannot be written.
        """
        from samplekit._stability.report import write

        return replace(self, files=tuple(write(Path(folder), self)))


def stability(
    scenes: str | Sequence[str] = (),
    samplers: str | Sequence[str] = SAMPLERS,
    counts: Sequence[int] = COUNTS,
    *,
    realizations: int = REALIZATIONS,
    seed: int = 0,
    output: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> Stability:
    """Sweep scenes from mild to stiff, and judge every estimate.

    Each cell compares estimates over the unit square with the exact mean, in units of their own standard error, and
    with a run in extended precision from the same points.

    Parameters
    ----------
    scenes
        As on the command line; a name alone stands for all the extremes that the scene declares. By default all scenes
        that need no option.
    samplers, counts
        The samplers, and the numbers of samples of an estimate.
    realizations
        Independent estimates of each cell.
    seed
        From 0 to 2^64 - 1.
    output
        A folder for a table and heat maps; None: no files.
    progress
        Called with the numbers of samples done and to do.

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        A plugin failed, or a file cannot be written.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.stability("disk:radius=0.3", "jittered", [16]).wrong
    []
    """
    if output is not None and not Path(output).is_dir():
        raise UsageError(f"--output {os.fspath(output)}: there is no such folder")
    scenes, samplers = ([each] if isinstance(each, str) else each for each in (scenes, samplers))
    cells = sweep(
        scenes_of(list(dict.fromkeys(scenes))),
        list(dict.fromkeys(samplers)),
        counts,
        realizations=realizations,
        seed=seed,
        progress=progress,
    )
    swept = Stability(cells, realizations, seed)
    return swept if output is None else swept.save(output)


def sweep(
    scenes: Sequence[tuple[str, str]],
    samplers: Sequence[str],
    counts: Sequence[int],
    *,
    realizations: int = REALIZATIONS,
    seed: int = 0,
    show: Callable[[Cell], None] = lambda _: None,
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> list[Cell]:
    """Measure and judge every cell.

    Parameters
    ----------
    scenes
        From :func:`scenes_of`.
    samplers, counts
        What is swept.
    realizations
        Independent estimates of each cell.
    seed
        From 0 to 2^64 - 1.
    show
        Called with each cell when it is done.
    progress
        Called with the numbers of samples done and to do.
    """
    configured = [configured_sampler(text) for text in samplers]
    total, done = len(scenes) * len(samplers) * sum(counts) * realizations, 0
    cells = []
    edges = np.array([0.0, 1.0])
    for name, extreme in scenes:
        scene = configured_scene(f"{name}:{extreme}" if extreme else name)
        reference = scene.reference(edges, edges)
        for sampler in configured:
            for count in counts:
                cell = _cell(scene, sampler, count, realizations, seed, reference)
                cells.append(replace(cell, name=name, extreme=extreme))
                show(cells[-1])
                done += count * realizations
                progress(done, total)
    return cells


def _cell(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    realizations: int,
    seed: int,
    reference: Reference,
) -> Cell:
    def judged(at: int) -> tuple[Measured, Verdict]:
        measured = measure(scene, sampler, count, realizations=realizations, seed=at, reference=reference)
        return measured, judge(measured, randomized=sampler.spec.randomized, finite_variance=scene.finite_variance)

    try:
        measured, verdict = judged(seed)
        repeated = verdict.kind == "wrong"
        if repeated:
            measured, verdict = judged(seed ^ (LARGEST_SEED >> 1))
    except UsageError as error:
        return Cell("", "", sampler.text, count, None, Verdict("refused", str(error)))
    return Cell("", "", sampler.text, count, measured, verdict, repeated)


def precision_lost_beyond(cells: Sequence[Cell]) -> dict[tuple[str, str, str], int]:
    """The largest count before rounding exceeds the error of sampling, by name, extreme and sampler; 0: none is."""
    rows: dict[tuple[str, str, str], list[Cell]] = {}
    for cell in cells:
        rows.setdefault((cell.name, cell.extreme, cell.sampler), []).append(cell)
    beyond = {}
    for row, of_row in rows.items():
        lost = [cell.count for cell in of_row if cell.verdict.kind == "precision lost"]
        if lost:
            beyond[row] = max((cell.count for cell in of_row if cell.count < min(lost)), default=0)
    return beyond
