"""Pictures of point sets: points and promised grids where they are, in the orientation of scenes."""

import numpy as np
import pytest

import samplekit
from samplekit import UsageError
from samplekit.plots import PointsDisplay


def display_of(sampler, count, dims):
    return PointsDisplay.from_sampler(sampler, count, dims).plot()


def places(ax, label, axis):
    """Places of the lines of one kind across an axis: 0 is x."""
    found = []
    for collection in ax.collections:
        if collection.get_label() == label:
            for (x0, y0), (x1, y1) in collection.get_segments():
                if (x0 == x1) if axis == 0 else (y0 == y1):
                    assert {y0, y1} == {0.0, 1.0} if axis == 0 else {x0, x1} == {0.0, 1.0}
                    found.append(float((x0, y0)[axis]))
    return sorted(found)


def ticks(ax, axis):
    return sorted((ax.xaxis, ax.yaxis)[axis].get_minorticklocs())


def points_of(ax):
    (line,) = (line for line in ax.lines if line.get_label() == "points")
    return np.column_stack(line.get_data())


def test_the_points_are_those_of_the_sampler():
    display = PointsDisplay.from_sampler("jittered", count=96, dims=2, seed=3).plot()
    expected = samplekit.points("jittered", 96, 2, seed=3)[0]
    assert np.array_equal(display.points, expected)
    assert np.array_equal(points_of(display.ax_), expected)
    assert display.title == "jittered, 96 points in 2D, seed 3, realisation 0"
    assert PointsDisplay.from_sampler("random", 1, 2).title.startswith("random, 1 point in 2D")


def test_x_goes_to_the_right_and_y_down():
    ax = display_of("random", 10, 2).ax_
    assert ax.get_xlim() == (0.0, 1.0)
    assert ax.get_ylim() == (1.0, 0.0)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$x_{0}$", "$x_{1}$")
    assert ax.xaxis.get_label_position() == "top"
    assert ax.get_aspect() == 1.0


def test_jittered_96_has_12_columns_and_8_rows_with_a_point_in_each():
    ax = display_of("jittered", 96, 2).ax_
    columns, rows = places(ax, "cells", 0), places(ax, "cells", 1)
    assert columns == pytest.approx([i / 12 for i in range(1, 12)])
    assert rows == pytest.approx([i / 8 for i in range(1, 8)])
    assert places(ax, "intervals", 0) == places(ax, "intervals", 1) == []
    # Counted between the lines as they are drawn, with the points as they are drawn.
    drawn = points_of(ax)
    cell = np.searchsorted(columns, drawn[:, 0]) + 12 * np.searchsorted(rows, drawn[:, 1])
    assert np.array_equal(np.bincount(cell, minlength=96), np.ones(96))


def test_hammersley_64_has_8_x_8_elementary_intervals_and_64_columns():
    ax = display_of("hammersley", 64, 2).ax_
    assert places(ax, "cells", 0) == places(ax, "cells", 1) == pytest.approx([i / 8 for i in range(1, 8)])
    assert places(ax, "intervals", 0) == pytest.approx([i / 64 for i in range(1, 64) if i % 8])
    assert places(ax, "intervals", 1) == []


def test_a_scrambled_net_shows_what_is_left_of_its_promises():
    ax = display_of("hammersley+owen", 64, 2).ax_
    assert len(places(ax, "cells", 0)) == 7
    assert places(ax, "intervals", 0) == []


def test_latin_hypercube_16_has_16_intervals_of_each_axis():
    ax = display_of("latin-hypercube", 16, 2).ax_
    expected = pytest.approx([i / 16 for i in range(1, 16)])
    assert places(ax, "intervals", 0) == places(ax, "intervals", 1) == expected
    assert places(ax, "cells", 0) == places(ax, "cells", 1) == []


def test_more_than_64_intervals_are_ticks_outside_the_frame():
    ax = display_of("latin-hypercube", 65, 2).ax_
    assert places(ax, "intervals", 0) == []
    assert ticks(ax, 0) == ticks(ax, 1) == pytest.approx([i / 65 for i in range(1, 65)])


def test_what_would_be_a_grey_mass_is_left_out():
    ax = display_of("latin-hypercube", 2000, 2).ax_
    assert not ax.collections
    assert ticks(ax, 0) == ticks(ax, 1) == []


