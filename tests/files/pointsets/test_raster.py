import numpy as np
import pytest

from samplekit._specs import GridStrata
from samplekit.files._pointsets.picture import BACKGROUND, STYLES, make_picture
from samplekit.files._pointsets.raster import SCALE, draw_picture


def rgb(colour):
    return tuple(int(colour[i : i + 2], 16) for i in (1, 3, 5))


def test_a_disk_is_where_its_point_is_and_has_its_area():
    points = np.array([[0.31, 0.62]])
    picture = make_picture(points, (), "")
    pixels = draw_picture(picture).astype(float)
    assert pixels.shape == (SCALE * picture.height, SCALE * picture.width, 3)
    panel = picture.panels[0]
    left, top = int(SCALE * panel.left) + 9, int(SCALE * panel.top) + 9
    inside = pixels[top : top + int(SCALE * panel.height) - 18, left : left + int(SCALE * panel.width) - 18]
    background, ink = np.array(rgb(BACKGROUND)), np.array(rgb(STYLES["point"].colour))
    coverage = ((background - inside) / (background - ink)).mean(axis=2)
    assert coverage.sum() == pytest.approx(np.pi * (SCALE * picture.radius) ** 2, rel=0.01)
    y, x = np.mgrid[: coverage.shape[0], : coverage.shape[1]] + 0.5
    centre = np.array([(coverage * x).sum(), (coverage * y).sum()]) / coverage.sum() + (left, top)
    assert centre == pytest.approx(SCALE * panel.disks[0], abs=0.02)


def test_lines_are_whole_pixels_at_their_places():
    # The only point is in a corner, away from the row that is looked at.
    picture = make_picture(np.zeros((1, 2)), (), "")
    gridded = make_picture(np.vstack([np.zeros((95, 2)), np.zeros((1, 2))]), (GridStrata(),), "")
    assert picture.panels[0].left == gridded.panels[0].left
    pixels = draw_picture(gridded)
    panel = gridded.panels[0]
    row = pixels[int(SCALE * (panel.top + panel.height / 16 + 3 * panel.height / 8))]
    strong = np.flatnonzero((row == rgb(STYLES["strong"].colour)).all(axis=1))
    starts = strong[np.diff(strong, prepend=-9) > 1]
    assert len(strong) == 2 * len(starts) == 22
    expected = SCALE * (panel.left + panel.width * np.arange(1, 12) / 12)
    assert np.abs(starts + 1 - expected).max() <= 0.5


def test_points_at_all_corners_fit():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    picture = make_picture(points, (), "")
    pixels = draw_picture(picture)
    for x, y in (SCALE * picture.panels[0].disks).astype(int):
        assert tuple(pixels[y, x]) == rgb(STYLES["point"].colour)


def test_many_points_are_drawn_in_pieces_that_leave_no_trace():
    points = np.random.default_rng(5).random((20_000, 2))
    whole = draw_picture(make_picture(points, (), ""))
    shuffled = draw_picture(make_picture(points[::-1], (), ""))
    assert np.array_equal(whole, shuffled)


def test_one_dimension_is_drawn():
    points = np.array([[0.25], [0.75]])
    picture = make_picture(points, (), "")
    panel = picture.panels[0]
    row = draw_picture(picture)[int(SCALE * (panel.top + 0.6 * panel.height))]
    ink = np.flatnonzero((row == rgb(STYLES["point"].colour)).all(axis=1))
    middles = [ink[ink < ink.mean()].mean() + 0.5, ink[ink > ink.mean()].mean() + 0.5]
    assert middles == pytest.approx([SCALE * (panel.left + panel.width * x) for x in points[:, 0]], abs=0.5)


def test_letters_are_there():
    picture = make_picture(np.full((1, 2), 0.5), (), "A title")
    above = draw_picture(picture)[: int(SCALE * picture.texts[0].y) + 4]
    assert (above < 100).any()
