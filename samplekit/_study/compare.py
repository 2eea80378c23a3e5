"""``samplekit.compare``: a study in one call."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from samplekit._study.options import ExecutionOptions
from samplekit._study.request import Request, checked_request
from samplekit._study.study import Study
from samplekit._study.subjects import Subjects

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from samplekit._study.results import Results

TRIALS = 32
SIZE = (128, 128)


def compare(
    samplers: str | Sequence[str],
    scenes: str | Sequence[str],
    spp: int | Sequence[int],
    *,
    trials: int = TRIALS,
    size: tuple[int, int] = SIZE,
    seed: int = 0,
    threads: int | None = None,
    processes: int = 1,
    dask: str | None = None,
    times: bool = True,
    budget: float | None = None,
    cost: float = 0.0,
    target: float | None = None,
    fit: tuple[int, int] | None = None,
    output: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: Callable[[str, int, int], None] = lambda _, __, ___: None,
) -> Results:
    """Compare samplers: error against samples and against run time, with intervals over independent trials.

    Parameters
    ----------
    samplers, scenes
        As on the command line; one or several of each. Over the unit square, samplers that reuse sets make every
        realisation afresh, which their rows say: ``ccvt:bank=0``.
    spp
        Samples of a pixel. A count that a sampler cannot make is replaced by the nearest below, which the row says.
    trials
        Independent realisations; with one there are no intervals.
    size
        (width, height) in pixels; (1, 1): the unit square as one pixel.
    seed
        From 0 to 2^64 - 1.
    threads, processes
        How many of them share the work; errors do not depend on it. None: as many threads as there are processors.
        Times are always those of one thread. Processes begin by importing the calling script: it needs the usual
        guard, ``if __name__ == "__main__":``.
    dask
        Address of a Dask scheduler whose workers compute the errors.
    times, budget
        Measure run times, for so many seconds; None: a tenth of what the errors take, and at least one.
    cost
        Extra cost per sample, in nanoseconds, as if a renderer shaded it.
    target
        Target mean squared error for the time-to-target table; None: one for each scene that all samplers reach.
    fit
        First and last count that slopes are fitted to; None: all.
    output
        A folder for all files of the study; None: no files.
    resume
        Go on with the study in the folder.
    progress
        Called with what is being done, how much of it is, and how much there is.

    Returns
    -------
    Results

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        A plugin failed, or a file cannot be written. What was done is in the folder.
    InterruptedStudy
        The user interrupted the study; the exception carries the results of what was done.

    Examples
    --------
    >>> import samplekit
    >>> found = samplekit.compare(["random", "jittered"], "disk", [16, 64, 256], trials=200, size=(1, 1), times=False)
    >>> slopes = {fit.sampler: fit.slope.estimate for fit in found.fits}
    >>> slopes["jittered"] < -1.3 < slopes["random"] < -0.8
    True
    """
    subjects = Subjects()
    request = _request(subjects, samplers, scenes, spp, trials, size, seed)
    options = ExecutionOptions(threads, processes, dask, times, budget, cost, target, fit)
    folder = None if output is None else Path(output)
    with Study(request, options, subjects, folder, resume=resume) as study:
        interrupted = False
        try:
            study.run(progress)
        except KeyboardInterrupt:
            interrupted = True
        results = study.results()
        if folder is not None:
            from samplekit._study.outputs import write_outputs

            results = write_outputs(
                results, request, subjects, folder, threads, lambda done, total: progress("writing images", done, total)
            )
    if interrupted:
        raise InterruptedStudy(results)
    return results


class InterruptedStudy(KeyboardInterrupt):
    """The user interrupted a study.

    Attributes
    ----------
    results
        The results of what was done.

    Examples
    --------
    >>> import samplekit
    >>> issubclass(samplekit.InterruptedStudy, KeyboardInterrupt)
    True
    """

    def __init__(self, results: Results) -> None:
        super().__init__()
        self.results = results


def _request(
    subjects: Subjects,
    samplers: str | Sequence[str],
    scenes: str | Sequence[str],
    spp: int | Sequence[int],
    trials: int,
    size: tuple[int, int],
    seed: int,
) -> Request:
    """The request with names as their declarations write them."""
    sampler_names = [samplers] if isinstance(samplers, str) else list(samplers)
    scene_names = [scenes] if isinstance(scenes, str) else list(scenes)
    return checked_request(
        [subjects.scene(name).text for name in scene_names],
        [subjects.studied(name, size).text for name in sampler_names],
        [spp] if isinstance(spp, int) else list(spp),
        trials,
        size,
        seed,
    )
