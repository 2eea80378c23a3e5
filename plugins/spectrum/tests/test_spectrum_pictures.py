"""Pictures and plots of spectra: greys on the stated scale, what is beyond it, names that are not drawn over."""

import numpy as np
import pytest
from samplekit_spectrum import power
from samplekit_spectrum.picture import BEYOND, MISSING, colours, spectrum_picture
from samplekit_spectrum.plot import radial_plot
from samplekit_spectrum.radial import Radial
from samplekit_spectrum.spectrum import powers

from samplekit._drawing.drawing import Text, rgb


def test_greys_are_proportional_and_what_is_beyond_or_missing_has_its_own_colour():
    pixels = colours(np.array([[0.0, 1.0, 2.0, 2.1, np.nan]]), 2.0)[0]
    assert pixels[:3].tolist() == [[0] * 3, [128] * 3, [255] * 3]
    assert tuple(pixels[3]) == rgb(BEYOND)
    assert tuple(pixels[4]) == rgb(MISSING)


def test_the_facts_leave_out_dc():
    pixels, facts = spectrum_picture([power("regular", 16, max_frequency=6)])
    # The comb: 16 at the eight neighbours of DC, (0, +-4), (+-4, 0), (+-4, +-4).
    assert (facts["scale"], facts["largest"], facts["beyond"]) == (2.0, pytest.approx(16.0), 8)
    assert (pixels == np.array(rgb(BEYOND))).all(axis=2).sum() > 0
    assert spectrum_picture([power("regular", 16, max_frequency=6)], scale=20.0)[1]["beyond"] == 0


@pytest.mark.parametrize("reach", [8, 64])
def test_all_pairs_stand_in_a_triangle(reach):
    pairs = [(0, 1), (0, 2), (1, 2)]
    spectra = powers("random", 16, pairs, realizations=2, max_frequency=reach, dims=3)
    pixels, _ = spectrum_picture(spectra)
    single, _ = spectrum_picture(spectra[:1])
    assert pixels.shape[0] > single.shape[0]
    # The upper right is empty: nothing but the ground.
    height, width, _ = pixels.shape
    corner = pixels[100 : height // 2 - 60, width // 2 + 60 : width - 40]
    assert (corner == pixels[0, 0]).all()


@pytest.mark.parametrize("level", [0.95, 1.05])
def test_the_name_of_white_noise_is_not_drawn_over_the_curve(level):
    x = np.arange(1.0, 41.0)
    flat = Radial(x, np.ones(40, np.int64), np.full(40, level), np.zeros(40), np.zeros(40))
    drawing = radial_plot(flat, 1.0, headline="", condition="", marks=[], realizations=1)
    texts = {text.text: text for text in drawing.items if isinstance(text, Text)}
    one = texts["1"].y - 4
    assert (texts["white noise"].y < one) == (level < 1.0)
    assert "isotropic, 1 realization: 0" in texts
