"""Call a function in a Python process of its own, watched from outside: it may hang, crash or take too much memory.

The process is started anew, never forked. It sends results through a file, so that nothing that it prints disturbs
them, and the limits need no system call that only some systems have.
"""

from __future__ import annotations

import contextlib
import importlib
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator, Iterator, Mapping
from pathlib import Path
from typing import IO, Any

import psutil

from samplekit._quoting import reason

_POLL = 0.02


class NoResultError(Exception):
    """Another process did not give all of its results.

    Attributes
    ----------
    problem
        What happened to the process.
    line
        The line on standard error that explains the problem best, behind a colon; empty if there is none.
    """

    def __init__(self, problem: str, line: str = "") -> None:
        super().__init__(problem + line)
        self.problem, self.line = problem, line


def run_elsewhere(
    function: str,
    *arguments: Any,
    seconds: float,
    memory: float = math.inf,
    environment: Mapping[str, str] | None = None,
    stdout: int | IO[bytes] = subprocess.DEVNULL,
) -> Iterator[Any]:
    """Call a function in a new process, and yield what it yields.

    Parameters
    ----------
    function
        A generator function, ``"package.module:function"``. What it yields is pickled, and is never None.
    arguments
        Its arguments, which are pickled.
    seconds
        Longest time from the start to the first result, and from each result to the next.
    memory
        Most bytes that the process and its children may hold.
    environment
        Environment variables to set.
    stdout
        Where the process prints.

    Raises
    ------
    NoResultError
        The arguments cannot be pickled, or the process hung, died, raised, or took too much memory.
    """
    try:
        pickled = pickle.dumps((function, arguments))
    except Exception as error:
        raise NoResultError(f"cannot be pickled: {reason(error)}") from None
    path = os.pathsep.join(filter(None, sys.path))
    with tempfile.TemporaryDirectory(prefix="samplekit-", ignore_cleanup_errors=True) as folder:
        request, results, errors = (Path(folder) / part for part in ("request", "results", "errors"))
        request.write_bytes(pickled)
        results.touch()
        with errors.open("wb") as stderr:
            process = psutil.Popen(
                [sys.executable, "-X", "faulthandler", "-m", __name__, str(request), str(results)],
                stdin=subprocess.DEVNULL,
                stdout=stdout,
                stderr=stderr,
                env={**os.environ, "PYTHONPATH": path, **(environment or {})},
            )
        try:
            with results.open("rb") as stream:
                problem = yield from _watch(process, stream, seconds, memory)
        finally:
            _kill(process)
        if problem:
            raise NoResultError(problem, _explanation(errors))


def _watch(process: psutil.Popen, stream: IO[bytes], seconds: float, memory: float) -> Generator[Any, None, str]:
    """Yield results until the process ends or exceeds a limit; return what went wrong, empty if nothing did."""
    since = time.monotonic()
    alive, finished, problem = True, False, ""
    while alive and not problem:
        # Whether it is alive is asked before the file is read: results that are sent in between are read as well.
        alive = process.poll() is None
        for result in _whole_results(stream):
            since, finished = time.monotonic(), result is None
            if not finished:
                yield result
        if time.monotonic() - since > seconds:
            problem = f"hangs: no answer in {seconds:g} s"
        elif memory < math.inf and _memory_of(process) > memory:
            problem = f"takes more than {memory / 2**30:.3g} GiB of memory"
        elif alive:
            time.sleep(_POLL)
        elif process.returncode < 0:
            problem = f"crashes the interpreter ({signal.Signals(-process.returncode).name})"
        else:
            problem = f"ends the interpreter (status {process.returncode})"
    # What goes wrong after the last result, while the interpreter shuts down, is no fault of the function.
    return "" if finished else problem


def _whole_results(stream: IO[bytes]) -> Iterator[Any]:
    """Yield the results that have been written since the last call, without one that is still being written."""
    while True:
        place = stream.tell()
        try:
            yield pickle.load(stream)
        except (EOFError, pickle.UnpicklingError, AttributeError, ValueError):
            stream.seek(place)
            return


def _memory_of(process: psutil.Popen) -> int:
    """Return the resident bytes of a process and what it has started, as far as these still run."""
    memory = 0
    for each in _family(process):
        with contextlib.suppress(psutil.Error):
            memory += int(each.memory_info().rss)
    return memory


def _kill(process: psutil.Popen) -> None:
    """End a process and what it has started, by their ids."""
    for each in _family(process):
        with contextlib.suppress(psutil.Error):
            each.kill()
    process.wait()


def _family(process: psutil.Popen) -> list[psutil.Process]:
    with contextlib.suppress(psutil.Error):
        return [process, *process.children(recursive=True)]
    return []


def _explanation(errors: Path) -> str:
    """Return the line that explains most, behind a colon: of faulthandler after a crash, otherwise the last one."""
    lines = [line.strip() for line in errors.read_text(errors="replace").splitlines() if line.strip()]
    fatal = [line for line in lines if line.startswith("Fatal Python error")]
    return f": {(fatal or lines)[-1][:200]}" if lines else ""


def main(request: str, results: str) -> None:
    """Answer one request: runs in the other process."""
    name, arguments = pickle.loads(Path(request).read_bytes())
    module, _, function = name.partition(":")
    with Path(results).open("ab", buffering=0) as stream:
        try:
            for result in getattr(importlib.import_module(module), function)(*arguments):
                stream.write(pickle.dumps(result))
            stream.write(pickle.dumps(None))
        except Exception as error:
            sys.exit(reason(error))


if __name__ == "__main__":
    main(*sys.argv[1:])
