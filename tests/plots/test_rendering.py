"""Pictures of renderings: the numbers of the result, in the colours of its files."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import samplekit
from samplekit import UsageError
from samplekit.files import read_png
from samplekit.files._images.diverging import colours
from samplekit.files._images.png import RESERVED, encode_srgb


@pytest.fixture(scope="module")
def rendering():
    return samplekit.render("zoneplate:k=100", "jittered", 4, size=(12, 8), seed=3)


def test_image_reference_and_error_stand_side_by_side(rendering, drawn):
    display = rendering.plot()
    assert [ax.get_title() for ax in display.axes_] == ["image", "reference", "error"]
    image, reference, error = (ax.images[0].get_array() for ax in display.axes_)
    assert np.array_equal(image, encode_srgb(rendering.image))
    assert np.array_equal(reference, encode_srgb(rendering.reference))
    assert np.array_equal(error, rendering.error)
    texts = drawn(display.figure_)
    assert "zoneplate:k=100, jittered, 4 spp" in texts
    assert f"12 x 8 pixels, seed 3; rmse {rendering.metrics['rmse']:.3g}" in texts


def test_x_goes_to_the_right_and_y_down_in_pixels_of_the_whole_image():
    part = samplekit.render("disk", "random", 1, size=(20, 10), crop=(4, 2, 6, 5))
    ax = part.plot("image").ax_
    assert ax.get_xlim() == (4.0, 10.0)
    assert ax.get_ylim() == (7.0, 2.0)


def test_the_pixels_of_the_file_are_those_of_the_rendering(rendering, tmp_path):
    display = rendering.plot("error", scale=0.25)
    display.save(tmp_path / "a.png")
    pixels, _ = read_png(tmp_path / "a.png")
    box = display.ax_.bbox
    top = pixels.shape[0] - round(box.y1)
    side = round(box.width) // 12
    assert side * 12 == round(box.width)
    middle = pixels[top + side // 2 : top + 8 * side : side, round(box.x0) + side // 2 : round(box.x1) : side]
    assert np.abs(middle.astype(int) - colours(rendering.error, 0.25)).max() <= 3
    # Each is a square of one colour.
    square = pixels[top + 3 * side : top + 4 * side, round(box.x0) + 5 * side : round(box.x0) + 6 * side]
    assert (square == square[0, 0]).all()


def test_the_scale_of_the_error_is_rounded_up_or_chosen(rendering):
    largest = np.abs(rendering.error).max()
    image = rendering.plot("error").ax_.images[0]
    assert largest <= image.norm.vmax == -image.norm.vmin < 2.5 * largest
    assert rendering.plot("error", scale=0.125).ax_.images[0].get_clim() == (-0.125, 0.125)


def test_pixels_that_are_not_finite_are_magenta(tmp_path):
    result = samplekit.render("power", "sobol", 4, size=(8, 8))
    assert not np.isfinite(result.image).all()
    result.plot().save(tmp_path / "a.png")
    assert (read_png(tmp_path / "a.png")[0] == RESERVED).all(axis=2).any()


def test_an_exact_image_has_a_scale_all_the_same(drawn):
    display = samplekit.render("disk:radius=0", "random", 1, size=(8, 8)).plot("error")
    assert display.ax_.images[0].get_clim() == (-1.0, 1.0)
    drawn(display.figure_)


def test_without_a_reference_there_is_the_image(drawn):
    result = samplekit.render("disk", "random", 1, size=(300, 8), error=False)
    assert [ax.get_title() for ax in result.plot().axes_] == ["image"]
    with pytest.raises(UsageError, match="no error: it was made without"):
        result.plot("error")


def test_on_axes_of_the_caller(rendering):
    axes = Figure().subplots(1, 3)
    assert rendering.plot(axes=axes).axes_ == list(axes)
    assert rendering.plot("reference", ax=axes[0]).ax_ is axes[0]
    with pytest.raises(UsageError, match="axes=3 axes, not 1"):
        rendering.plot(ax=axes[0])


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan"), float("inf")])
def test_refusals(rendering, scale):
    with pytest.raises(UsageError, match="scale"):
        rendering.plot("error", scale=scale)
    with pytest.raises(UsageError, match="expected image, reference or error"):
        rendering.plot("errors")
