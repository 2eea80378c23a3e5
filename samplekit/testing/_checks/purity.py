"""Purity: points come from the request alone, and making them changes nothing else."""

from __future__ import annotations

import contextlib
import io
import random
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from samplekit.testing._elsewhere import judge_elsewhere
from samplekit.testing._judge import judge_equal
from samplekit.testing._result import CheckFailed, conformance_check
from samplekit.testing._subject import Array, SamplerSubject

_TIMES, _SLOW_TIMES, _MOST_TIMES = 32, 4, 256


@conformance_check("purity", 18)
def check_purity(subject: SamplerSubject) -> None:
    """Usable from two threads at once, pickles, prints nothing, leaves the global generators and settings alone."""
    dims = subject.dims(3)
    for count in subject.counts(7, 64, *((4096,) if subject.sampler.streams and not subject.slow else ()), dims=dims):
        with changing_nothing():
            whole = subject.sets(count, dims, 32)
        with _seeded_globals():
            judge_equal(subject, whole, subject.sets(count, dims, 32), count, "with other global generators")
        # The threads ask for different sets: what they share by mistake would be right in the sets of one of them.
        for first, made in enumerate(_at_once(subject, count, dims)):
            alone = subject.sets(count, dims, 32, first=first)
            for other in made:
                judge_equal(subject, alone, other, count, "while another thread asked as well")
    if not subject.quick:
        judge_elsewhere(subject, subject.sampler, "pickled, in another process")


@contextlib.contextmanager
def changing_nothing() -> Iterator[None]:
    """Raise if the code inside prints, or changes a global generator or how NumPy handles errors."""
    out = io.StringIO()
    # States of our own: a sampler that seeded a generator before would not change it by seeding it so again.
    defaults = np.errstate(divide="warn", over="warn", under="ignore", invalid="warn")
    with _seeded_globals(), defaults, contextlib.redirect_stdout(out):
        python, numpy, errors = random.getstate(), _numpy_state(), np.geterr()
        yield
        if random.getstate() != python:
            raise CheckFailed("changes the state of Python's global generator (module random)")
        if _numpy_state() != numpy:
            raise CheckFailed("changes the state of NumPy's global generator (numpy.random)")
        if np.geterr() != errors:
            raise CheckFailed("changes how NumPy handles floating-point errors (numpy.seterr)")
    # Results of commands go to standard output.
    if out.getvalue():
        raise CheckFailed(f"prints to standard output: {out.getvalue()[:60]!r}")


@contextlib.contextmanager
def _seeded_globals() -> Iterator[None]:
    """Give the global generators other states inside, and the old ones afterwards."""
    python, numpy = random.getstate(), np.random.get_state()  # noqa: NPY002 - judged, not used
    random.seed(20)
    np.random.seed(20)  # noqa: NPY002
    try:
        yield
    finally:
        random.setstate(python)
        np.random.set_state(numpy)  # noqa: NPY002


def _numpy_state() -> bytes:
    name, keys, position, has_gauss, cached = np.random.get_state()  # noqa: NPY002
    return f"{name} {position} {has_gauss} {cached} ".encode() + np.asarray(keys).tobytes()


def _at_once(subject: SamplerSubject, count: int, dims: int) -> tuple[list[Array], list[Array]]:
    """Ask for sets 0 to 31, and 1 to 32, from two threads that start together, several times."""
    made: tuple[list[Array], list[Array]] = ([], [])
    barrier = threading.Barrier(2)
    times = _SLOW_TIMES if subject.slow else _TIMES
    failed = threading.Event()

    def run(mine: list[Array], others: list[Array], first: int) -> None:
        barrier.wait()
        try:
            # Until the other one has asked as well: on a busy machine it may start when this one would be done.
            while len(mine) < times or (len(others) < times and len(mine) < _MOST_TIMES and not failed.is_set()):
                mine.append(subject.sets(count, dims, 32, first=first))
        except BaseException:
            failed.set()
            raise

    with ThreadPoolExecutor(2) as threads:
        runs = [threads.submit(run, made[first], made[1 - first], first) for first in (0, 1)]
    failures = [error for error in (each.exception() for each in runs) if error]
    if failures:
        raise CheckFailed(f"raises when two threads ask at once: {type(failures[0]).__name__}: {failures[0]}")
    return made
