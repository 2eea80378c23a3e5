"""Errors of equal size, white and blue: what the eye sees of them depends on their spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit._drawing.axis import Axis
from samplekit._drawing.chart import Chart, legend
from samplekit._drawing.drawing import Bitmap, Drawing, Text
from samplekit._drawing.series import style
from samplekit._gallery.figure import Figure
from samplekit._gallery.sheet import enlarged_pixels
from samplekit.files._images import diverging

if TYPE_CHECKING:
    from numpy.typing import NDArray

SAMPLERS = ("random", "z-sobol:orders=random", "z-sobol")
SCENE, SPP, SIZE = "gaussian:sigma=0.3", 1, 256
_LEFT, _TOP, _GAP, _SHOWN = 20, 78, 16, 128


def error_spectra() -> Drawing:
    """The error image of each sampler, enlarged, its spectrum, and the radial means in one chart."""
    from samplekit_spectrum.error_image import error_spectrum

    side = 2 * _SHOWN
    drawing = Drawing(2 * _LEFT + 3 * side + 2 * _GAP, _TOP + 2 * side + 340, "White and blue error")
    drawing.add(Text("White and blue error", _LEFT, 32, 17))
    line = f"{SCENE}, one sample a pixel. Above: a part of the error image. Below: its power, white is 2 and more."
    drawing.add(Text(line, _LEFT, 52, 13, "left", "#6b7480"))
    top = _TOP + 2 * side + 70
    right = _LEFT + 3 * side + 2 * _GAP
    x, y = Axis(0.0, 0.5, "cycles per pixel"), Axis(0.0, 2.2, "power of the error, mean over rings")
    chart = Chart(drawing, _LEFT + 40, top, right, top + 220, x, y)
    chart.grid()
    entries = []
    for number, name in enumerate(SAMPLERS):
        result = samplekit.render(SCENE, name, SPP, size=(SIZE, SIZE))
        assert result.error is not None
        spectrum = error_spectrum(result.error)
        left = _LEFT + number * (side + _GAP)
        scale = 3.0 * float(np.sqrt(result.metrics["mse"]))
        part = result.error[_SHOWN // 2 : _SHOWN // 2 + _SHOWN, _SHOWN // 2 : _SHOWN // 2 + _SHOWN]
        drawing.add(Text(name, left, _TOP - 6, 12))
        drawing.add(Bitmap(enlarged_pixels(diverging.colours(part, scale), 2), left, _TOP))
        drawing.add(Bitmap(_grey(spectrum.power), left, _TOP + side + 8))
        words = f"mse {result.metrics['mse']:.2e}, blurred {result.metrics['blurred_mse']:.1e}: {spectrum.verdict}"
        drawing.add(Text(words, left, _TOP + 2 * side + 26, 12))
        chart.curve(spectrum.radial.frequency, spectrum.radial.power, style(number), marked=False)
        entries.append((name, style(number)))
    legend(drawing, _LEFT + 60, top + 20, entries)
    return drawing


def _grey(power: NDArray[np.float64]) -> NDArray[np.uint8]:
    # Of a spectrum as large as the image, means of 2 x 2 would blur the axes: each frequency is one pixel.
    levels = np.rint(255.0 * np.clip(np.nan_to_num(power) / 2.0, 0.0, 1.0)).astype(np.uint8)
    return np.repeat(levels[..., None], 3, axis=2)


FIGURES = [
    Figure(
        "error-white-and-blue",
        "White and blue error",
        "Three errors of one size. With random orders of the pixels z-sobol's is blue noise: it has moved to high "
        "frequencies, where a blur no longer sees it. Its own order leaves less after a blur, as a pattern.",
        f"samplekit render --scene {SCENE} --size {SIZE} --spp {SPP} --sampler z-sobol --output blue.exr"
        " && samplekit spectrum --image blue.exr",
        error_spectra,
        ("samplekit-spectrum",),
        "Images",
    )
]
