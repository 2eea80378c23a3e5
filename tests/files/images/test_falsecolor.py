import sys
from fractions import Fraction

import numpy as np
import pytest
from skimage.color import rgb2lab

from samplekit._errors import UsageError
from samplekit.files._images.diverging import STEPS, table
from samplekit.files._images.falsecolor import enlargement, error_picture, rounded_up
from samplekit.files._images.legend import BACKGROUND, number
from samplekit.files._images.lettering import fitted, printable, width
from samplekit.files._images.png import RESERVED

# Full colour vision deficiencies, on linear RGB (Machado, Oliveira, Fernandes 2009).
DEFICIENCIES = {
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
}


def picture_of(pixels, height, width, factor=1):
    """The picture without its strip and margin, not enlarged."""
    picture = pixels[: height * factor, : width * factor]
    assert np.array_equal(picture, picture[::factor, ::factor].repeat(factor, 0).repeat(factor, 1))
    return picture[::factor, ::factor]


def test_the_map_is_even_and_symmetric_to_the_eye():
    lab = rgb2lab(table()[None] / 255.0)[0]
    assert table()[STEPS].tolist() == [255, 255, 255]
    assert np.abs(lab[:, 0] - lab[::-1, 0]).max() < 1.0  # as dark for -e as for e
    for half in (lab[STEPS::-1], lab[STEPS:]):
        away = np.linalg.norm(half - half[0], axis=1)
        assert np.abs(away / away[-1] - np.linspace(0, 1, STEPS + 1)).max() < 0.02
    assert lab[0, 2] < -40 < 40 < lab[-1, 2]  # blue, and red with yellow in it


def test_blue_is_below_and_red_above():
    red, blue = table()[:, 0].astype(int), table()[:, 2].astype(int)
    assert (blue[: STEPS - 5] > red[: STEPS - 5]).all()
    assert (red[STEPS + 6 :] > blue[STEPS + 6 :]).all()


