"""Purity: points come from the request alone, and making them changes nothing else."""

from __future__ import annotations

import contextlib
import io
import random
import threading
from typing import TYPE_CHECKING

import numpy as np

from samplekit.testing._determinism import ELSEWHERE_REALIZATIONS, judge_equal
from samplekit.testing._elsewhere import ElsewhereError, points_elsewhere
from samplekit.testing._result import CheckFailed, check

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit.testing._subject import Subject


_TIMES, _MOST_TIMES = 4, 256


@check("purity", 18)
def check_purity(subject: Subject) -> None:
    """Usable from two threads at once, pickles, prints nothing, leaves the global generators and settings alone."""
    dims = subject.dims(3)
    for count in subject.counts(7, 64, dims=dims):
        with untouched_globals(), printing_nothing():
            whole = subject.sets(count, dims, 32)
        with seeded_globals():
            judge_equal(subject, whole, subject.sets(count, dims, 32), count, 0, "with other global generators")
        for other in _at_once(subject, count, dims):
            judge_equal(subject, whole, other, count, 0, "while another thread asked as well")
    if subject.quick:
        return
    count = subject.counts(64, dims=dims)[0]
    try:
        other_process = points_elsewhere(subject, (count, dims, ELSEWHERE_REALIZATIONS, 3))["pickle"]
    except ElsewhereError as error:
        raise CheckFailed(f"pickled, in another process: {error}") from None
    if isinstance(other_process, str):
        raise CheckFailed(f"pickled, in another process: {other_process}")
    whole = subject.sets(count, dims, ELSEWHERE_REALIZATIONS, seed=3)
    judge_equal(subject, whole, other_process, count, 3, "pickled, in another process")


@contextlib.contextmanager
def untouched_globals() -> Iterator[None]:
    """Raise if what runs inside changes a global generator, or NumPy's handling of errors."""
    # States of our own: one that was seeded by the sampler before would not change when it is seeded so again.
    with seeded_globals():
        python, numpy, errors = random.getstate(), _numpy_state(), np.geterr()
        yield
        if random.getstate() != python:
            raise CheckFailed("changes the state of Python's global generator (module random)")
        if _numpy_state() != numpy:
            raise CheckFailed("changes the state of NumPy's global generator (numpy.random)")
        if np.geterr() != errors:
            raise CheckFailed("changes how NumPy handles floating-point errors (numpy.seterr)")


@contextlib.contextmanager
def seeded_globals() -> Iterator[None]:
    """Other states of the global generators inside, the old ones after."""
    python, numpy = random.getstate(), np.random.get_state()  # noqa: NPY002 - judged, not used
    random.seed(20)
    np.random.seed(20)  # noqa: NPY002
    try:
        yield
    finally:
        random.setstate(python)
        np.random.set_state(numpy)  # noqa: NPY002


@contextlib.contextmanager
def printing_nothing() -> Iterator[None]:
    """Raise if what runs inside prints: results of commands go to standard output."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        yield
    if out.getvalue():
        raise CheckFailed(f"prints to standard output: {out.getvalue()[:60]!r}")


def _numpy_state() -> bytes:
    name, keys, position, has_gauss, cached = np.random.get_state()  # noqa: NPY002
    return f"{name} {position} {has_gauss} {cached} ".encode() + np.asarray(keys).tobytes()


def _at_once(subject: Subject, count: int, dims: int) -> list[NDArray[np.float64]]:
    """The same request from two threads that start together, several times."""
    made: tuple[list[NDArray[np.float64]], ...] = ([], [])
    failures: list[BaseException] = []
    barrier = threading.Barrier(2)

    def run(mine: list[NDArray[np.float64]], others: list[NDArray[np.float64]]) -> None:
        try:
            barrier.wait()
            # Until the other has been at it as well: on a busy machine it may start when this one would be done.
            while len(mine) < _TIMES or (len(others) < _TIMES and len(mine) < _MOST_TIMES and not failures):
                mine.append(subject.sets(count, dims, 32))
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=run, args=(made[i], made[1 - i])) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise CheckFailed(f"raises when two threads ask at once: {type(failures[0]).__name__}: {failures[0]}")
    return [*made[0], *made[1]]
