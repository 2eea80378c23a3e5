"""The boundary between samplekit and the code of plugins: every call of a plugin's code goes through it.

A fault of a plugin ends in one line that names the plugin, and what a plugin prints goes to standard error, so that
results stand alone on standard output.
"""

from __future__ import annotations

import contextlib
import sys
import threading
from typing import TYPE_CHECKING, Any, TypeVar

from samplekit._errors import InvalidPointsError, PluginError, SamplekitError, UsageError
from samplekit._quoting import place, quoted, reason

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy as np
    from numpy.typing import NDArray

    from samplekit._registry import Plugin

T = TypeVar("T")


class _Calls(threading.local):
    depth = 0


_calls = _Calls()
"""How many calls of plugins' code are under way in this thread."""


class _Stream:
    """Standard output, except that what a plugin's code prints goes to standard error."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        return int((sys.stderr if _calls.depth else self._stream).write(text))

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextlib.contextmanager
def redirect_plugin_output() -> Iterator[None]:
    """Keep what plugins print off standard output, on any number of threads."""
    stream = sys.stdout
    sys.stdout = _Stream(stream)
    try:
        yield
    finally:
        sys.stdout = stream


class Boundary:
    """Calls the code that one plugin offers. The values that built-in code writes are not checked at run time.

    Parameters
    ----------
    what
        Kind and name of the thing that the plugin offers, such as ``"sampler toy:k=3"``.
    plugin
        The plugin.
    """

    def __init__(self, what: str, plugin: Plugin) -> None:
        self._what, self._plugin = what, plugin
        self._trusted = plugin.builtin

    def call(
        self, fault: str, function: Callable[[], T], valid: Callable[[T], bool] = lambda _: True, expected: str = ""
    ) -> T:
        """Call a function of the plugin and return its answer.

        Parameters
        ----------
        fault
            What to say of the plugin if the call fails, such as ``"cannot list its notes"``.
        function
            The call.
        valid, expected
            A test of the answer, and what the answer should be, in words.

        Raises
        ------
        PluginError
            The function raised an exception, or its answer is not valid.
        UsageError
            The function says that the request is wrong.
        """
        _calls.depth += 1
        try:
            answer = function()
            is_valid = valid(answer)
        except UsageError:
            raise
        except SamplekitError as error:
            raise self.error(f"{fault}: {error}") from error
        except (Exception, SystemExit) as error:
            raise self.error(f"{fault}: {reason(error)}{place(error)}") from error
        finally:
            _calls.depth -= 1
        if not is_valid:
            raise self.error(f"{fault}: expected {expected}, got {quoted(answer)}")
        return answer

    def fill(self, fault: str, out: NDArray[np.float64], function: Callable[[], None]) -> None:
        """Have the plugin write its numbers into ``out``; numbers that it does not write are NaN afterwards."""
        if self._trusted:
            function()
            return
        out.fill(float("nan"))
        self.call(fault, function)

    def check_points(self, points: NDArray[np.float64]) -> None:
        """Raise unless the plugin wrote every point, inside [0, 1)."""
        if self._trusted:
            return
        low, high = float(points.min()), float(points.max())
        if not (low >= 0.0 and high < 1.0):
            wrong = "NaN or values it did not write" if low != low else f"{low if low < 0 else high!r}"
            raise self.error(f"gave {wrong}: expected values in [0, 1)", InvalidPointsError)

    def error(self, fault: str, kind: type[PluginError] = PluginError) -> PluginError:
        """Return the error that blames the plugin for ``fault``."""
        return kind(self._what, str(self._plugin), fault)
