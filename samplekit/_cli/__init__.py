"""The command line. Each command is a file with its imports inside its body, so that ``--help`` starts fast."""

from __future__ import annotations

import contextlib
import errno
import gc
import os
import sys
from pathlib import Path
from typing import Annotated, Any, TextIO

import typer

from samplekit import __version__
from samplekit._boundary import redirect_plugin_output
from samplekit._builtin.declarations.commands import COMMANDS
from samplekit._cli.command import Command, TyperError, TyperUsageError
from samplekit._cli.plugin_commands import PluginGroup
from samplekit._errors import SamplekitError, UsageError
from samplekit.commands import _interrupts as interrupts
from samplekit.commands._statuses import DONE, FAILED, INTERRUPTED, WRONG_USE

_LONGEST_WORD, _LONGEST_MESSAGE = 300, 6000
"""Most letters that are shown: somebody may have pasted a file by mistake."""
_STREAM_ERRORS = (errno.ENOSPC, errno.EIO, errno.EFBIG, errno.EBADF)

app = typer.Typer(
    name="samplekit",
    help="A laboratory for the point samplers of rendering.",
    cls=PluginGroup,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"samplekit {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """A laboratory for the point samplers of rendering."""


for _spec in COMMANDS:
    _run = _spec.load()
    # Python drops docstrings if it is asked to (-OO).
    app.command(_spec.name, help=_run.__doc__ or _spec.summary, cls=Command)(_run)


def main() -> None:
    """Run the command line; every error ends in one line on stderr and an exit status."""
    # Imports make many objects and no garbage: collecting among them is a tenth of the start-up.
    gc.set_threshold(100_000)
    # A shell may close either: Python then has None, and every print and question to it would fail.
    sys.stdout = sys.stdout or _nowhere()
    sys.stderr = sys.stderr or _nowhere()
    sys.exit(run(sys.argv[1:]))


def _nowhere() -> TextIO:
    return Path(os.devnull).open("w", encoding="utf-8")


def run(arguments: list[str]) -> int:
    """Run one command and return its exit status: 0 done, 1 failed, 2 wrong use, 3 a check failed, 130 interrupted."""
    try:
        with interrupts.remembered(), redirect_plugin_output():
            result = app(args=arguments, prog_name="samplekit", standalone_mode=False)
        return result if isinstance(result, int) else DONE
    except (UsageError, TyperUsageError) as error:
        return _failed(_message(error), WRONG_USE, arguments)
    except (SamplekitError, TyperError) as error:
        return _failed(_message(error), FAILED, arguments)
    except (KeyboardInterrupt, typer.Abort):
        return INTERRUPTED
    except SystemExit as error:
        # Some plugins' commands end like programs.
        if error.code is None or isinstance(error.code, int):
            return error.code or DONE
        return _failed(" ".join(str(error.code).split()), FAILED, arguments)
    except BrokenPipeError:
        _abandon_stdout()
        return FAILED
    except MemoryError:
        return _failed("out of memory", FAILED, arguments)
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _STREAM_ERRORS and error.filename is None:
            _abandon_stdout()
            return _failed(f"cannot write to standard output: {error.strerror}", FAILED, arguments)
        if os.environ.get("SAMPLEKIT_TRACEBACK"):
            raise
        what = " ".join(f"{type(error).__name__}: {error}".split())
        return _failed(f"internal error: {what} (SAMPLEKIT_TRACEBACK=1 shows where)", FAILED, arguments)


def _abandon_stdout() -> None:
    """Send what is still to be written on stdout nowhere, so that Python does not fail when it flushes it at exit."""
    # A stream that has no file number is a buffer of this process, which cannot fail at exit.
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _message(error: Exception) -> str:
    formatted: Any = getattr(error, "format_message", lambda: str(error))
    words = " ".join(word if len(word) <= _LONGEST_WORD else _shortened(word) for word in str(formatted()).split())
    return words if len(words) <= _LONGEST_MESSAGE else f"{words[:_LONGEST_MESSAGE]}..."


def _shortened(word: str) -> str:
    return f"{word[: _LONGEST_WORD // 2]}...{word[-_LONGEST_WORD // 4 :]}"


def _failed(message: str, status: int, arguments: list[str]) -> int:
    if "--json" in arguments:
        import json

        try:
            print(json.dumps({"schema": "samplekit.error/1", "error": message}), flush=True)  # noqa: T201
        except OSError:
            _abandon_stdout()
    # Without arguments the help has been shown, and there is nothing to add.
    if message:
        # Even standard error may take nothing: then the exit status has to be enough.
        with contextlib.suppress(OSError):
            print(f"samplekit: {message}", file=sys.stderr, flush=True)  # noqa: T201
    return status
