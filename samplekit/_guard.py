"""The guard: calls into a plugin, whose faults end in one line that names it, and whose prints are no results."""

from __future__ import annotations

import contextlib
import sys
import threading
from typing import TYPE_CHECKING, Any, TypeVar

from samplekit._errors import SamplekitError, UsageError
from samplekit._quoting import place, quoted, reason

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from samplekit._registry import Plugin

T = TypeVar("T")


class _Calls(threading.local):
    depth = 0


_calls = _Calls()
"""Those under way in a thread."""


class _Results:
    """Standard output, but for what a thread writes within a guarded call: that goes to standard error."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        return int((sys.stderr if _calls.depth else self._stream).write(text))

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextlib.contextmanager
def results_alone() -> Iterator[None]:
    """Keep what plugins print off standard output, for any number of threads."""
    stream = sys.stdout
    sys.stdout = _Results(stream)
    try:
        yield
    finally:
        sys.stdout = stream


class Guard:
    """Guards what one plugin offers.

    Parameters
    ----------
    what
        Kind and name, such as ``"sampler toy:k=3"``.
    plugin
        Where it comes from.
    """

    def __init__(self, what: str, plugin: Plugin) -> None:
        self._who = f"{what} of plugin {plugin}"

    def __call__(
        self, fault: str, call: Callable[[], T], valid: Callable[[T], bool] = lambda _: True, expected: str = ""
    ) -> T:
        """What ``call`` gives.

        Parameters
        ----------
        fault
            What is wrong where it gives nothing, such as ``"cannot tell its notes"``.
        valid, expected
            Whether an answer is one, and what it should be.

        Raises
        ------
        SamplekitError
            It raised, or gave something else.
        UsageError
            The plugin's own: the request is at fault.
        """
        _calls.depth += 1
        try:
            answer = call()
            right = valid(answer)
        except UsageError:
            raise
        except SamplekitError as error:
            raise self.blame(f"{fault}: {error}") from error
        except (Exception, SystemExit) as error:
            raise self.blame(f"{fault}: {reason(error)}{place(error)}") from error
        finally:
            _calls.depth -= 1
        if not right:
            raise self.blame(f"{fault}: expected {expected}, got {quoted(answer)}")
        return answer

    def blame(self, what: str) -> SamplekitError:
        """The error that names the plugin."""
        return SamplekitError(f"{self._who} {what}")
