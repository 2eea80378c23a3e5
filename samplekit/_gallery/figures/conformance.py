"""What a check sees: a net, and the same net with one wrong bit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit import Net, Sampler, SamplerSpec
from samplekit._drawing.drawing import GRID, Bitmap, Disks, Drawing, Text
from samplekit._gallery.figure import Figure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_SIDE, _TOP, _LEFT, _GAP = 288, 78, 20, 40
_CROWDED, _EMPTY = (250, 205, 198), (207, 221, 243)


class WrongBit(Sampler):
    """Sobol points; one constant of the generator matrices has a wrong bit."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write the points, with the bit changed in the second dimension."""
        samplekit.sampler("sobol").fill(out, realizations, count, start)
        if out.shape[1] > 1:
            index = np.arange(start, start + out.shape[2])
            wrong = (index >> 3 & 1).astype(np.uint64) << np.uint64(29)
            out[:, 1] = ((out[:, 1] * 2.0**32).astype(np.uint64) ^ wrong).astype(float) * 2.0**-32


def broken_net() -> Drawing:
    """Sobol points, and those of a matrix with one wrong bit, in the elementary intervals that tell them apart."""
    from samplekit.testing import check_sampler

    spec = SamplerSpec("wrong-bit", f"{__name__}:WrongBit", "Sobol points with one wrong bit", promises=(Net(),))
    (outcome,) = check_sampler(spec, quick=True, only=["elementary-intervals"])
    assert outcome.example is not None
    assert outcome.example.points is not None
    drawing = Drawing(2 * _LEFT + 2 * _SIDE + _GAP, _TOP + _SIDE + 62, "A net, and one with a wrong bit")
    drawing.add(Text("A net, and the same with one wrong bit", _LEFT, 32, 17))
    drawing.add(Text("16 points; each elementary interval must hold one", _LEFT, 52, 13, "left", "#6b7480"))
    _panel(drawing, samplekit.points("sobol", 16)[0], "sobol: conforms", _LEFT)
    _panel(drawing, outcome.example.points, "one constant of a generator matrix changed", _LEFT + _SIDE + _GAP)
    drawing.add(Text("samplekit check:", _LEFT, _TOP + _SIDE + 28, 12, "left", "#6b7480"))
    drawing.add(Text(outcome.message, _LEFT, _TOP + _SIDE + 45, 12))
    return drawing


def _panel(drawing: Drawing, points: NDArray[np.float64], name: str, left: int) -> None:
    """Draw the points over 2 x 8 intervals, shaded where there is not one."""
    cells = np.floor(points * (2, 8)).astype(int)
    width, height = _SIDE // 2, _SIDE // 8
    held = np.zeros((2, 8), int)
    np.add.at(held, (cells[:, 0], cells[:, 1]), 1)
    for column, row in np.argwhere(held != 1):
        shade = np.full((height, width, 3), _CROWDED if held[column, row] else _EMPTY, np.uint8)
        drawing.add(Bitmap(shade, left + int(column) * width, _TOP + int(row) * height))
    for row in range(1, 8):
        drawing.segment(left, _TOP + row * height, left + _SIDE, _TOP + row * height, GRID)
    drawing.segment(left + width, _TOP, left + width, _TOP + _SIDE, GRID)
    drawing.frame(left, _TOP, left + _SIDE, _TOP + _SIDE)
    drawing.add(Text(name, left, _TOP - 7, 12), Disks(np.array([left, _TOP]) + _SIDE * points, 4.0, "#1f2937"))


FIGURES = [
    Figure(
        "net-with-a-wrong-bit",
        "A net with a wrong bit",
        "By eye both look well distributed. The check finds the intervals that hold two points (red) or none (blue), "
        "in the smallest set that shows it.",
        "samplekit check sobol --quick",
        broken_net,
        chapter="Conformance",
    )
]
