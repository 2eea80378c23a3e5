"""The course's plate of each sampler: its points, its expected power spectrum, and the spectrum's radial mean."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit._drawing.axis import Axis
from samplekit._drawing.chart import Chart
from samplekit._drawing.drawing import Bitmap, Disks, Drawing, Text
from samplekit._drawing.series import style
from samplekit._gallery.figure import Figure
from samplekit._gallery.sheet import enlarged_pixels

if TYPE_CHECKING:
    from numpy.typing import NDArray

CHAPTER = "Samplers: points, expected power spectrum, radial mean"
COUNT, REALIZATIONS, REACH = 256, 400, 64
WHITE = 2.0
_SIDE, _TOP, _LEFT, _GAP = 258, 62, 20, 30

SAMPLERS = {
    "random": "White noise: the spectrum is flat.",
    "regular": "A comb: all power in single frequencies, where the grid aliases.",
    "jittered": "Dark in the centre: the power rises as the square of the frequency.",
    "n-rooks": "Dark on the axes alone: one point in each row and column helps functions of one coordinate.",
    "multi-jittered": "Both at once: a dark centre and a dark cross.",
    "correlated-multi-jittered": "The same strata, one shuffle for all rows: darker in the centre, with structure.",
    "poisson-disk": "A ring at the distance that the points keep; within it a plateau that does not vanish.",
    "lloyd": "Relaxed points: a sharp ring, the beginning of a crystal.",
    "ccvt": "Blue noise: no power at low frequencies, which rises as the fourth power of the frequency.",
    "halton": "Not random: one fixed pattern, dark in the centre and along the axes.",
    "hammersley": "Not random: bars of power, and wide darkness between them.",
    "halton+owen": "Scrambled in both bases: the pattern has gone, the dark centre and the dark axes stay.",
    "sobol": "Not random: a self-similar pattern of peaks.",
    "sobol+xor": "A random digital shift moves no power: the pattern of peaks stays.",
    "sobol+owen": "Scrambled: even noise around a dark cross whose arms narrow outwards.",
    "pmj02": "Progressive, and as well stratified: the spectrum of the scrambled Sobol points.",
    "r2": "A lattice: few strong peaks, none of them near the centre.",
}


def plate(name: str) -> Drawing:
    """The three panels of a sampler."""
    from samplekit_spectrum import power

    sampler = samplekit.sampler(name)
    randomized = sampler.spec.randomized
    spectrum = power(name, COUNT, realizations=REALIZATIONS if randomized else 1, max_frequency=REACH)
    drawing = Drawing(3 * _SIDE + 4 * _GAP + 60, _TOP + _SIDE + 46, name)
    drawing.add(Text(f"{name}, {COUNT} points", _LEFT, 30, 17))
    _points(drawing, samplekit.points(name, COUNT)[0], _LEFT)
    _map(drawing, spectrum.normalized, _LEFT + _SIDE + _GAP)
    left = _LEFT + 2 * (_SIDE + _GAP) + 34
    chart = Chart(drawing, left, _TOP, left + _SIDE, _TOP + _SIDE, Axis(0, REACH, "frequency"), Axis(0, 3.0))
    chart.grid()
    chart.level(1.0, "white noise")
    radial = spectrum.radial
    chart.curve(radial.frequency, np.minimum(COUNT * radial.power, 3.0), style(1), marked=False)
    sets = f"mean of {REALIZATIONS} sets" if randomized else "one set: it is not random"
    for x, words in ((_LEFT, "points"), (_LEFT + _SIDE + _GAP, f"N times the power, {sets}"), (left, "radial mean")):
        drawing.add(Text(words, x, _TOP - 8, 12))
    drawing.add(Text(f"frequencies to {REACH}; white: {WHITE:g} and more", _LEFT + _SIDE + _GAP, _TOP + _SIDE + 18, 12))
    return drawing


def _points(drawing: Drawing, points: NDArray[np.float64], left: int) -> None:
    drawing.frame(left, _TOP, left + _SIDE, _TOP + _SIDE)
    drawing.add(Disks(np.array([left, _TOP]) + _SIDE * points, 2.2, "#1f2937"))


def _map(drawing: Drawing, power: NDArray[np.float64], left: int) -> None:
    levels = np.rint(255.0 * np.clip(power / WHITE, 0.0, 1.0)).astype(np.uint8)
    levels[REACH, REACH] = 0
    pixels = enlarged_pixels(np.repeat(levels[..., None], 3, axis=2), 2)
    drawing.add(Bitmap(pixels, left, _TOP))
    drawing.frame(left - 1, _TOP - 1, left + _SIDE, _TOP + _SIDE)


FIGURES = [
    Figure(
        f"sampler-{name.replace('+', '-')}",
        name,
        caption,
        f"samplekit spectrum --sampler {name} --count {COUNT} --realizations {REALIZATIONS} --max-frequency {REACH}",
        partial(plate, name),
        ("samplekit-spectrum",)
        + (("samplekit-bluenoise",) if name in ("poisson-disk", "lloyd", "ccvt") else ())
        + (("samplekit-lattice",) if name == "r2" else ()),
        CHAPTER,
    )
    for name, caption in SAMPLERS.items()
]
