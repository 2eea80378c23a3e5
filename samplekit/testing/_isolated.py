"""A run in a process of its own, with limits: what hangs, crashes the interpreter or eats memory is named, and ended.

The child is started anew (never forked), tells what it does through a file, and is watched from outside: limits need
no system call that only some systems have. After an abnormal end another child goes on with the next check.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from samplekit.testing._result import Outcome

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

Kind = Literal["sampler", "scene"]

_POLL = 0.02
_MOST_ENDS = 3
"""Abnormal ends after which the rest is not run: each may have taken all of its time."""


@dataclass(frozen=True)
class Limits:
    """Seconds that one check, and the import before the first, may take; bytes of memory of the process."""

    seconds: float = 120.0
    memory: int = 4 * 2**30


@dataclass
class _Watched:
    """What a child has told so far."""

    outcomes: list[Outcome] = field(default_factory=list)
    running: str = ""
    finished: bool = False
    since: float = field(default_factory=time.monotonic)


def check_isolated(
    name: str,
    kind: Kind,
    checks: Sequence[str],
    *,
    quick: bool = False,
    limits: Limits | None = None,
    report: Callable[[str, Outcome | None], None] = lambda _, __: None,
) -> list[Outcome]:
    """Run checks over an installed sampler or scene, each in a process that may die.

    Parameters
    ----------
    name, kind
        What is judged, as on the command line.
    checks
        Names of the checks, in their order.
    report
        Called before each check with None, and after it with its outcome.

    Returns
    -------
    An outcome for every check.
    """
    limits = limits or Limits()
    left = list(checks)
    outcomes: list[Outcome] = []
    ends = 0
    printed = b""
    while left and ends < _MOST_ENDS:
        made, ended, output = _run_child(name, kind, left, quick, limits, report)
        printed += output
        outcomes += made
        left = left[len(made) :]
        if ended:
            ends += 1
            outcomes.append(Outcome(name, left.pop(0), "failed", ended))
            report(outcomes[-1].check, outcomes[-1])
    outcomes += [Outcome(name, check, "failed", f"not run: {outcomes[-1].message}") for check in left]
    if printed.strip():
        _blame_for_printing(outcomes, printed)
    return outcomes


def _blame_for_printing(outcomes: list[Outcome], printed: bytes) -> None:
    """Fail purity for output that reached the process's standard output, from whatever language."""
    blamed = next((outcome for outcome in outcomes if outcome.check == "purity"), outcomes[-1])
    if blamed.status == "passed":
        blamed.status = "failed"
        blamed.message = f"prints to standard output: {printed[:60].decode(errors='replace')!r}"


def _run_child(
    name: str,
    kind: Kind,
    checks: Sequence[str],
    quick: bool,
    limits: Limits,
    report: Callable[[str, Outcome | None], None],
) -> tuple[list[Outcome], str, bytes]:
    """Outcomes of the checks that ended, how the child ended if not well, and what it printed."""
    with tempfile.TemporaryDirectory(prefix="samplekit-", ignore_cleanup_errors=True) as folder:
        told, printed, errors = (Path(folder) / part for part in ("told", "printed", "errors"))
        told.touch()
        with printed.open("wb") as out, errors.open("wb") as err:
            child = subprocess.Popen(
                [sys.executable, "-X", "faulthandler", "-m", "samplekit.testing._isolated", str(told)],
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=err,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
            assert child.stdin is not None
            child.stdin.write(pickle.dumps((name, kind, list(checks), quick)))
            child.stdin.close()
            watched = _Watched()
            ended = _watch(child, told, watched, limits, report)
        what = f"during {watched.running}" if watched.running else "while it was imported and configured"
        if ended and not watched.finished:
            last = _last_line(errors)
            return watched.outcomes, f"{ended} {what}" + (f": {last}" if last else ""), printed.read_bytes()
        return watched.outcomes, "", printed.read_bytes()


def _watch(
    child: subprocess.Popen[bytes],
    told: Path,
    watched: _Watched,
    limits: Limits,
    report: Callable[[str, Outcome | None], None],
) -> str:
    """Follow a child to its end; says how it ended, if not well."""
    ended = ""
    with told.open("rb") as stream:
        while True:
            alive = child.poll() is None
            for record in _records(stream):
                _take(record, watched, report)
            if not alive:
                break
            if time.monotonic() - watched.since > limits.seconds:
                ended = f"hangs: no answer in {limits.seconds:g} s"
            elif _memory_of(child.pid) > limits.memory:
                ended = f"takes more than {limits.memory / 2**30:.3g} GiB of memory"
            if ended:
                _end(child)
                return ended
            time.sleep(_POLL)
    status = child.returncode
    if status < 0:
        return f"crashes the interpreter ({signal.Signals(-status).name})"
    return "" if watched.finished else f"ends the interpreter (status {status})"


def _take(record: Any, watched: _Watched, report: Callable[[str, Outcome | None], None]) -> None:
    watched.since = time.monotonic()
    if record is None:
        watched.finished = True
    elif isinstance(record, Outcome):
        watched.outcomes.append(record)
        watched.running = ""
        report(record.check, record)
    else:
        watched.running = record
        report(record, None)


def _records(stream: Any) -> Iterator[Any]:
    """What has been written whole since the last time."""
    while True:
        place = stream.tell()
        try:
            yield pickle.load(stream)
        except (EOFError, pickle.UnpicklingError, AttributeError, ValueError):
            stream.seek(place)
            return


def _memory_of(process: int) -> int:
    """Resident bytes of a process and its children; 0 if it has gone."""
    import psutil

    try:
        parent = psutil.Process(process)
        return sum(int(each.memory_info().rss) for each in [parent, *parent.children(recursive=True)])
    except psutil.Error:
        return 0


def _end(child: subprocess.Popen[bytes]) -> None:
    """End a child and what it has started, by their ids."""
    import psutil

    try:
        started = psutil.Process(child.pid).children(recursive=True)
    except psutil.Error:
        started = []
    child.kill()
    child.wait()
    for each in started:
        try:
            each.kill()
        except psutil.Error:
            continue


def _last_line(errors: Path) -> str:
    """The line that says most: of a crash, faulthandler's first; else the last."""
    lines = [line.strip() for line in errors.read_text(errors="replace").splitlines() if line.strip()]
    fatal = [line for line in lines if line.startswith("Fatal Python error")]
    return (fatal or lines or [""])[-1][:200]


def main() -> None:
    """Run in the child: read the request from standard input, tell outcomes through the file."""
    from samplekit.testing._suite import check_sampler, check_scene

    name, kind, checks, quick = pickle.loads(sys.stdin.buffer.read())
    with Path(sys.argv[1]).open("ab", buffering=0) as told:

        def report(check: Any, outcome: Outcome | None) -> None:
            told.write(pickle.dumps(check.name if outcome is None else outcome))

        run = check_sampler if kind == "sampler" else check_scene
        run(name, quick=quick, only=checks, report=report)
        told.write(pickle.dumps(None))


if __name__ == "__main__":
    main()
