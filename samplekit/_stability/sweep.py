"""``samplekit.stability``: sweep scenes from mild to stiff, and judge every estimate."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from samplekit._arguments import LARGEST_SEED
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import scene as configured_scene
from samplekit._errors import UsageError
from samplekit._registry import registry
from samplekit._stability.measurement import Measurement, measure
from samplekit._stability.results import Cell, Stability, scene_text
from samplekit._stability.verdict import (
    CONFIRMING_BOUND,
    CONFIRMING_REALIZATIONS,
    Verdict,
    chance_bound,
    judge,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit._bases.reference import Reference
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene

SAMPLERS = ("random", "jittered", "correlated-multi-jittered", "halton+owen", "sobol+owen")
COUNTS = (2**4, 2**8, 2**12, 2**16)
REALIZATIONS = 32


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
        Number of independent estimates of each cell. A cell whose error chance does not explain is measured again, with
        another seed and at least 256 of them.
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
    chosen = scenes_of(scenes)
    configured = [configured_sampler(text) for text in dict.fromkeys(samplers)]
    total, done = len(chosen) * len(configured) * sum(counts) * realizations, 0
    cells = []
    edges = np.array([0.0, 1.0])
    for name, extreme in chosen:
        scene = configured_scene(scene_text(name, extreme))
        reference = scene.reference(edges, edges)
        for sampler in configured:
            for count in counts:
                outcome = measure_and_judge(scene, sampler, count, realizations, seed, reference)
                cells.append(Cell(name, extreme, sampler.text, count, *outcome))
                done += count * realizations
                progress(done, total)
    swept = Stability(cells, realizations, seed)
    return swept if output is None else swept.save(output)


def measure_and_judge(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    realizations: int,
    seed: int,
    reference: Reference,
) -> tuple[Measurement | None, Verdict, bool]:
    """Return the measurement and the verdict, and whether chance did not explain a first one and this is a second."""
    bound, repeated = chance_bound(realizations), False
    while True:
        try:
            measured = measure(scene, sampler, count, realizations=realizations, seed=seed, reference=reference)
        except UsageError as error:
            return None, Verdict("refused", str(error)), False
        verdict = judge(measured, finite_variance=scene.finite_variance, bound=bound)
        if repeated or verdict.kind not in ("wrong", "few hits", "no hits") or measured.hits == 0.0:
            return measured, verdict, repeated
        # Another seed must confirm it, and enough realisations to see rare events, and not to be equal by chance.
        seed, realizations = seed ^ (LARGEST_SEED >> 1), max(realizations, CONFIRMING_REALIZATIONS)
        bound, repeated = CONFIRMING_BOUND, True
