"""A study from its request to its results: set-up, jobs with rounds of laps between them, analysis, answers."""

from __future__ import annotations

import contextlib
import itertools
import time
from dataclasses import asdict, replace
from functools import partial
from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit._memory import check_memory
from samplekit._provenance import versions
from samplekit._study.analysis import Analysis
from samplekit._study.cluster import connect, count_threads, on_cluster
from samplekit._study.combinations import list_combinations
from samplekit._study.folder import check_folder
from samplekit._study.jobs import split
from samplekit._study.machine import describe_machine, kind_of
from samplekit._study.processes import in_processes
from samplekit._study.ranking import rank
from samplekit._study.results import Results
from samplekit._study.sentences import statements
from samplekit._study.store import Store
from samplekit._study.timing import (
    ESTIMATE_SECONDS,
    LAP_SECONDS,
    ROUNDS,
    TimingRun,
    falling,
    run_round,
    set_up,
    typical_seconds,
)
from samplekit._study.trials import carry_out
from samplekit._threads import check_threads, on_threads

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from samplekit._study.combinations import Combination
    from samplekit._study.jobs import Job
    from samplekit._study.processes import JobResults
    from samplekit._study.request import ExecutionOptions, Request
    from samplekit._study.resources import Resources

    Progress = Callable[[str, int, int], None]

_BUDGET_SHARE, _SMALLEST_BUDGET = 0.1, 1.0
"""Default budget for laps: this share of the time that the errors took, and at least so many seconds."""
_JOBS_BETWEEN = 8
"""Least number of jobs for each worker between two pauses: workers wait for each other at a pause."""


