"""What the README shows is run: every command and every line of Python, and the pictures it links are there."""

import re
import shlex
from pathlib import Path

import pytest

from samplekit._cli import run

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = [
    line
    for block in re.findall(r"```sh\n(.*?)```", TEXT, re.DOTALL)
    for line in block.splitlines()
    if line.startswith("samplekit ")
]


def test_the_commands_are_found():
    assert len(COMMANDS) > 8


@pytest.mark.slow
def test_the_commands_work_one_after_the_other(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for command in COMMANDS:
        # The table of the course takes a minute: here it gets by with a handful of trials.
        quick = command.replace("--trials 400", "--trials 4")
        assert run(shlex.split(quick)[1:]) == 0, (command, capsys.readouterr().err)
    assert (tmp_path / "zoneplate-hammersley-16spp.error.png").exists()


@pytest.mark.parametrize("block", re.findall(r"```python\n(import samplekit.*?)```", TEXT, re.DOTALL))
def test_the_python_works(block):
    exec(compile(block, "README.md", "exec"), {})


@pytest.mark.parametrize("link", re.findall(r"\]\(([^)#:]+)\)", TEXT))
def test_what_is_linked_is_there(link):
    assert (ROOT / link).exists()


def test_each_command_that_installs_is_one_line():
    for marker in ("render", "test"):
        block = re.search(rf"<!-- {marker} -->\n```sh\n(.*?)```", TEXT, re.DOTALL)
        assert block is not None
        assert len(block[1].splitlines()) == 1


def test_the_command_that_tests_installs_every_plugin_in_place():
    install = re.search(r"<!-- test -->\n```sh\n(.*?)```", TEXT, re.DOTALL)[1]
    for plugin in (ROOT / "plugins").iterdir():
        if (plugin / "pyproject.toml").exists():
            assert f"-e plugins/{plugin.name}" in install
