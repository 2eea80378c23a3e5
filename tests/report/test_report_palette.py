"""The colours of the samplers, as people with and without a colour vision deficiency see them."""

import itertools
import re
from importlib.resources import files

import numpy as np
import pytest
from skimage.color import deltaE_ciede2000, rgb2lab

STYLE = (files("samplekit._report") / "assets" / "style" / "01_base.css").read_text()
# Machado, Oliveira and Fernandes 2009, table of full severity, for linear RGB.
SEEN = {
    "normal": np.eye(3),
    "protanopia": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deuteranopia": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritanopia": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}


def colours(theme):
    pairs = re.findall(r"--series-\d: light-dark\((#\w{6}), (#\w{6})\)", STYLE)
    assert len(pairs) == 8
    return np.array([[int(pair[theme][at : at + 2], 16) / 255 for at in (1, 3, 5)] for pair in pairs])


def luminance(rgb):
    return float(linear(np.array(rgb)) @ [0.2126, 0.7152, 0.0722])


def linear(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def encoded(linear):
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
@pytest.mark.parametrize("vision", SEEN)
def test_any_two_samplers_have_colours_that_can_be_told_apart(theme, vision):
    lab = rgb2lab(encoded(linear(colours(theme)) @ SEEN[vision].T))
    distances = {
        pair: float(deltaE_ciede2000(lab[pair[0]], lab[pair[1]])) for pair in itertools.combinations(range(8), 2)
    }
    assert min(distances.values()) >= 10.0, min(distances, key=distances.get)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_every_colour_stands_out_from_the_paper(theme):
    hexadecimal = re.search(r"--paper: light-dark\(#(\w{6}), #(\w{6})\)", STYLE)[theme + 1]
    paper = luminance([int(channel, 16) / 255 for channel in re.findall("..", hexadecimal)])
    for colour in colours(theme):
        light, dark = sorted((luminance(colour), paper), reverse=True)
        assert (light + 0.05) / (dark + 0.05) >= 2.5
