"""How many threads: those that were asked for, also in what is called without being told, such as references."""

from __future__ import annotations

import os
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator

MOST = 1024
_asked_for: ContextVar[int | None] = ContextVar("threads", default=None)


def default_threads() -> int:
    """The threads that were asked for, and else the processors that this process may use."""
    asked_for = _asked_for.get()
    if asked_for is not None:
        return asked_for
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def check_threads(threads: object) -> int:
    """The number of threads as an int; None: :func:`default_threads`.

    Raises
    ------
    UsageError
        It is not an integer from 1 to 1024.
    """
    if threads is None:
        return default_threads()
    if isinstance(threads, bool) or not isinstance(threads, int) or not 1 <= threads <= MOST:
        raise UsageError(f"threads {threads}: expected an integer from 1 to {MOST}")
    return threads


@contextmanager
def asking_for(threads: int) -> Iterator[None]:
    """Within it :func:`default_threads` is ``threads``, in this thread."""
    token = _asked_for.set(threads)
    try:
        yield
    finally:
        _asked_for.reset(token)
