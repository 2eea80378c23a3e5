"""A progress bar on stderr, on a terminal only, for work that takes longer than a second."""

from __future__ import annotations

import sys
import time
from typing import Any

from samplekit.commands import _interrupts as interrupts


class Progress:
    """Called with the numbers done and to do; shows a bar once a second has passed."""

    def __init__(self, what: str) -> None:
        self._what = what
        self._began = time.monotonic()
        self._shown_at = 0.0
        self._bar: Any = None
        self._task: Any = None

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *exception: object) -> None:
        self._remove()

    def _remove(self) -> None:
        if self._bar is not None:
            self._bar.stop()
            self._bar = None

    def __call__(self, done: int, total: int) -> None:
        """Show the state; the bar vanishes when all is done. Raises KeyboardInterrupt if Python dropped one."""
        interrupts.check()
        if done >= total:
            self._remove()
            return
        now = time.monotonic()
        if now - self._began < 1.0 or now - self._shown_at < 0.1 or not sys.stderr.isatty():
            return
        self._shown_at = now
        if self._bar is None:
            from rich.console import Console
            from rich.progress import Progress as Bar

            self._bar = Bar(console=Console(stderr=True), transient=True)
            self._task = self._bar.add_task(self._what, total=total)
            self._bar.start()
        self._bar.update(self._task, completed=done)


class Stages:
    """Called with what is being done and the numbers done and to do; shows a bar for each stage."""

    def __init__(self) -> None:
        self._what = ""
        self._progress: Progress | None = None

    def __enter__(self) -> Stages:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._progress is not None:
            self._progress.__exit__(*exception)

    def __call__(self, what: str, done: int, total: int) -> None:
        """Show the state of a stage."""
        if self._progress is None or what != self._what:
            self.__exit__(None)
            self._what, self._progress = what, Progress(what)
        self._progress(done, total)
