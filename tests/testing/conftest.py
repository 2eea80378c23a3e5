"""Mutants and strangers' samplers are importable, here and in the processes that checks start."""

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from samplekit._cli import run
from samplekit._registry import registry
from samplekit.commands import _notices as notices

HERE = Path(__file__).parent
STRANGERS = HERE / "strangers"
# Checks pass sys.path on to the processes that they start.
sys.path[:0] = [str(HERE), str(STRANGERS)]

ENTRY_POINTS = "[samplekit]\nfaulty = faulty\nheavy = heavy\n"


@pytest.fixture(scope="session")
def installed(tmp_path_factory):
    """A folder with the metadata of a distribution whose plugins are faulty: as if pip had installed it."""
    folder = tmp_path_factory.mktemp("site")
    metadata = folder / "faulty-0.1.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: faulty\nVersion: 0.1\n")
    (metadata / "entry_points.txt").write_text(ENTRY_POINTS)
    return folder


class Result(NamedTuple):
    """How a command in this process ended, with the names that a finished process has."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def samplekit_here(installed, monkeypatch, capsys):
    """Run ``samplekit ARGUMENTS`` in this process where the faulty plugins are installed."""
    monkeypatch.syspath_prepend(installed)
    monkeypatch.setattr(notices, "announce_compilation", lambda: None)
    monkeypatch.setenv("COLUMNS", "200")
    registry.cache_clear()
    yield lambda *arguments: Result(run([*arguments]), *capsys.readouterr())
    registry.cache_clear()


@pytest.fixture
def samplekit_with(installed):
    """Run ``python -m MODULE ARGUMENTS`` where the faulty plugins are installed."""

    def run(*arguments, timeout=120, cwd=None):
        path = os.pathsep.join([str(installed), str(STRANGERS)])
        environment = {**os.environ, "PYTHONPATH": path, "COLUMNS": "200", "TERM": "dumb"}
        return subprocess.run(
            [sys.executable, "-m", *arguments],
            capture_output=True,
            text=True,
            timeout=timeout,
            env=environment,
            cwd=cwd,
            check=False,
        )

    return run
