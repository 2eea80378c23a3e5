"""Commands run in this process in a folder of files, with an alarm, and their answers judged."""

from __future__ import annotations

import contextlib
import faulthandler
import io
import os
import shutil
import signal
import time
from typing import TYPE_CHECKING, NamedTuple

from fuzzing.files import BANK, STUDY, numbers
from fuzzing.judge import Answer, judge, tree
from samplekit._cli import run
from samplekit.commands import _notices as notices

if TYPE_CHECKING:
    from pathlib import Path

ALARM, HANG = 8, 60
"""Seconds until a request is interrupted as by its user, and until a process that does not answer ends."""

COMPILED = 55
"""Seconds that a valid request may take while the folder is made: its first run compiles kernels."""


class Verdict(NamedTuple):
    """An answer, all that is wrong with it, and how long it took."""

    answer: Answer
    wrong: list[str]
    seconds: float


class Doors:
    """A folder with valid files of every kind, made once and copied anew whenever something in it changed."""

    def __init__(self, folder: Path) -> None:
        self.folder, self._kept, self.cache = folder / "work", folder / "kept", folder / "cache"
        notices.announce_compilation = lambda: None
        os.environ.update(SAMPLEKIT_CACHE=str(self.cache), COLUMNS="200", TERM="dumb")
        os.environ["_TYPER_FORCE_DISABLE_TERMINAL"] = "1"
        # Jobs in the background of a shell ignore interrupts; here they have to arrive.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        self._kept.mkdir(parents=True)
        os.chdir(self._kept)
        for place in ("folder", "out"):
            (self._kept / place).mkdir()
        for name in ("a.csv", "b.plain.csv", "c.npy", "d.dat", "e.bin", "points.svg"):
            self._make(["points", "-s", "jittered", "-n", "16", "-o", name])
        for name in BANK:
            self._make(["points", "-s", name, "-n", "9"])
        self._make(["render", "-s", "random", "-n", "4", "--size", "8", "-o", "image.exr"])
        self._make([*STUDY.split(), "--output", "out/study"])
        self.study_file = (self._kept / "out" / "study" / "study.sqlite").read_bytes()
        self.study = numbers(self._run([*STUDY.split(), "--output", "out/study", "--resume", "--json"]).out)
        shutil.rmtree(self._kept / "out" / "study")
        self._states: dict[str, tuple] = {}
        self.anew()

    def anew(self) -> None:
        """Put all files back."""
        os.chdir(self._kept)
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self._kept, self.folder)
        os.chdir(self.folder)
        self._states = self._whole = tree(self.folder)

    def look(self) -> None:
        """Take what is there now for what was there before."""
        self._states = tree(self.folder)

    def ask(self, words: list[str], *, study: bool = False) -> Verdict:
        """Run a command, judge what it did, and tidy up. A ``study`` may tidy up its own database when it refuses."""
        began = time.perf_counter()
        answer = self._run(words)
        seconds = time.perf_counter() - began
        before = tree(self.folder) if study and answer.status else self._states
        wrong = judge(words, answer, before, self.folder)
        if tree(self.folder) != self._whole:
            self.anew()
        return Verdict(answer, wrong, seconds)

    def _make(self, words: list[str]) -> None:
        answer = self._run(words, COMPILED)
        assert answer.status == 0, answer

    def _run(self, words: list[str], alarm: int = ALARM) -> Answer:
        # As the system gives them to a process: never with a null, which ends a word.
        out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", "backslashreplace", write_through=True) for _ in range(2))
        faulthandler.dump_traceback_later(HANG, exit=True)
        previous = signal.signal(signal.SIGALRM, lambda *_: os.kill(os.getpid(), signal.SIGINT))
        signal.alarm(alarm)
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                try:
                    status = run(words)
                except BaseException as error:
                    status = -1
                    err.write(f"Traceback (most recent call last): {type(error).__name__}: {error}")
        finally:
            signal.alarm(0)
            signal.signal(signal.SIGALRM, previous)
            faulthandler.cancel_dump_traceback_later()
        return Answer(status, *(stream.buffer.getvalue().decode("utf-8", "replace") for stream in (out, err)))  # type: ignore[attr-defined]
