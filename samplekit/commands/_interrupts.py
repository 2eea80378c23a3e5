"""Remember interrupts: Python drops the KeyboardInterrupt of one that arrives while it runs a callback of its own."""

from __future__ import annotations

import contextlib
import signal
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

_received = threading.Event()


@contextlib.contextmanager
def remembered() -> Iterator[None]:
    """Remember interrupts that arrive inside, which raise as usual; does nothing if the caller handles them itself."""
    _received.clear()
    ours = threading.current_thread() is threading.main_thread()
    if not ours or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, _remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _remember(number: int, frame: Any) -> None:
    _received.set()
    signal.default_int_handler(number, frame)


def check() -> None:
    """Raise KeyboardInterrupt if an interrupt was received. Long work calls this now and then."""
    if _received.is_set():
        raise KeyboardInterrupt
