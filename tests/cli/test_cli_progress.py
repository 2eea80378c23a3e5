"""The bar on a terminal: there while something is done, gone when it is done."""

import itertools
import sys
import time

import pytest

from samplekit.cli.progress import Progress


@pytest.fixture
def bar(monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm")
    with Progress("preparing") as progress:
        clock = itertools.count(time.monotonic() + 5.0)
        monkeypatch.setattr(time, "monotonic", lambda: next(clock))
        yield progress


def test_a_bar_goes_when_all_is_done_and_not_when_the_next_is(bar):
    bar(1, 2)
    assert bar.shown
    bar(2, 2)
    assert not bar.shown
    bar(1, 2)
    assert bar.shown
