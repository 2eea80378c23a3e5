"""The functions of the package: their examples, and that importing it is light."""

import subprocess
import sys

import pytest

import samplekit


def test_importing_samplekit_imports_no_numpy():
    code = "import sys, samplekit; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("name", samplekit.__all__)
def test_every_public_name_is_there_and_documented(name):
    assert getattr(samplekit, name).__doc__


def test_a_name_that_is_not_there():
    with pytest.raises(AttributeError, match="nonsense"):
        samplekit.nonsense  # noqa: B018


def test_every_installed_plugin_is_whole():
    for plugin in samplekit.plugins():
        assert plugin.problems == []


def test_what_the_memory_cannot_hold_is_refused_before_it_is_tried():
    with pytest.raises(samplekit.SamplekitError, match="these points need"):
        samplekit.points("random", 4, realizations=10**15, dims=100)
    with pytest.raises(samplekit.SamplekitError, match="these estimates need"):
        samplekit.estimate("disk", "random", 4, realizations=10**15)
