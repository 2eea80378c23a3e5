"""White, blue and red errors are distinguished; unequal pixels alone raise no alarm."""

import numpy as np
import pytest
from samplekit_spectrum.error_image import error_spectrum

from samplekit import SamplekitError, UsageError


def filtered(rng, shape, weight):
    noise = np.fft.fft2(rng.standard_normal(shape))
    radius = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.fftfreq(shape[1]))
    return np.fft.ifft2(noise * weight(radius)).real


@pytest.mark.parametrize(
    ("weight", "verdict"),
    [(lambda f: np.ones_like(f), "white"), (lambda f: f, "blue"), (lambda f: 1.0 / (0.1 + f), "red")],
)
def test_colours(weight, verdict):
    spectrum = error_spectrum(filtered(np.random.default_rng(2), (96, 128), weight))
    assert spectrum.verdict == verdict
    inner = spectrum.power[np.isfinite(spectrum.power)]
    assert inner.mean() == pytest.approx(1.0, abs=1e-12)
    assert np.isnan(spectrum.power[48, 64])
    assert spectrum.radial.frequency[-1] == 0.5


def test_unequal_errors_are_white_and_their_spread_is_known():
    """60 images with errors in one corner alone: the scores of the low frequencies are standard normal."""
    rng = np.random.default_rng(5)
    y, x = np.mgrid[:64, :64]
    size = np.exp(-((x - 20) ** 2 + (y - 30) ** 2) / 300)
    spectra = [error_spectrum(rng.standard_normal((64, 64)) * size) for _ in range(60)]
    scores = np.array([(one.low - 1) / one.low_standard_error for one in spectra])
    assert abs(scores.mean()) < 0.5
    assert 0.6 < scores.std() < 1.3
    assert sum(one.verdict == "white" for one in spectra) >= 59


def test_scale_colour_and_constants():
    rng = np.random.default_rng(1)
    error = rng.standard_normal((40, 40))
    plain = error_spectrum(error)
    for factor in (1e-200, 1e200):
        np.testing.assert_allclose(error_spectrum(error * factor).power, plain.power, rtol=1e-9)
    rgb = error_spectrum(np.repeat(error[:, :, None], 3, axis=2))
    np.testing.assert_allclose(rgb.power, plain.power, rtol=1e-9)
    assert error_spectrum(np.zeros((8, 8))).verdict == "exact"
    assert error_spectrum(np.full((8, 8), 0.25)).bias == 0.25
    assert error_spectrum(error[:4, :4]).verdict == "too small"


def test_what_is_no_error_image_is_refused():
    for wrong in (np.zeros(4), np.zeros((1, 5)), np.zeros((2, 2, 2, 2))):
        with pytest.raises(UsageError):
            error_spectrum(wrong)
    with pytest.raises(SamplekitError, match="finite"):
        error_spectrum(np.full((8, 8), np.nan))