@pytest.mark.parametrize("kind", DEFICIENCIES)
def test_signs_differ_for_the_colour_blind(kind):
    srgb = table() / 255.0
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ np.array(DEFICIENCIES[kind]).T, 0, 1)
    lab = rgb2lab(np.where(seen <= 0.0031308, 12.92 * seen, 1.055 * seen ** (1 / 2.4) - 0.055)[None])[0]
    apart = np.linalg.norm(lab - lab[::-1], axis=1)
    assert apart[0] > 60
    assert apart[STEPS // 2] > 30


def test_no_error_has_the_reserved_colour():
    assert np.abs(table().astype(int) - RESERVED).sum(axis=1).min() > 150


@pytest.mark.parametrize(
    ("value", "scale"),
    [
        (0.0, 0.0),
        (1.0, 1.0),
        (1.0000001, 2.0),
        (0.1, 0.1),
        (0.3, 0.5),
        (0.5, 0.5),
        (0.50001, 1.0),
        (2.0, 2.0),
        (9.99, 10.0),
        (1e-7, 1e-7),
        (1.1e-7, 2e-7),
        (3e-300, 5e-300),
        (5e-324, 5e-324),
        (1e308, 1e308),
        (1.7e308, sys.float_info.max),
    ],
)
def test_scale_is_rounded_up(value, scale):
    assert rounded_up(value) == scale
    assert error_picture([[value, -value]])[1] == scale
    assert error_picture([[-value, value]])[1] == scale


def test_scale_is_the_least_of_its_kind():
    for value in np.exp(np.random.default_rng(0).uniform(-700, 700, 2000)):
        scale = rounded_up(float(value))
        assert scale >= value
        assert Fraction(scale) / Fraction(float(value)) < Fraction(5, 2) * (1 + Fraction(1, 10**12))
        assert f"{scale:e}"[0] in "125"


def test_colours_of_errors():
    error = np.array([[-0.5, -0.25, 0.0, 0.25, 0.5, 0.1]])
    pixels, scale = error_picture(np.repeat(error, 50, axis=1))  # wide enough not to be enlarged
    assert scale == 0.5
    expected = table()[[0, STEPS - 128, STEPS, STEPS + 128, 2 * STEPS, STEPS + 51]]
    assert picture_of(pixels, 1, 300)[0, ::50].tolist() == expected.tolist()


def test_a_given_scale_clamps():
    pixels, scale = error_picture(np.full((1, 200), 7.0), scale=0.1)
    assert scale == 0.1
    assert (picture_of(pixels, 1, 200) == table()[-1]).all()
    pixels, scale = error_picture(np.full((1, 200), 1e300), scale=1e-300)
    assert (picture_of(pixels, 1, 200) == table()[-1]).all()


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan"), float("inf")])
def test_scales_that_cannot_be(scale):
    with pytest.raises(UsageError, match="scale"):
        error_picture([[1.0]], scale=scale)


def test_pixels_that_are_not_finite():
    error = np.full((2, 200), 0.25)
    error[0, 0], error[0, 1], error[1, 5] = np.nan, np.inf, -np.inf
    pixels, scale = error_picture(error)
    assert scale == 0.5
    reserved = (picture_of(pixels, 2, 200) == RESERVED).all(axis=2)
    assert np.array_equal(reserved, ~np.isfinite(error))
    assert (pixels[2:] == RESERVED).all(axis=2).sum() > 50  # a swatch that explains it
    pixels, _ = error_picture(np.full((2, 200), 0.25))
    assert not (pixels == RESERVED).all(axis=2).any()


def test_no_error_at_all():
    pixels, scale = error_picture(np.zeros((3, 200)))
    assert scale == 0.0
    assert (picture_of(pixels, 3, 200) == 255).all()
    assert len(np.unique(pixels[3:].reshape(-1, 3), axis=0)) > 5  # says so
    pixels, scale = error_picture(np.full((3, 200), np.nan))
    assert scale == 0.0
    assert (picture_of(pixels, 3, 200) == RESERVED).all()
    assert error_picture(np.zeros((3, 200)), scale=0.5)[1] == 0.5


def test_colour_errors_show_the_strongest_channel():
    error = np.zeros((1, 200, 3))
    error[0, :, 0], error[0, :, 2] = 0.25, -0.5
    error[0, 7, 1] = np.nan
    pixels, scale = error_picture(error)
    assert scale == 0.5
    picture = picture_of(pixels, 1, 200)[0]
    assert (np.delete(picture, 7, axis=0) == table()[0]).all()
    assert tuple(picture[7]) == RESERVED


@pytest.mark.parametrize(
    ("width", "height", "factor"),
    [
        (1, 1, 256),
        (2, 3, 128),
        (100, 100, 3),
        (191, 5, 2),
        (192, 5, 1),
        (256, 1, 1),
        (4000, 9, 1),
        (1, 9000, 1),
        (1, 100, 40),
    ],
)
def test_small_images_are_enlarged(width, height, factor):
    assert enlargement(width, height) == factor
    error = np.random.default_rng(0).normal(size=(height, width))
    pixels, scale = error_picture(error)
    room = max(256, width * factor)
    assert pixels.shape[1] == room
    assert pixels.dtype == np.uint8
    picture = picture_of(pixels, height, width, factor)
    expected = table()[np.rint(error / scale * STEPS).astype(int) + STEPS]
    assert np.array_equal(picture, expected)
    assert (pixels[: height * factor, width * factor :] == BACKGROUND).all()


@pytest.mark.parametrize("width", [1, 2, 17, 100, 191, 192, 255, 256, 333, 512, 1000, 2500])
@pytest.mark.parametrize("scale", [1.0, 2e-5, 1e-300])
def test_the_strip_has_a_bar_and_labels(width, scale):
    error = np.linspace(-scale, scale, max(width, 2))[None, :width]
    pixels, _ = error_picture(error, title="title " * 40)
    strip = pixels[enlargement(width, 1) :]
    colours = [len(np.unique(row, axis=0)) for row in strip]
    bar = int(np.argmax(colours))
    assert colours[bar] > 150  # a row of the bar has the whole map
    row = strip[bar].astype(int)
    inside = np.flatnonzero((row != BACKGROUND).any(axis=1))
    assert row[inside[0]].tolist() == table()[0].tolist()
    assert row[inside[-1]].tolist() == table()[-1].tolist()
    below = strip[bar + 1 :]
    bright = np.flatnonzero((below > 200).all(axis=(2)).any(axis=0))
    assert bright.min() < 0.1 * strip.shape[1]  # labels at both ends
    assert bright.max() > 0.9 * strip.shape[1]
    assert (strip[:, :3] == BACKGROUND).all()  # nothing runs over the edge
    assert (strip[:, -3:] == BACKGROUND).all()


def test_letters_grow_with_the_image():
    heights = [len(error_picture(np.ones((1, side)))[0]) for side in (256, 1024, 4096)]
    assert heights[0] < heights[1] < heights[2] / 3


def test_the_strip_states_the_scale_the_title_and_the_enlargement():
    base = error_picture(np.ones((10, 200)))[0]
    for other in (
        error_picture(np.full((10, 200), 2.0))[0],
        error_picture(np.ones((10, 200)), title="title")[0],
        error_picture(np.ones((10, 200)), scale=0.5)[0],
    ):
        assert not np.array_equal(base[10:], other[10:])
    assert np.array_equal(error_picture(np.ones((10, 200)))[0], base)


def test_numbers_on_labels():
    values = (1.0, 0.05, -0.025, 2e-5, -2.5e-6, 1e300, 5e5, 0.0001)
    assert [number(value) for value in values] == ["1", "0.05", "-0.025", "2e-5", "-2.5e-6", "1e300", "5e5", "0.0001"]


def test_text_that_the_font_has_no_letters_for():
    assert printable("a\nb\t漢 ±ü\x07") == "a b ?? ±ü?".replace("??", "?")
    assert width("", 13) == 0
    assert width("mm", 13) > width("m", 13)
    assert fitted("short", 13, 200) == "short"
    cut = fitted("a very long title " * 20, 13, 200)
    assert cut.endswith("...")
    assert width(cut, 13) <= 200
