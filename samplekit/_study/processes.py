"""Carry out jobs in several processes of this machine."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import TYPE_CHECKING

from samplekit._errors import SamplekitError
from samplekit._study.trials import Array, carry_out
from samplekit._threads import as_completed

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable, Sequence

    from samplekit._study.jobs import Job

    JobResults = Generator[tuple[Job, Array], None, None]


def in_processes(parts: Iterable[Sequence[Job]], processes: int, tick: Callable[[int], None]) -> JobResults:
    """Carry out jobs in other processes, and yield each with its sums in the order in which they end.

    Parameters
    ----------
    parts, processes
        The jobs to carry out, part after part, and the number of processes.
    tick
        Called with the number of samples of each job that ends.

    Raises
    ------
    SamplekitError
        A process was ended from outside.
    """
    # A fork of a process that has written images hangs.
    pool = ProcessPoolExecutor(processes, multiprocessing.get_context("spawn"), _begin_worker)
    try:
        for jobs in parts:
            for job, sums in as_completed(jobs, processes, lambda job: pool.submit(carry_out, job)):
                tick(job.samples)
                yield job, sums
    except BrokenProcessPool:
        raise SamplekitError(
            "a worker process was ended from outside (out of memory?): with --output, --resume continues from there"
        ) from None
    finally:
        # The pool has no public way to end a worker in the middle of a job.
        children = list((getattr(pool, "_processes", None) or {}).values())
        pool.shutdown(wait=False, cancel_futures=True)
        for child in children:
            child.terminate()
            child.join()


def _begin_worker() -> None:
    # The terminal interrupts all processes at once. Workers ignore that: the process that started them ends them.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # A worker would wait for jobs for ever if the process that hands them out is killed.
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
