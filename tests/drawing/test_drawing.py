"""What is drawn covers the area that it has, in pixels and as SVG."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from samplekit._drawing.drawing import Band, Disks, Drawing, Line, Text, label, round_ticks
from samplekit._drawing.raster import draw_pixels
from samplekit._drawing.vector import svg_text


def covered(drawing: Drawing, scale: int = 1) -> float:
    """Area that is black, in units."""
    return float((1.0 - draw_pixels(drawing, scale)[..., 0] / 255.0).sum()) / scale**2


def test_disk_has_its_area():
    drawing = Drawing(40, 30, "disk")
    drawing.add(Disks(np.array([[20.3, 14.6]]), 9.0, "#000000"))
    assert covered(drawing) == pytest.approx(81 * math.pi, rel=0.01)
    assert covered(drawing, 3) == pytest.approx(81 * math.pi, rel=0.01)


def test_disks_beyond_the_edge_are_cut():
    drawing = Drawing(40, 30, "disks")
    drawing.add(Disks(np.array([[0.0, 0.0], [-50.0, 3.0], [40.0, 30.0]]), 8.0, "#000000"))
    assert covered(drawing) == pytest.approx(32 * math.pi, rel=0.02)


def test_line_and_band_have_their_areas():
    drawing = Drawing(40, 30, "line")
    drawing.add(Line(np.array([[5.0, 4.0], [35.0, 24.0]]), "#000000", 3.0))
    assert covered(drawing) == pytest.approx(3 * math.hypot(30, 20) + math.pi * 1.5**2, rel=0.02)
    drawing = Drawing(40, 30, "band")
    x = np.array([4.0, 36.0])
    drawing.add(Band(x, np.array([5.0, 10.0]), np.array([20.0, 20.0]), "#000000"))
    assert covered(drawing) == pytest.approx(32 * 12.5, rel=0.01)


def test_svg_has_every_item_and_escapes_text():
    drawing = Drawing(40, 30, "a < b & 'c'")
    drawing.add(Text("<script>", 3, 9), Disks(np.array([[1.0, 2.0], [3.0, 4.0]]), 1.5))
    root = ET.fromstring(svg_text(drawing, {"sampler": "x]]>"}))
    names = [element.tag.rpartition("}")[2] for element in root.iter()]
    assert names.count("circle") == 2
    assert "script" not in names
    assert root[0].text == "a < b & 'c'"


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-3.2, 17.0), (1e-9, 3e-9), (5.0, 5.0)])
def test_ticks_are_round_and_within(low, high):
    ticks = round_ticks(low, high)
    assert 1 <= len(ticks) <= 7
    assert all(low - 1e-12 <= tick <= high + 1e-12 for tick in ticks)
    assert all(float(label(tick)) == pytest.approx(tick, abs=1e-12) for tick in ticks)
