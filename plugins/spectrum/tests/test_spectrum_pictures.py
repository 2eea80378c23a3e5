"""Pictures of spectra: the numbers in greys on the stated scale, what is beyond it, names that lie on no curve."""

import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from samplekit_spectrum import power
from samplekit_spectrum.error_image import error_spectrum
from samplekit_spectrum.map_display import BEYOND, MISSING, Map, MapDisplay
from samplekit_spectrum.radial import Radial
from samplekit_spectrum.radial_display import RadialDisplay
from samplekit_spectrum.spectrum import powers

from samplekit import UsageError
from samplekit.files import read_png


def texts_of(figure):
    return [text.get_text() for text in figure.texts]


def map_of(values):
    return Map((0, 0), np.asarray(values), "", ("x", "y"), (-1.0, 1.0, 1.0, -1.0), [0.0])


def test_the_map_holds_n_times_the_power_without_dc():
    spectrum = power("jittered", 64, realizations=5, max_frequency=8, seed=2)
    ax = spectrum.plot().ax_
    shown = ax.images[0].get_array()
    expected = spectrum.normalized
    assert np.ma.is_masked(shown[8, 8])
    assert shown.mask.sum() == 1
    shown.mask[8, 8] = False
    assert np.array_equal(np.delete(shown.data.ravel(), 144), np.delete(expected.ravel(), 144))
    # Frequency 0 in the middle of its square, x to the right and y down.
    assert ax.get_xlim() == (-8.5, 8.5)
    assert ax.get_ylim() == (8.5, -8.5)
    assert ax.get_xticks().tolist() == ax.get_yticks().tolist() == [-8.0, 0.0, 8.0]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("frequency along $x_{0}$", "frequency along $x_{1}$")


def test_greys_are_proportional_and_what_is_beyond_or_missing_has_its_own_colour():
    display = MapDisplay([map_of([[0.0, 1.0, 2.0, 2.1, np.nan]])], "", "").plot()
    image = display.ax_.images[0]
    colours = image.to_rgba(image.get_array())[0]
    assert colours[:3, 0] == pytest.approx([0.0, 0.5, 1.0], abs=1 / 255)
    assert (colours[:3, :3] == colours[:3, :1]).all()
    assert colours[3] == pytest.approx(to_rgba(BEYOND))
    assert colours[4] == pytest.approx(to_rgba(MISSING))


def test_the_pixels_of_the_file_are_squares_of_these_greys(tmp_path):
    display = power("random", 16, realizations=3, max_frequency=5).plot()
    display.save(tmp_path / "a.png")
    pixels, _ = read_png(tmp_path / "a.png")
    box, image = display.ax_.bbox, display.ax_.images[0]
    side = round(box.width) // 11
    assert side * 11 == round(box.width) == round(box.height)
    expected = image.to_rgba(image.get_array(), bytes=True)[..., :3]
    left, top = round(box.x0), pixels.shape[0] - round(box.y1)
    for row in range(11):
        for column in range(11):
            square = pixels[top + row * side :, left + column * side :][2 : side - 2, 2 : side - 2]
            assert (square == expected[row, column]).all()


def test_the_facts_leave_out_dc():
    spectrum = power("regular", 16, max_frequency=6)
    display = spectrum.plot()
    # The comb: 16 at the eight neighbours of DC, (0, +-4), (+-4, 0), (+-4, +-4).
    assert display.facts == {"scale": 2.0, "largest": pytest.approx(16.0), "beyond": 8, "reduced": 1}
    assert texts_of(display.figure_) == [
        "regular, 16 points",
        "one set: it is not random",
        "white noise is 1; largest 16; 8 frequencies beyond the scale (orange)",
        "DC, which is N, is left out (blue)",
    ]
    assert spectrum.plot(scale=20.0).facts["beyond"] == 0


def test_large_maps_show_means_of_blocks_and_say_so():
    values = np.arange(2000.0 * 1500).reshape(1500, 2000)
    values[0, 0] = np.nan
    display = MapDisplay([map_of(values)], "", "").plot()
    assert display.facts["reduced"] == 2
    assert "each pixel is the mean of 2 x 2 frequencies" in texts_of(display.figure_)
    shown = display.ax_.images[0].get_array()
    assert shown.shape == (750, 1000)
    assert shown[3, 5] == values[6:8, 10:12].mean()
    assert shown[0, 0] == values[:2, :2].ravel()[1:].mean()


@pytest.mark.parametrize("reach", [8, 64])
def test_all_pairs_stand_in_a_triangle(reach):
    pairs = [(0, 1), (0, 2), (1, 2)]
    spectra = powers("random", 16, pairs, realizations=2, max_frequency=reach, dims=3)
    display = MapDisplay.from_spectra(spectra).plot()
    places = [ax.get_position() for ax in display.axes_]
    assert places[0].x0 == places[1].x0 < places[2].x0
    assert places[0].y0 > places[1].y0 == places[2].y0
    assert [ax.get_xlabel()[-6:] for ax in display.axes_] == ["$x_{0}$"[-6:], "$x_{0}$"[-6:], "$x_{1}$"[-6:]]
    for ax, spectrum in zip(display.axes_, spectra, strict=True):
        assert ax.images[0].get_array()[0, 0] == spectrum.normalized[0, 0]


