"""Heat maps of a sweep: digits of the cells, and why some have none."""

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

import samplekit
from samplekit import UsageError
from samplekit.plots import StabilityDisplay

SAMPLERS = ["random", "hammersley"]


@pytest.fixture(scope="module")
def found():
    return samplekit.stability(["gaussian", "power:a=0.9"], SAMPLERS, [16, 2**12], realizations=4, seed=2)


def maps(display):
    """Sampler and row of maps to the axes."""
    names = [(sampler, lost) for lost in (False, True) for sampler in display.samplers]
    return dict(zip(names, display.axes_, strict=True))


def test_a_sweep_of_one_call(found):
    assert {cell.name for cell in found.cells} == {"gaussian", "power"}
    assert (found.realizations, found.seed) == (4, 2)
    one = samplekit.stability("gaussian:sigma=0.1", "random", [16], realizations=4, seed=2).cells
    assert one == [
        cell for cell in found.cells if (cell.extreme, cell.sampler, cell.count) == ("sigma=0.1", "random", 16)
    ]


def test_colours_and_numbers_are_the_digits_of_the_cells(found):
    display = found.plot("gaussian")
    for (sampler, lost), ax in maps(display).items():
        shown = ax.images[0].get_array()
        texts = [text.get_text() for text in ax.texts]
        cells = [cell for cell in found.cells if cell.name == "gaussian" and cell.sampler == sampler]
        for cell, digits, text in zip(cells, shown.ravel(), texts, strict=True):
            kind = cell.verdict.kind
            expected = cell.measured.digits_lost if lost else cell.measured.digits_right
            if kind in ("no hits", "few hits") and not lost:
                assert np.ma.is_masked(digits)
                assert text == kind
                continue
            assert digits == expected
            mark = {"precision lost": "!", "not random": "="}.get(kind, "")
            assert text == f"{expected:.1f}" + ("" if lost else mark)
        assert ax.images[0].get_clim() == (0.0, 3.0 if lost else 16.0)


def test_axes_name_scales_counts_and_samplers(found, drawn):
    display = found.plot("gaussian")
    texts = drawn(display.figure_)
    assert "gaussian: 4 realisations, seed 2" in texts
    assert {"random", "hammersley", "random: lost", "hammersley: lost", "16", "$2^{12}$"} <= set(texts)
    assert set(display.extremes) <= set(texts)
    assert "digits right" in texts
    # Up: the first extreme, as in the table.
    assert display.axes_[0].get_ylim() == (len(display.extremes) - 0.5, -0.5)
    assert any("every sample missed" in text for text in texts)


def test_cells_without_digits_have_a_colour_and_a_word(drawn):
    display = samplekit.stability("power:a=0.9", ["sobol", "multi-jittered"], [16, 17], realizations=2).plot()
    texts = [text.get_text() for text in display.axes_[0].texts]
    assert texts == ["invalid", "invalid"]
    assert {to_hex(patch.get_facecolor()) for patch in display.axes_[0].patches} == {"#ff00ff"}
    drawn(display.figure_)


def test_refusals(found):
    with pytest.raises(UsageError, match="choose the scene of the heat maps: gaussian, power"):
        found.plot()
    with pytest.raises(UsageError, match="no cells of disk"):
        found.plot("disk")
    missing = samplekit.Stability(found.cells[1:], 4, 2)
    with pytest.raises(UsageError, match="every sampler at every scale"):
        StabilityDisplay(missing, "gaussian")


def test_on_axes_of_the_caller(found):
    axes = Figure().subplots(2, 2)
    assert found.plot("power", axes=axes).axes_ == list(axes.ravel())
    with pytest.raises(UsageError, match="axes=4 axes, not 2"):
        found.plot("power", axes=axes[0])
