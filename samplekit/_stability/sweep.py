"""``samplekit.stability``: sweep scenes from mild to stiff, and judge every estimate."""

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
from samplekit._stability.measurement import Measurement, measure
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
        Whether a first measurement was beyond 4 standard errors, and this is a second one with another seed.
    """

    name: str
    extreme: str
    sampler: str
    count: int
    measured: Measurement | None
    verdict: Verdict
    repeated: bool = False


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

    def as_json(self) -> dict[str, Any]:
        """Return the object that ``samplekit stability --json`` prints."""
        from samplekit._stability.outputs import as_json

        return as_json(self)

    def table(self) -> list[str]:
        """Return the lines of text that ``samplekit stability`` prints."""
        from samplekit._stability.outputs import table

        return list(table(self.cells))

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
        from samplekit._stability.outputs import write

        return replace(self, files=tuple(write(Path(folder), self)))


def scenes_of(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Return name and options of every scene of a sweep, each once.

    Parameters
    ----------
    texts
        Scenes as on the command line; a name alone stands for all the extremes that the scene declares. Empty: all
        scenes that need no option.
    """
    scenes = registry().all("scene")
    chosen: list[tuple[str, str]] = []
    for text in texts or [name for name, offer in scenes.items() if not any(o.required for o in offer.spec.options)]:
        name, _, options = text.partition(":")
        extremes = registry().find("scene", name).spec.extremes
        chosen += [(name, options)] if options or not extremes else [(name, extreme) for extreme in extremes]
    return list(dict.fromkeys(chosen))


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

    Each cell compares estimates of the mean over the unit square with the exact mean, in units of their own standard
    error, and with the same estimates in extended precision.

    Parameters
    ----------
    scenes
        Texts as on the command line; a name alone stands for all the extremes that the scene declares. By default all
        scenes that need no option.
    samplers, counts
        Samplers as on the command line, and the numbers of samples of an estimate.
    realizations
        Number of independent estimates of each cell.
    seed
        From 0 to 2^64 - 1.
    output
        An existing folder for a table and heat maps; None: no files.
    progress
        Called with the numbers of samples done and to do.

    Returns
    -------
    Stability

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
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> list[Cell]:
    """Measure and judge every cell, with the parameters of :func:`stability`; ``scenes`` is from :func:`scenes_of`."""
    configured = [configured_sampler(text) for text in samplers]
    total, done = len(scenes) * len(samplers) * sum(counts) * realizations, 0
    cells = []
    edges = np.array([0.0, 1.0])
    for name, extreme in scenes:
        scene = configured_scene(f"{name}:{extreme}" if extreme else name)
        reference = scene.reference(edges, edges)
        for sampler in configured:
            for count in counts:
                outcome = _measure_and_judge(scene, sampler, count, realizations, seed, reference)
                cells.append(Cell(name, extreme, sampler.text, count, *outcome))
                done += count * realizations
                progress(done, total)
    return cells


def _measure_and_judge(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    realizations: int,
    seed: int,
    reference: Reference,
) -> tuple[Measurement | None, Verdict, bool]:
    """Return the measurement and the verdict, and whether a first verdict was ``wrong`` and this is a second one."""

    def judged(seed: int) -> tuple[Measurement, Verdict]:
        measured = measure(scene, sampler, count, realizations=realizations, seed=seed, reference=reference)
        return measured, judge(measured, randomized=sampler.spec.randomized, finite_variance=scene.finite_variance)

    try:
        measured, verdict = judged(seed)
        repeated = verdict.kind == "wrong"
        if repeated:
            measured, verdict = judged(seed ^ (LARGEST_SEED >> 1))
    except UsageError as error:
        return None, Verdict("refused", str(error)), False
    return measured, verdict, repeated


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