def test_three_dimensions_are_slices():
    spectrum = power("random", 27, realizations=2, max_frequency=4, dims=3)
    display = spectrum.plot()
    assert [ax.get_title() for ax in display.axes_] == [f"frequency {z} along $x_{{2}}$" for z in (0, 1, 2, 4)]
    assert np.array_equal(display.axes_[3].images[0].get_array(), spectrum.normalized[8])


def test_the_radial_mean_is_a_curve_with_its_interval():
    spectrum = power("jittered", 64, realizations=9, max_frequency=16)
    display = spectrum.plot_radial()
    radial = spectrum.radial
    curve = next(line for line in display.ax_.lines if len(line.get_xdata()) == 16)
    assert np.array_equal(curve.get_xdata(), radial.frequency)
    assert np.array_equal(curve.get_ydata(), 64 * radial.power)
    edges = display.ax_.collections[0].get_paths()[0].vertices[:, 1]
    # 3.3554 is the quantile of Student's t at 99.5 % for 9 realisations.
    assert edges.max() == pytest.approx((64 * (radial.power + 3.3554 * radial.standard_error)).max(), rel=1e-4)
    lower = display.axes_[1]
    curve = next(line for line in lower.lines if len(line.get_xdata()) == 16)
    assert np.array_equal(curve.get_ydata(), radial.anisotropy)
    assert display.ax_.get_xlim() == lower.get_xlim() == (0.0, 16.0)
    assert texts_of(display.figure_)[1] == "mean of 9 realizations; mean over rings, band: 99 % interval"
    assert [text.get_text() for text in display.ax_.texts] == ["$N^{1/2}$", "white noise"]
    assert "isotropic,\n9 realizations:\n\N{MINUS SIGN}9.54 dB" in [text.get_text() for text in lower.texts]


@pytest.mark.parametrize("level", [0.95, 1.0, 1.05])
def test_names_of_levels_stand_outside_of_the_axes(level):
    x = np.arange(1.0, 41.0)
    flat = Radial(x, np.ones(40, np.int64), np.full(40, level), np.zeros(40), np.zeros(40))
    display = RadialDisplay(flat, 1.0, title="", condition="", marks=[(20.0, "N")], realizations=1).plot()
    renderer = FigureCanvasAgg(display.figure_).get_renderer()
    for ax in display.axes_:
        for text in ax.texts:
            box = text.get_window_extent(renderer)
            assert box.x0 > ax.bbox.x1 or box.y0 > ax.bbox.y1
            assert box.x1 < display.figure_.bbox.x1
            assert box.y1 < display.figure_.bbox.y1


def test_one_dimension_and_one_ring():
    display = power("jittered", 16, realizations=2, max_frequency=8, dims=1).plot()
    assert isinstance(display, RadialDisplay)
    single = power("random", 16, realizations=1, max_frequency=1).plot_radial()
    assert any(line.get_marker() == "o" for line in single.ax_.lines)
    assert "band" not in texts_of(single.figure_)[1]


def test_the_spectrum_of_an_error():
    found = error_spectrum(np.random.default_rng(3).random((32, 48)))
    display = found.plot()
    ax = display.ax_
    shown = ax.images[0].get_array()
    assert np.ma.is_masked(shown[16, 24])
    assert np.array_equal(shown[:16], found.power[:16])
    # The square of frequency 0 is in the middle of 0.
    left, right, lower, upper = ax.images[0].get_extent()
    assert left + 24.5 * (right - left) / 48 == pytest.approx(0.0, abs=1e-15)
    assert upper + 16.5 * (lower - upper) / 32 == pytest.approx(0.0, abs=1e-15)
    assert ax.bbox.width == pytest.approx(1.5 * ax.bbox.height)
    assert texts_of(display.figure_)[0] == f"spectrum of an error: {found.verdict}"
    assert found.plot_radial(title="mine").figure_.texts[0].get_text() == "mine"


def test_on_axes_of_the_caller():
    spectrum = power("random", 16, realizations=2, max_frequency=4)
    axes = Figure().subplots(1, 3)
    assert spectrum.plot(axes[0]).ax_ is axes[0]
    assert spectrum.plot_radial(axes[1]).axes_ == [axes[1]]
    assert spectrum.plot_radial(axes=axes[1:]).axes_ == list(axes[1:])
    with pytest.raises(UsageError, match="one axes, not 3"):
        spectrum.plot(axes=axes)


def test_listed_frequencies_have_no_picture():
    listed = power("random", 16, realizations=2, frequencies=[[1.0, 2.0]])
    with pytest.raises(UsageError, match="listed frequencies have no picture"):
        listed.plot()
    with pytest.raises(UsageError, match="no radial mean"):
        listed.plot_radial()


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_files_have_the_same_bytes_and_the_metadata(tmp_path, ending):
    for name in "ab":
        display = power("random", 16, realizations=2, max_frequency=4).plot_radial()
        display.save(tmp_path / f"{name}.{ending}", {"seed": "1"})
    written = (tmp_path / f"a.{ending}").read_bytes()
    assert written == (tmp_path / f"b.{ending}").read_bytes()
    if ending == "svg":
        description = ElementTree.fromstring(written).find(".//{http://purl.org/dc/elements/1.1/}description")
        assert json.loads(description.text) == {"seed": "1"}
