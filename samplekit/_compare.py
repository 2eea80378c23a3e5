"""``samplekit.compare``: a study in one call."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from samplekit._study.request import UNIT_SQUARE, ExecutionOptions, checked_request
from samplekit._study.resources import Resources
from samplekit._study.study import Study

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from samplekit._study.results import Results


def compare(
    samplers: str | Sequence[str],
    scenes: str | Sequence[str],
    spp: int | Sequence[int],
    *,
    trials: int = 32,
    size: tuple[int, int] = (128, 128),
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
        Texts as on the command line; one or several of each. Over the unit square, samplers that reuse sets make every
        realisation afresh, and their rows say so: ``ccvt:bank=0``.
    spp
        Samples per pixel. A count that a sampler cannot make is replaced by the nearest below, and the row says so.
    trials
        Number of independent realisations; with one there are no intervals.
    size
        (width, height) in pixels; (1, 1): the unit square as one pixel.
    seed
        From 0 to 2^64 - 1.
    threads, processes
        Number of threads or processes that share the work; errors do not depend on it. None: a thread for each
        processor. Times are always those of one thread. Processes begin by importing the calling script, which needs
        the usual guard, ``if __name__ == "__main__":``.
    dask
        Address of a Dask scheduler whose workers compute the errors.
    times, budget
        Whether run times are measured, and for how many seconds of the processor; None: a tenth of the time that the
        errors take, and at least one second. A lap of every row in six or nine rounds is taken in any case.
    cost
        Extra cost per sample, in nanoseconds, as if a renderer shaded it.
    target
        Target mean squared error for the time-to-target table; None: for each scene the smallest that all samplers with
        intervals certainly reach.
    fit
        First and last count that slopes are fitted to; None: all counts.
    output
        A folder for all files of the study; None: no files.
    resume
        Whether to continue the study in the folder.
    progress
        Called with what is being done, how much of it is done, and how much there is.

    Returns
    -------
    Results

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        A plugin failed, or a file cannot be written. The folder keeps what was done.
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
    resources = Resources()
    chosen = [resources.sampler(text) for text in _texts(samplers)]
    if size == UNIT_SQUARE:
        # Here the variance itself is studied: a sampler that reuses sets makes each of them afresh.
        chosen = [sampler.fresh() for sampler in chosen]
    request = checked_request(
        [resources.scene(text).text for text in _texts(scenes)],
        [sampler.text for sampler in chosen],
        [spp] if isinstance(spp, int) else list(spp),
        trials,
        size,
        seed,
    )
    options = ExecutionOptions(threads, processes, dask, times, budget, cost, target, fit)
    folder = None if output is None else Path(output)
    with Study(request, options, resources, folder, resume=resume) as study:
        interrupted = False
        try:
            study.run(progress)
        except KeyboardInterrupt:
            interrupted = True
        results = study.results()
        if folder is not None:
            from samplekit._report.outputs import write_outputs

            results = write_outputs(results, request, resources, folder, threads, partial(progress, "writing images"))
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


def _texts(texts: str | Sequence[str]) -> list[str]:
    return [texts] if isinstance(texts, str) else list(texts)
