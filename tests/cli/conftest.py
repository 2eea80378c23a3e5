"""Commands run in this process, in an empty folder, with what they print kept apart; and real ones where it matters."""

import json
import os
import subprocess
import sys
from typing import NamedTuple

import pytest

from samplekit._cli import run
from samplekit.commands import _notices as notices

NOTICE = "samplekit: compiling kernels for this machine"
PLAIN_TERMINAL = {"TERM": "dumb", "COLUMNS": "200", "_TYPER_FORCE_DISABLE_TERMINAL": "1"}


class Done(NamedTuple):
    """What a command left behind: exit status, standard output, standard error without the notice of compilation."""

    status: int
    out: str
    err: str

    @property
    def report(self):
        """The one JSON object on standard output, in JSON as the standard has it: without NaN and infinity."""
        assert self.out.endswith("}\n")
        assert self.out.count("\n") == 1

        def refuse(constant):
            raise AssertionError(f"{constant} is no JSON")

        found = json.loads(self.out, parse_constant=refuse)
        assert isinstance(found, dict)
        return found

    @property
    def error(self):
        """The one line on standard error that says what is wrong."""
        assert self.err.endswith("\n")
        assert self.err.count("\n") == 1, self.err
        assert self.err.startswith("samplekit: ")
        assert "Traceback" not in self.err
        assert not set("─│╭╮╰╯┃━") & set(self.err)
        return self.err.removeprefix("samplekit: ").rstrip("\n")


def without_notice(err):
    return "".join(line for line in err.splitlines(keepends=True) if not line.startswith(NOTICE))


@pytest.fixture
def command(tmp_path, monkeypatch, capsys):
    """Run a command in the empty folder ``tmp_path``."""
    monkeypatch.chdir(tmp_path)
    # It listens to numba for the rest of the process: once for every command.
    monkeypatch.setattr(notices, "announce_compilation", lambda: None)
    for name, value in PLAIN_TERMINAL.items():
        monkeypatch.setenv(name, value)

    def run_here(*arguments):
        status = run([str(argument) for argument in arguments])
        return Done(status, *capsys.readouterr())

    return run_here


@pytest.fixture
def process(tmp_path):
    """Run a command as a process of its own in the empty folder ``tmp_path``."""

    def run_there(*arguments, environment=None, program=("-m", "samplekit"), **how):
        done = subprocess.run(
            [sys.executable, *program, *map(str, arguments)],
            cwd=tmp_path,
            env={**os.environ, **PLAIN_TERMINAL, **(environment or {})},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=100,
            check=False,
            **how,
        )
        return Done(done.returncode, done.stdout, without_notice(done.stderr))

    return run_there
