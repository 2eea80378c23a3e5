"""A study from its request to its results: setting up, laps, jobs, more laps, answers."""

from __future__ import annotations

import contextlib
import threading
import time
from dataclasses import replace
from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit._memory import check_memory
from samplekit._study import ranking
from samplekit._study.cells import lay_out
from samplekit._study.cluster import Cluster
from samplekit._study.crossings import crossings
from samplekit._study.folder import check_folder
from samplekit._study.jobs import gaps, split
from samplekit._study.laps import LAP_SECONDS, LOOK_SECONDS, TimingRun, run_laps
from samplekit._study.machine import describe_machine, kind, known_versions
from samplekit._study.processes import in_processes
from samplekit._study.results import Results
from samplekit._study.rows import Analysis
from samplekit._study.sentences import statements
from samplekit._study.setup import set_up
from samplekit._study.store import Store
from samplekit._study.trials import carry_out
from samplekit._threads import check_threads, on_threads

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from samplekit._study.cells import Cell
    from samplekit._study.options import ExecutionOptions
    from samplekit._study.request import Request
    from samplekit._study.subjects import Subjects

    Progress = Callable[[str, int, int], None]

_SHARE, _LEAST = 0.1, 1.0
"""Of the time that errors take, for laps, and seconds in any case, unless a budget is given."""


class Study:
    """A study under way: :meth:`run` goes as far as it is let, :meth:`results` tells what is there.

    Raises
    ------
    UsageError
        The request or the folder is not right.
    """

    def __init__(
        self,
        request: Request,
        options: ExecutionOptions,
        subjects: Subjects,
        folder: Path | None = None,
        *,
        resume: bool = False,
    ) -> None:
        options.check()
        if resume and folder is None:
            raise UsageError("--resume needs --output, the folder of the study")
        self._request, self._options, self._subjects = request, options, subjects
        self._cells, self._left_out = lay_out(request, subjects)
        self._machine, self._versions = describe_machine(), known_versions()
        if folder is not None:
            check_folder(folder, resume=resume)
        self._store = Store(folder)
        self._cluster: Cluster | None = None
        try:
            self._store.begin(request.plain(), self._versions)
            self._cluster = Cluster(options.dask) if options.dask is not None else None
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Study:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the folder and of the cluster."""
        self._store.close()
        if self._cluster is not None:
            self._cluster.close()

    def run(self, progress: Progress = lambda _, __, ___: None) -> None:
        """Do what is left to do. An interrupt leaves all that was finished.

        Raises
        ------
        SamplekitError
            A plugin failed, or the store cannot be written.
        """
        self._set_up(progress)
        timings = [TimingRun(cell, self._request, self._subjects) for cell in self._cells]
        seconds = {}
        for number, timing in enumerate(timings):
            seconds[timing.cell] = timing.warm_up(LAP_SECONDS if self._options.times else LOOK_SECONDS)
            progress("warming up", number + 1, len(timings))
        if self._options.times:
            self._laps(timings, 0.0, progress)
        began = time.perf_counter()
        self._errors(seconds, progress)
        if self._options.times:
            share = max(_SHARE * (time.perf_counter() - began), _LEAST)
            self._laps(timings, share if self._options.budget is None else self._options.budget, progress)

    def _set_up(self, progress: Progress) -> None:
        machine = kind(self._machine)
        for cell in self._cells:
            cpu, wall = set_up(cell, self._subjects, lambda done, total: progress("preparing point sets", done, total))
            if self._options.times:
                self._store.add_setup(machine, cell, cpu, wall)

    def _laps(self, timings: list[TimingRun], seconds: float, progress: Progress) -> None:
        machine = kind(self._machine)
        run_laps(
            timings,
            seconds,
            lambda cell: self._store.laps(machine, cell)[:, [0, 2]].sum(axis=1),
            lambda laps: self._store.add_laps(machine, laps),
            lambda done, total: progress("measuring run times", done, total),
        )

    def _errors(self, seconds: dict[Cell, float], progress: Progress) -> None:
        workers = self._options.processes
        if self._cluster is not None:
            workers = self._cluster.threads
        elif workers == 1:
            workers = check_threads(self._options.threads)
        jobs = split(
            self._request, self._cells, lambda cell: gaps(self._store.ranges(cell), cell.trials), seconds, workers
        )
        if self._cluster is None and jobs:
            needed = workers * max(job.memory for job in jobs)
            check_memory(needed, f"images on {workers} threads or processes", ": ask for fewer with --threads")
        total = sum(job.samples for job in jobs)
        done, lock = 0, threading.Lock()

        def tick(samples: int) -> None:
            nonlocal done
            with lock:
                done += samples
                progress("computing errors", min(done, total), total)

        if self._cluster is not None:
            found = self._cluster.run(jobs, tick)
        elif self._options.processes > 1:
            found = in_processes(jobs, workers, tick)
        else:
            found = on_threads(lambda job, tick: carry_out(job, self._subjects, tick), jobs, workers, tick)
        # Closed whatever happens here: it stops the workers.
        with contextlib.closing(found):
            for job, sums in found:
                self._store.add(job, sums)

    def results(self) -> Results:
        """What is there, also after an interrupt."""
        request, options = self._request, self._options
        analysis = Analysis(
            request, self._cells, self._store, self._subjects, kind(self._machine), options.cost, options.fitted
        )
        rows = analysis.rows()
        fits = analysis.fits(rows)
        target = ranking.targets(rows, options.target)
        to_target = ranking.times_to_target(rows, target)
        front, crossed = ranking.front(rows), crossings(rows)
        flips = ranking.flips(rows, to_target, options.cost)
        more = [f"--cost {options.cost:g}"] if options.cost else []
        more += [f"--target {options.target:g}"] if options.target else []
        more += [f"--fit {options.fitted[0]}..{options.fitted[1]}"] if options.fitted else []
        results = Results(
            command=request.command(*more),
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
            target=target,
            complete=analysis.complete,
            rows=rows,
            fits=fits,
            to_target=to_target,
            front=front,
            flips=flips,
            left_out=[*self._left_out, *analysis.left_out],
            notes=self._notes(),
            crossings=crossed,
        )
        return replace(results, sentences=[statement.sentence for statement in statements(results)])

    def _workers(self) -> str:
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
