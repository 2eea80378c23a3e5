"""Jobs on this machine: in this thread, on several, or in several processes; results as they come, in any order."""

from __future__ import annotations

import itertools
import multiprocessing
import os
import signal
import threading
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import TYPE_CHECKING

from samplekit._errors import SamplekitError
from samplekit._study.subjects import Subjects
from samplekit._study.trials import carry_out

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Sequence
    from concurrent.futures import Future

    import numpy as np
    from numpy.typing import NDArray

    from samplekit._study.jobs import Job

    Found = Generator[tuple[Job, NDArray[np.float64]], None, None]

_AHEAD = 2
"""Jobs for each worker that are handed out at a time: none is idle, and an interrupt leaves little behind."""
_AWAKE = 0.5
"""Seconds after which a waiting main thread looks for an interrupt, where the system does not wake it."""


class StoppedError(Exception):
    """The study is ending; what was begun is given up."""


def on_threads(jobs: Sequence[Job], threads: int, subjects: Subjects, tick: Callable[[int], None]) -> Found:
    """Do jobs on threads of this process; ``tick`` takes the numbers of samples done since its last call."""
    stop = threading.Event()

    def tick_or_stop(samples: int) -> None:
        if stop.is_set():
            raise StoppedError
        tick(samples)

    if threads == 1:
        for job in jobs:
            yield job, carry_out(job, subjects, tick)
        return
    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from _as_they_come(jobs, threads, lambda job: pool.submit(carry_out, job, subjects, tick_or_stop))
        finally:
            # An interrupt too must stop what has begun: leaving the pool waits for all of it.
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)


def in_processes(jobs: Sequence[Job], processes: int, tick: Callable[[int], None]) -> Found:
    """Do jobs in other processes.

    Raises
    ------
    SamplekitError
        One of them was ended from outside.
    """
    # A fork of a process that has written images hangs.
    pool = ProcessPoolExecutor(processes, multiprocessing.get_context("spawn"), _begin_worker)
    try:
        for job, sums in _as_they_come(jobs, processes, lambda job: pool.submit(_carry_out_here, job)):
            tick(job.samples)
            yield job, sums
    except BrokenProcessPool:
        raise SamplekitError(
            "a worker process was ended from outside (out of memory?): with --output, --resume goes on from there"
        ) from None
    finally:
        children = _children(pool)
        pool.shutdown(wait=False, cancel_futures=True)
        for child in children:
            child.terminate()
            child.join()


def _children(pool: Executor) -> list[multiprocessing.process.BaseProcess]:
    # The pool has no public way to end a worker in the middle of a job.
    return list((getattr(pool, "_processes", None) or {}).values())


def _as_they_come(jobs: Sequence[Job], workers: int, submit: Callable[[Job], Future[NDArray[np.float64]]]) -> Found:
    waiting = iter(jobs)
    running = {submit(job): job for job in itertools.islice(waiting, _AHEAD * workers)}
    while running:
        done, _ = wait(running, _AWAKE, FIRST_COMPLETED)
        for future in done:
            job = running.pop(future)
            sums = future.result()
            running |= {submit(following): following for following in itertools.islice(waiting, 1)}
            yield job, sums


_subjects = Subjects()
"""Those of a worker process."""


def _begin_worker() -> None:
    # The terminal interrupts all processes at once; the one that began them decides.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # A worker waits for jobs for ever when the process that hands them out is killed.
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _carry_out_here(job: Job) -> NDArray[np.float64]:
    return carry_out(job, _subjects)
