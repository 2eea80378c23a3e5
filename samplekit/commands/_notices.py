"""Tell the user on stderr when something takes longer the first time."""

from __future__ import annotations

import functools
import sys
from typing import Any


@functools.cache
def announce_compilation() -> None:
    """Tell the user, once in this process, that kernels are compiled, when the first one is not in the cache."""
    from numba.core import event

    class _Announcement(event.Listener):  # type: ignore[misc]
        said = False

        def on_start(self, event: Any) -> None:
            if not self.said:
                self.said = True
                print("samplekit: compiling kernels for this machine, once (some seconds)", file=sys.stderr)  # noqa: T201

        def on_end(self, event: Any) -> None: ...

    event.register("numba:compile", _Announcement())
