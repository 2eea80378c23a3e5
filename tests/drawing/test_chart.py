"""Where a chart puts values, and what it does with those that it cannot show."""

import numpy as np
import pytest

from samplekit._drawing.axis import Axis, spanning
from samplekit._drawing.chart import Chart, legend
from samplekit._drawing.drawing import Band, Disks, Drawing, Line, Text
from samplekit._drawing.raster import draw_pixels
from samplekit._drawing.series import style
from samplekit._drawing.vector import svg_text


def chart(x: Axis, y: Axis) -> Chart:
    return Chart(Drawing(400, 300, "chart"), 60, 20, 360, 260, x, y)


def lines(made: Chart) -> list[Line]:
    return [item for item in made.drawing.items if isinstance(item, Line)]


def test_linear_and_logarithmic_places():
    assert Axis(-1.0, 3.0).share([-1.0, 1.0, 3.0]) == pytest.approx([0.0, 0.5, 1.0])
    assert Axis(1e-6, 1e2, "mse", 10).share([1e-6, 1e-2, 1e2]) == pytest.approx([0.0, 0.5, 1.0])


def test_ticks_of_a_logarithmic_axis_are_few_and_true():
    assert [text for _, text in Axis(16, 4096, "N", 2).ticks(5)] == ["16", "64", "256", "1024", "4096"]
    ticks = Axis(1e-30, 1e-2, "mse", 10).ticks(6)
    assert len(ticks) <= 6
    assert all(float(text) == pytest.approx(value) for value, text in ticks)


def test_span_ignores_what_cannot_be_drawn():
    axis = spanning([np.nan, 0.0, 1e-3, 10.0, np.inf, -2.0], base=10, room=0.0)
    assert (axis.low, axis.high) == (pytest.approx(1e-3), pytest.approx(10.0))
    assert spanning([], base=10).low < spanning([], base=10).high
    assert spanning([5.0]).low < 5.0 < spanning([5.0]).high


def test_guide_has_its_slope_and_stays_in_the_frame():
    made = chart(Axis(1, 1e4, "N", 10), Axis(1e-4, 1, "mse", 10))
    made.guide(-2.0, 10.0, 0.1)
    (x0, y0), (x1, y1) = lines(made)[-1].points
    # 75 units across and 60 up for each power of ten.
    assert (y1 - y0) / 60 == pytest.approx(2.0 * (x1 - x0) / 75)
    assert y0 >= 20 - 1e-9
    assert y1 <= 260 + 1e-9
    assert made._across(10.0) == pytest.approx(135.0)


def test_curve_has_a_gap_where_there_is_no_value():
    made = chart(Axis(0, 4), Axis(0, 1))
    made.curve([0, 1, 2, 3, 4], [0.1, 0.2, np.nan, 0.5, 7.0], style(0))
    assert [len(line.points) for line in lines(made)] == [2]
    assert [len(item.centres) for item in made.drawing.items if isinstance(item, Disks)] == [2, 1]


def test_intervals_are_cut_at_the_frame():
    made = chart(Axis(1, 100, "N", 10), Axis(1e-2, 1, "mse", 10))
    made.band([1, 10, 100], [0.0, 0.1, np.nan], [0.5, 30.0, 1.0], style(1))
    (band,) = (item for item in made.drawing.items if isinstance(item, Band))
    assert (band.low >= 20 - 1e-9).all()
    assert (band.high <= 260 + 1e-9).all()
    made.whiskers([10.0, 1000.0], [0.0, 0.1], [9.0, 0.2], style(1))
    assert lines(made)[-1].points[:, 1].tolist() == pytest.approx([260.0, 20.0])


def test_whole_chart_is_drawn_as_pixels_and_as_svg():
    made = chart(Axis(1, 4096, "samples", 2), Axis(1e-6, 1, "mse", 10))
    made.grid()
    for number in range(8):
        made.curve([1, 16, 256, 4096], np.logspace(-number / 4, -4, 4), style(number))
    legend(made.drawing, 80, 40, [(f"sampler {number}", style(number)) for number in range(8)])
    assert len({item.colour for item in lines(made)} - {"#e3e6eb", "#4a5361"}) == 8
    assert any(isinstance(item, Text) and item.text == "samples" for item in made.drawing.items)
    assert draw_pixels(made.drawing).min() < 100
    assert "sampler 7" in svg_text(made.drawing, {})
