"""Options that plugins add to commands."""

import pytest

SMALL = ("render", "--sampler", "regular", "--spp", "4", "--size", "8", "--scene", "disk")


@pytest.fixture
def peaks(plugins):
    """A plugin that adds a flag and a value to render."""
    plugins.add(
        "peaks",
        """
        from samplekit import CommandOption

        @hookimpl
        def samplekit_options():
            return [
                CommandOption("peak", "peaks_code:peak", "Report the largest pixel.", command="render", default=False),
                CommandOption("above", "peaks_code:above", "Count pixels above VALUE.", command="render", default=0.5),
            ]
        """,
    )
    plugins.module(
        "peaks_code",
        """
        def peak(rendering, value):
            return {"peak": float(rendering.image.max())}

        def above(rendering, value):
            return {"pixels_above": int((rendering.image > value).sum())}
        """,
    )
    return plugins


def test_an_option_sees_the_result_and_adds_to_the_report(command, peaks):
    done = command(*SMALL, "--peak", "--above", "0.9", "--json")
    assert done.status == 0
    assert done.report["peak"] == 1.0
    assert 0 < done.report["pixels_above"] < 64


def test_an_option_adds_lines_to_the_table(command, peaks):
    assert "  peak            1.0" in command(*SMALL, "--peak").out
    assert "peak" not in command(*SMALL).out


def test_help_lists_the_options_of_plugins(command, peaks):
    text = command("render", "--help").out
    assert "--peak" in text
    assert "Count pixels above VALUE." in text
    assert "--peak" not in command("compare", "--help").out


def test_a_wrong_value_and_an_unknown_option_are_one_line(command, peaks):
    wrong = command(*SMALL, "--above", "high")
    assert (wrong.status, wrong.error) == (2, "option above=high: expected a number, finite")
    assert command(*SMALL, "--pike").status == 2


def test_an_option_that_fails_names_its_plugin(command, peaks):
    peaks.module("peaks_code", "def peak(rendering, value):\n    return 1 / 0\n")
    done = command(*SMALL, "--peak")
    assert done.status == 1
    assert "option --peak of plugin peaks (peaks-distribution 1.0) failed: ZeroDivisionError" in done.error
