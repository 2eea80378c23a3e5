"""The bar on a terminal: there while something is done, gone when it is done."""

import collections
import contextlib
import itertools
import signal
import sys
import time

import pytest
from numba.core import event

from samplekit._integrate import rendering as renderer
from samplekit.commands._notices import announce_compilation
from samplekit.commands._progress import Progress


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
    assert bar._bar is not None
    bar(2, 2)
    assert bar._bar is None
    bar(1, 2)
    assert bar._bar is not None


def test_an_interrupt_that_was_lost_ends_the_work_all_the_same(command, tmp_path, monkeypatch):
    """Python drops exceptions that are raised within callbacks of its own; this one is dropped here."""

    check = renderer._check_metrics

    def interrupt_and_lose_it(*arguments):
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        check(*arguments)

    with monkeypatch.context() as patched:
        patched.setattr(renderer, "_check_metrics", interrupt_and_lose_it)
        # Whoever runs the tests may have a handler of its own.
        patched.setattr(signal, "getsignal", lambda _: signal.default_int_handler)
        done = command("render", "--sampler", "random", "--spp", "4", "--size", "64")
    assert done == (130, "", "")
    assert list(tmp_path.iterdir()) == []
    # It is forgotten with the command.
    assert command("render", "--sampler", "random", "--spp", "4", "--size", "8").status == 0


def test_compilation_is_announced_once_in_a_process(monkeypatch, capsys):
    monkeypatch.setattr(event, "_registered", collections.defaultdict(list))
    announce_compilation.cache_clear()
    for _ in range(2):
        announce_compilation()
        with event.trigger_event("numba:compile"):
            pass
    assert capsys.readouterr().err.count("compiling kernels") == 1
