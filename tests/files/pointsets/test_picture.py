import numpy as np
import pytest

from samplekit import sampler as configured_sampler
from samplekit._errors import UsageError
from samplekit.files._pointsets.picture import make_picture


def picture_of(text, count, dims):
    sampler = configured_sampler(text)
    points = sampler.points(count, dims)[0]
    return points, make_picture(points, sampler.spec.promises, sampler.text)


def places(panel, role, axis):
    """The places in [0, 1] of the panel's lines across an axis."""
    lines = panel.lines.get(role, np.empty((0, 4)))
    across = lines[lines[:, axis] == lines[:, axis + 2]]
    origin, side = ((panel.left, panel.width), (panel.top, panel.height))[axis]
    return sorted(((across[:, axis] - origin) / side).tolist())


def test_jittered_96_has_12_columns_and_8_rows_with_a_point_in_each():
    points, picture = picture_of("jittered", 96, 2)
    (panel,) = picture.panels
    assert places(panel, "strong", 0) == pytest.approx([i / 12 for i in range(1, 12)])
    assert places(panel, "strong", 1) == pytest.approx([i / 8 for i in range(1, 8)])
    assert places(panel, "faint", 0) == places(panel, "faint", 1) == []
    # Counted between the lines as they are drawn, with the disks as they are drawn.
    verticals = np.unique(panel.lines["strong"][:11, 0])
    horizontals = np.unique(panel.lines["strong"][11:, 1])
    cell = np.searchsorted(verticals, panel.disks[:, 0]) + 12 * np.searchsorted(horizontals, panel.disks[:, 1])
    assert np.array_equal(np.bincount(cell, minlength=96), np.ones(96))
    assert np.allclose((panel.disks - (panel.left, panel.top)) / panel.width, points)


def test_hammersley_64_has_8_x_8_elementary_intervals_and_64_columns():
    _, picture = picture_of("hammersley", 64, 2)
    (panel,) = picture.panels
    eighths = [i / 8 for i in range(1, 8)]
    assert places(panel, "strong", 0) == places(panel, "strong", 1) == pytest.approx(eighths)
    assert places(panel, "faint", 0) == pytest.approx([i / 64 for i in range(1, 64) if i % 8])
    assert places(panel, "faint", 1) == []


def test_a_scrambled_net_shows_what_is_left_of_its_promises():
    _, picture = picture_of("hammersley+owen", 64, 2)
    assert len(places(picture.panels[0], "strong", 0)) == 7
    assert places(picture.panels[0], "faint", 0) == []


def test_latin_hypercube_16_has_16_intervals_of_each_axis():
    _, picture = picture_of("latin-hypercube", 16, 2)
    (panel,) = picture.panels
    expected = pytest.approx([i / 16 for i in range(1, 16)])
    assert places(panel, "faint", 0) == places(panel, "faint", 1) == expected
    assert places(panel, "strong", 0) == places(panel, "strong", 1) == []


def test_more_than_64_intervals_are_ticks_outside_the_frame():
    _, picture = picture_of("latin-hypercube", 65, 2)
    (panel,) = picture.panels
    assert "faint" not in panel.lines
    assert len(places(panel, "tick", 0)) == len(places(panel, "tick", 1)) == 64
    vertical = panel.lines["tick"][:64]
    assert (vertical[:, 3] == panel.top).all()
    assert (vertical[:, 1] < panel.top).all()


def test_what_would_be_a_grey_mass_is_left_out():
    _, picture = picture_of("latin-hypercube", 2000, 2)
    assert set(picture.panels[0].lines) == {"frame"}


def test_correlated_multi_jittered_in_4d_has_a_grid_in_two_of_six_pairs():
    _, picture = picture_of("correlated-multi-jittered", 16, 4)
    assert [panel.axes for panel in picture.panels] == [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3), (2, 3)]
    for panel in picture.panels:
        gridded = panel.axes in {(0, 1), (2, 3)}
        for axis in (0, 1):
            assert places(panel, "strong", axis) == pytest.approx([0.25, 0.5, 0.75] if gridded else [])
            faint = [i / 16 for i in range(1, 16) if not gridded or i % 4]
            assert places(panel, "faint", axis) == pytest.approx(faint)


def test_the_matrix_is_a_lower_triangle_with_x_to_the_right_and_y_down():
    points, picture = picture_of("random", 10, 4)
    corners = {panel.axes: (panel.left, panel.top) for panel in picture.panels}
    columns = {x: corners[x, 3][0] for x in range(3)}
    rows = {y: corners[0, y][1] for y in range(1, 4)}
    assert columns[0] < columns[1] < columns[2]
    assert rows[1] < rows[2] < rows[3]
    assert corners == {(x, y): (columns[x], rows[y]) for y in rows for x in range(y)}
    panel = picture.panels[4]
    assert panel.axes == (1, 3)
    assert np.allclose(panel.disks[:, 0], panel.left + panel.width * points[:, 1])
    assert np.allclose(panel.disks[:, 1], panel.top + panel.height * points[:, 3])


def test_nothing_promised_is_a_frame_alone():
    _, picture = picture_of("random", 10, 2)
    assert set(picture.panels[0].lines) == {"frame"}


def test_one_dimension_is_a_line_of_ticks():
    points, picture = picture_of("van-der-corput", 16, 1)
    (panel,) = picture.panels
    assert places(panel, "point", 0) == pytest.approx(sorted(points[:, 0]))
    assert len(panel.disks) == 0
    _, picture = picture_of("latin-hypercube", 16, 1)
    assert places(picture.panels[0], "faint", 0) == pytest.approx([i / 16 for i in range(1, 16)])


def test_disks_shrink_as_points_grow_many():
    radii = [picture_of("random", count, 2)[1].radius for count in (4, 256, 4096, 65536)]
    assert radii == sorted(radii, reverse=True)
    assert radii[0] > 3 * radii[2] > 3 * radii[3] > 0


def test_all_lies_within_the_picture():
    for dims in (1, 2, 3, 16):
        _, picture = picture_of("random", 5, dims)
        for panel in picture.panels:
            assert panel.left > 0
            assert panel.top > 0
            assert panel.left + panel.width < picture.width
            assert panel.top + panel.height < picture.height
        first = min(panel.top for panel in picture.panels)
        assert all(0 < text.x < picture.width and 0 < text.y < picture.height for text in picture.texts)
        assert picture.texts[0].y < first


def test_a_long_title_is_broken_into_lines():
    picture = make_picture(np.zeros((1, 2)), (), "many words " * 30)
    lines = [text for text in picture.texts if "words" in text.text]
    assert len(lines) > 3
    assert picture.panels[0].top > lines[-1].y


def test_refusals():
    with pytest.raises(UsageError, match="at most 16 dimensions, not 17"):
        make_picture(np.zeros((1, 17)), (), "")
    for wrong in (np.nan, -0.1, 1.1):
        with pytest.raises(UsageError, match=r"\[0, 1\]"):
            make_picture(np.array([[0.5, wrong]]), (), "")
