"""How many threads work, and how jobs are shared among them."""

from __future__ import annotations

import itertools
import os
import threading
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, TypeVar

from samplekit._arguments import as_integer
from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Sequence
    from concurrent.futures import Future

Job = TypeVar("Job")
Result = TypeVar("Result")

MOST = 1024
_AHEAD = 2
"""Jobs for each worker that are handed out at a time: no worker is idle, and an interrupt leaves little behind."""
_AWAKE = 0.5
"""Seconds after which a waiting main thread looks for an interrupt, where the system does not wake it."""
_requested: ContextVar[int | None] = ContextVar("threads", default=None)


class StoppedError(Exception):
    """The work was given up because another job failed, or the user interrupted it."""


def default_threads() -> int:
    """Return the number of threads that was requested, or else of processors that this process may use."""
    requested = _requested.get()
    if requested is not None:
        return requested
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def check_threads(threads: object) -> int:
    """Return the number of threads as an int; None stands for :func:`default_threads`.

    Raises
    ------
    UsageError
        It is not an integer from 1 to 1024.

    Examples
    --------
    >>> from samplekit import check_threads
    >>> check_threads(2)
    2
    """
    if threads is None:
        return default_threads()
    number = as_integer(threads)
    if number is None or not 1 <= number <= MOST:
        raise UsageError(f"threads {threads}: expected an integer from 1 to {MOST}")
    return number


@contextmanager
def requesting(threads: int) -> Iterator[None]:
    """Let :func:`default_threads` return ``threads`` inside, in this thread."""
    token = _requested.set(threads)
    try:
        yield
    finally:
        _requested.reset(token)


def on_threads(
    work: Callable[[Job, Callable[[int], None]], Result],
    jobs: Sequence[Job],
    threads: int,
    tick: Callable[[int], None] = lambda _: None,
) -> Generator[tuple[Job, Result], None, None]:
    """Do jobs on several threads and yield each with its result, in the order in which they end.

    Parameters
    ----------
    work
        Called with a job and a function that it calls now and then with the number of samples done since the last
        call. That function raises an exception when the work is to stop.
    jobs, threads
        What is done, and the number of threads; with one thread the jobs are done in this thread, in their order.
    tick
        Called with the numbers of samples done, by one thread at a time.
    """
    if threads == 1 or len(jobs) <= 1:
        for job in jobs:
            yield job, work(job, tick)
        return
    stop, lock = threading.Event(), threading.Lock()

    def tick_or_stop(samples: int) -> None:
        if stop.is_set():
            raise StoppedError
        with lock:
            tick(samples)

    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from as_completed(jobs, threads, lambda job: pool.submit(work, job, tick_or_stop))
        finally:
            # An interrupt too must stop what has begun: leaving the pool waits for all of it.
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)


def as_completed(
    jobs: Sequence[Job], workers: int, submit: Callable[[Job], Future[Result]]
) -> Generator[tuple[Job, Result], None, None]:
    """Submit jobs, a few ahead for each worker, and yield each with its result when it is done."""
    waiting = iter(jobs)
    running = {submit(job): job for job in itertools.islice(waiting, _AHEAD * workers)}
    while running:
        done, _ = wait(running, _AWAKE, FIRST_COMPLETED)
        for future in done:
            job = running.pop(future)
            result = future.result()
            running |= {submit(following): following for following in itertools.islice(waiting, 1)}
            yield job, result