class Study:
    """A study in progress: :meth:`run` does the work, :meth:`results` returns what has been found so far.

    Parameters
    ----------
    request, options
        What is asked for, and how it is carried out.
    resources
        The scenes and samplers of the request.
    folder
        Where the store is kept; None: in memory.
    resume
        Whether the study continues the one in the folder.

    Raises
    ------
    UsageError
        The request cannot be carried out, or the study may not write to the folder.
    """

    def __init__(
        self,
        request: Request,
        options: ExecutionOptions,
        resources: Resources,
        folder: Path | None,
        *,
        resume: bool,
    ) -> None:
        if resume and folder is None:
            raise UsageError("--resume needs --output, the folder of the study")
        self._request, self._options, self._resources = request, options, resources
        self._combinations, self._left_out = list_combinations(request, resources)
        self._machine, self._versions = describe_machine(), versions()
        if folder is not None:
            check_folder(folder, resume=resume)
        with contextlib.ExitStack() as stack:
            store = Store(folder, asdict(request), self._versions, kind_of(self._machine))
            self._store = stack.enter_context(contextlib.closing(store))
            self._cluster = None
            if options.dask is not None:
                self._cluster = stack.enter_context(contextlib.closing(connect(options.dask)))
            self._open = stack.pop_all()

    def __enter__(self) -> Study:
        return self

    def __exit__(self, *exception: object) -> None:
        self._open.close()

    def run(self, progress: Progress) -> None:
        """Do what is left to do. After an interrupt the store has everything that was finished.

        Parameters
        ----------
        progress
            Called with what is being done, how much of it is done, and how much there is.

        Raises
        ------
        SamplekitError
            A plugin failed, or the store cannot be written.
        """
        for each in self._combinations:
            cpu, wall = set_up(each, self._resources, lambda done, total: progress("preparing point sets", done, total))
            if self._options.times:
                self._store.add_setup(each, cpu, wall)
        timings = [TimingRun(combination, self._request, self._resources) for combination in self._combinations]
        seconds = {}
        for number, timing in enumerate(timings):
            seconds[timing.combination] = timing.warm_up(LAP_SECONDS if self._options.times else ESTIMATE_SECONDS)
            progress("warming up", number + 1, len(timings))
        numbers = itertools.count(1 + max(int(self._store.laps(each)[:, 0].max(initial=0.0)) for each in seconds))

        def measure(timings: Sequence[TimingRun], rounds: int, spent: float = 0.0) -> None:
            """Run rounds of laps after the errors took so many seconds; some combinations get a part of the budget."""
            budget = self._options.budget
            if budget is None:
                budget = max(_BUDGET_SHARE * spent * ROUNDS / rounds, _SMALLEST_BUDGET)
            share = budget / ROUNDS * len(timings) / len(self._combinations)
            for number in itertools.islice(numbers, rounds):
                run_round(timings, number, share, self._store, partial(progress, "measuring run times"))

        self._compute_errors(seconds, progress, partial(measure, timings))
        if self._options.times:
            found = falling(typical_seconds({each: self._store.laps(each) for each in self._combinations}))
            again = [timing for timing in timings if timing.combination in {*found, *found.values()}]
            if again:
                measure(again, ROUNDS)

    def _compute_errors(
        self, seconds: dict[Combination, float], progress: Progress, measure: Callable[[int, float], None]
    ) -> None:
        """Carry out the jobs that are left.

        Parameters
        ----------
        seconds
            Approximate seconds of a trial of each combination.
        progress
            As in :meth:`run`.
        measure
            Measures run times: called with a number of rounds, and the seconds that the errors took since the last.
        """
        workers = self._options.processes
        if self._cluster is not None:
            workers = count_threads(self._cluster)
        elif workers == 1:
            workers = check_threads(self._options.threads)
        jobs = split(self._request, self._combinations, self._store.ranges, seconds, workers)
        if self._cluster is None and jobs:
            needed = workers * max(job.memory for job in jobs)
            check_memory(needed, f"images on {workers} threads or processes", ": ask for fewer with --threads")
        total = sum(job.samples for job in jobs)
        done = 0

        def tick(samples: int) -> None:
            nonlocal done
            done += samples
            progress("computing errors", min(done, total), total)

        parts = self._parts(jobs, workers, measure)
        if self._cluster is not None:
            found = on_cluster(self._cluster, parts, tick)
        elif self._options.processes > 1:
            found = in_processes(parts, workers, tick)
        else:
            found = self._on_threads(parts, workers, tick)
        # Closing stops the workers, whatever happens here.
        with contextlib.closing(found):
            for job, sums in found:
                self._store.add(job, sums)

    def _parts(
        self, jobs: Sequence[Job], workers: int, measure: Callable[[int, float], None]
    ) -> Iterator[Sequence[Job]]:
        """Yield the jobs in parts, and measure run times before, between and after them, while no worker is busy."""
        if not self._options.times:
            yield jobs
            return
        parts = max(1, min(ROUNDS - 1, len(jobs) // (_JOBS_BETWEEN * workers)))
        spent = 0.0
        for part in range(parts + 1):
            measure(len(range(ROUNDS)[part :: parts + 1]), spent)
            if part < parts:
                began = time.perf_counter()
                yield jobs[len(jobs) * part // parts : len(jobs) * (part + 1) // parts]
                spent = time.perf_counter() - began

    def _on_threads(self, parts: Iterable[Sequence[Job]], threads: int, tick: Callable[[int], None]) -> JobResults:
        for jobs in parts:
            yield from on_threads(lambda job, tick: carry_out(job, self._resources, tick), jobs, threads, tick)

    def results(self) -> Results:
        """Return the results of everything that is done, also after an interrupt."""
        request, options = self._request, self._options
        analysis = Analysis(request, options, self._combinations, self._store, self._resources)
        rows = analysis.rows()
        results = Results(
            command=request.command(*options.command_options()),
            versions=self._versions,
            machine=self._machine,
            scenes=list(request.scenes),
            samplers=list(request.samplers),
            counts=list(request.counts),
            trials=request.trials,
            size=request.size,
            seed=request.seed,
            workers=self._workers(),
            cost=options.cost,
            complete=analysis.complete,
            rows=rows,
            fits=analysis.fits(rows),
            left_out=[*self._left_out, *analysis.left_out],
            notes=self._notes(),
            **rank(rows, options.target, options.cost)._asdict(),
        )
        return replace(results, sentences=[statement.sentence for statement in statements(results)])

    def _workers(self) -> str:
        """Return in words what computes the errors."""
        if self._cluster is not None:
            return f"Dask at {self._options.dask}"
        if self._options.processes > 1:
            return f"{self._options.processes} processes"
        threads = check_threads(self._options.threads)
        return f"{threads} thread{'' if threads == 1 else 's'}"

    def _notes(self) -> list[str]:
        notes = ["Intervals are of 95 %, over independent trials."]
        if self._options.times:
            notes.append("Times are processor seconds of a trial on one thread, set-up apart.")
        if self._cluster is not None:
            notes.append("Errors were computed by the cluster; times were taken where the command ran.")
        return notes
