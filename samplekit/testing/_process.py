"""A function in a Python process of its own, watched from outside: it may hang, crash or take too much memory.

The process is started anew, never forked. It sends results through a file, so that nothing that it prints disturbs
them, and the limits need no system call that only some systems have.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import psutil

from samplekit._quoting import reason

_POLL = 0.02


class NoResultError(Exception):
    """Another process gave no result; the message says why."""


class OtherProcess:
    """A new process that calls one function; iterating over it starts the process and gives what the function yields.

    Parameters
    ----------
    function
        A generator function, ``"package.module:function"``. What it yields is pickled, and is never None.
    arguments
        Its arguments, which are pickled.
    seconds
        Longest time from the start to the first result, and from each result to the next.
    memory
        Most bytes that the process and its children may hold; None: no limit.
    environment
        Environment variables to set.

    Attributes
    ----------
    problem
        After the iteration: how the process ended, if not well; otherwise empty.
    last_line
        The line on standard error that explains the problem best; empty if there is none.
    printed
        What the process wrote to standard output.

    Raises
    ------
    NoResultError
        An argument cannot be pickled.
    """

    def __init__(
        self,
        function: str,
        *arguments: Any,
        seconds: float,
        memory: float | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        try:
            self._request = pickle.dumps((function, arguments))
        except Exception as error:
            raise NoResultError(f"cannot be pickled: {reason(error)}") from None
        self._seconds, self._memory = seconds, memory
        path = os.pathsep.join(filter(None, sys.path))
        self._environment = {**os.environ, "PYTHONPATH": path, **(environment or {})}
        self.problem = self.last_line = ""
        self.printed = b""

    def __iter__(self) -> Iterator[Any]:
        with tempfile.TemporaryDirectory(prefix="samplekit-", ignore_cleanup_errors=True) as folder:
            request, results, printed, errors = (Path(folder) / part for part in ("request", "results", "out", "err"))
            request.write_bytes(self._request)
            results.touch()
            with printed.open("wb") as out, errors.open("wb") as err:
                process = psutil.Popen(
                    [sys.executable, "-X", "faulthandler", "-m", __name__, str(request), str(results)],
                    stdin=subprocess.DEVNULL,
                    stdout=out,
                    stderr=err,
                    env=self._environment,
                )
            try:
                with results.open("rb") as stream:
                    yield from self._watch(process, stream)
            finally:
                _kill(process)
            self.printed = printed.read_bytes()
            self.last_line = _last_line(errors)

    def one_result(self) -> Any:
        """Return the only result.

        Raises
        ------
        NoResultError
            The process hung, died or raised.
        """
        results = list(self)
        if self.problem:
            raise NoResultError(f"{self.problem}: {self.last_line}" if self.last_line else self.problem)
        return results[0]

    def _watch(self, process: psutil.Popen, stream: BinaryIO) -> Iterator[Any]:
        """Yield results until the process ends or exceeds a limit."""
        since = time.monotonic()
        alive, finished, problem = True, False, ""
        while alive and not problem:
            # Asked before the file is read: results that are sent in between are read as well.
            alive = process.poll() is None
            for result in _whole_results(stream):
                since, finished = time.monotonic(), result is None
                if not finished:
                    yield result
            if time.monotonic() - since > self._seconds:
                problem = f"hangs: no answer in {self._seconds:g} s"
            elif self._memory is not None and _memory_of(process) > self._memory:
                problem = f"takes more than {self._memory / 2**30:.3g} GiB of memory"
            elif alive:
                time.sleep(_POLL)
            elif process.returncode < 0:
                problem = f"crashes the interpreter ({signal.Signals(-process.returncode).name})"
            else:
                problem = f"ends the interpreter (status {process.returncode})"
        # What goes wrong after the last result, while the interpreter shuts down, is no fault of the function.
        self.problem = "" if finished else problem


def _whole_results(stream: BinaryIO) -> Iterator[Any]:
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


def _last_line(errors: Path) -> str:
    """Return the line that explains most: the first one of faulthandler after a crash, otherwise the last one."""
    lines = [line.strip() for line in errors.read_text(errors="replace").splitlines() if line.strip()]
    fatal = [line for line in lines if line.startswith("Fatal Python error")]
    return (fatal or lines or [""])[-1][:200]


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
