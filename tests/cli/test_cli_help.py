"""Help: what options are for, in groups, with an example, on narrow terminals and without colour."""

import os
import re
import subprocess
import sys

import pytest

COMMANDS = ["render", "compare", "points", "check", "list", "info", "new-plugin", "stability"]
COMMANDS += ["spectrum", "predict"]


def help_of(*command, columns=100, **environment):
    # Not in this process: what a terminal is, is found out at the start.
    variables = {**os.environ, "COLUMNS": str(columns), "TERM": "dumb", **environment}
    arguments = [sys.executable, "-m", "samplekit", *command, "--help"]
    result = subprocess.run(arguments, capture_output=True, text=True, env=variables, check=False)
    assert result.returncode == 0, result.stderr
    assert not result.stderr
    return result.stdout


@pytest.mark.parametrize("command", COMMANDS)
def test_help_has_an_example_and_no_noise(command):
    text = help_of(command)
    assert "Example" in text
    assert "<bool>" not in text
    assert "\x1b" not in text


def test_options_stand_in_groups():
    text = help_of("compare")
    what, out, how = (text.rindex(words) for words in ("--sampler", "What comes out", "How it runs"))
    assert what < min(out, how)
    assert text.rindex("--threads") > how
    assert text.rindex("--output") > out


def test_all_commands_are_listed_with_what_they_do():
    text = help_of()
    for command in COMMANDS:
        assert re.search(rf"│ {command} +\w", text), command


def test_narrow_terminal_gets_lines_that_fit():
    assert max(map(len, help_of("render", columns=60).splitlines())) <= 60