def test_correlated_multi_jittered_in_4d_has_a_grid_in_two_of_six_pairs():
    display = display_of("correlated-multi-jittered", 16, 4)
    assert display.pairs == [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3), (2, 3)]
    for ax, pair in zip(display.axes_, display.pairs, strict=True):
        gridded = pair in {(0, 1), (2, 3)}
        for axis in (0, 1):
            assert places(ax, "cells", axis) == pytest.approx([0.25, 0.5, 0.75] if gridded else [])
            intervals = [i / 16 for i in range(1, 16) if not gridded or i % 4]
            assert places(ax, "intervals", axis) == pytest.approx(intervals)


def test_the_matrix_is_a_lower_triangle():
    display = display_of("random", 10, 4)
    corners = {pair: ax.get_position().p0 for pair, ax in zip(display.pairs, display.axes_, strict=True)}
    for (x, y), (left, bottom) in corners.items():
        assert left == pytest.approx(corners[x, 3][0])
        assert bottom == pytest.approx(corners[0, y][1])
    assert corners[0, 3][0] < corners[1, 3][0] < corners[2, 3][0]
    assert corners[0, 1][1] > corners[0, 2][1] > corners[0, 3][1]
    for ax, pair in zip(display.axes_, display.pairs, strict=True):
        assert np.array_equal(points_of(ax), display.points[:, pair])


def test_nothing_promised_is_a_frame_alone():
    ax = display_of("random", 10, 2).ax_
    assert not ax.collections
    assert ticks(ax, 0) == []


def test_one_dimension_is_a_line_of_ticks():
    display = display_of("van-der-corput", 16, 1)
    (collection,) = (one for one in display.ax_.collections if one.get_label() == "points")
    assert sorted(segment[0][0] for segment in collection.get_segments()) == sorted(display.points[:, 0])
    assert places(display_of("latin-hypercube", 16, 1).ax_, "intervals", 0) == [i / 16 for i in range(1, 16)]


def test_points_shrink_as_they_grow_many():
    sizes = [display_of("random", count, 2).ax_.lines[0].get_markersize() for count in (4, 256, 4096, 65536)]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] > 3 * sizes[2] > 3 * sizes[3] > 0


@pytest.mark.parametrize(
    ("sampler", "count", "dims"),
    [("random", 5, 1), ("latin-hypercube", 65, 1), ("jittered", 96, 2), ("sobol+owen", 64, 4), ("random", 5, 16)],
)
def test_every_text_can_be_read(drawn, sampler, count, dims):
    texts = drawn(display_of(sampler, count, dims).figure_)
    assert f"{sampler}, {count} points in {dims}D, seed 0, realisation 0" in texts


def test_promises_are_told_in_words(drawn):
    assert "strata: 12 x 8 cells" in drawn(display_of("jittered", 96, 2).figure_)


def test_a_long_title_is_broken_into_lines(drawn):
    texts = drawn(PointsDisplay(np.zeros((1, 2)), title="many words " * 30).plot().figure_)
    lines = [text for text in texts if "words" in text]
    assert len(lines) > 3
    assert " ".join(lines) == ("many words " * 30).strip()


def test_a_title_is_no_mathematics_and_has_no_control_characters(drawn):
    assert "file:path=$a_1$?.npy" in drawn(PointsDisplay([[0.5, 0.5]], title="file:path=$a_1$\x01.npy").plot().figure_)


def test_on_axes_of_the_caller():
    from matplotlib.figure import Figure

    figure = Figure()
    axes = figure.subplots(1, 3)
    display = PointsDisplay.from_sampler("random", 4, 2)
    assert display.plot(axes[1]) is display
    assert display.ax_ is axes[1]
    assert display.figure_ is figure
    assert not figure.texts
    three = PointsDisplay.from_sampler("random", 4, 3).plot(axes=axes)
    assert three.axes_ == list(axes)
    with pytest.raises(UsageError, match="this plot needs one axes, not 3"):
        display.plot(axes=axes)
    with pytest.raises(UsageError, match="this plot needs axes=3 axes, not 1"):
        three.plot(axes[0])


def test_refusals():
    with pytest.raises(UsageError, match="at most 16 dimensions, not 17"):
        PointsDisplay(np.zeros((1, 17)))
    with pytest.raises(UsageError, match="at most 16 dimensions, not 17"):
        PointsDisplay.from_sampler("random", 4, 17)
    with pytest.raises(UsageError, match=r"shape \[N, D\], not \[2, 2, 2\]"):
        PointsDisplay(np.zeros((2, 2, 2)))
    for wrong in (np.nan, -0.1, 1.1):
        with pytest.raises(UsageError, match=r"\[0, 1\]"):
            PointsDisplay([[0.5, wrong]])
