"""Every public name says what it is, with an example that runs."""

import doctest
import inspect

import pytest
import samplekit_spectrum

import samplekit
import samplekit.plots

# The marker of hooks is pluggy's.
NAMES = [(samplekit, name) for name in samplekit.__all__ if name != "hookimpl"] + [
    (samplekit_spectrum, name) for name in samplekit_spectrum.__all__
]
NAMES += [(samplekit.plots, name) for name in samplekit.plots.__all__ if callable(getattr(samplekit.plots, name))]


@pytest.mark.parametrize(("module", "name"), NAMES, ids=[name for _, name in NAMES])
def test_example_runs(module, name):
    thing = getattr(module, name)
    text = inspect.getdoc(thing) or ""
    assert ">>>" in text, f"{name} has no example"
    example = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    printed = []
    runner.run(example, out=printed.append)
    assert not runner.failures, "".join(printed)
