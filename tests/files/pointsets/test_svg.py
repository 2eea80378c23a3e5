import json
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from samplekit._errors import SamplekitError
from samplekit._specs import GridStrata, LatinStrata
from samplekit.files._pointsets.picture import make_picture
from samplekit.files._pointsets.svg import svg_text

SVG = "{http://www.w3.org/2000/svg}"
POINTS = np.random.default_rng(1).random((16, 3))


def parsed(points, promises=(), title="title", metadata=None):
    text = "".join(svg_text(make_picture(points, promises, title), metadata or {}))
    return ET.fromstring(text.encode())


def test_there_is_a_circle_for_each_point_where_it_belongs():
    points = POINTS[:, :2]
    picture = make_picture(points, (), "")
    circles = list(parsed(points, title="").iter(SVG + "circle"))
    assert len(circles) == 16
    centres = np.array([[float(circle.get("cx")), float(circle.get("cy"))] for circle in circles])
    assert np.allclose(centres, picture.panels[0].disks, rtol=0, atol=0.0006)


def test_each_pair_has_its_circles():
    groups = [group for group in parsed(POINTS).iter(SVG + "g") if group.get("class") == "points"]
    assert [len(group) for group in groups] == [16, 16, 16]


def test_grid_lines_are_in_one_path_for_each_role():
    root = parsed(POINTS[:, :2], (LatinStrata(), GridStrata()))
    subpaths = {path.get("class"): path.get("d").count("M") for path in root.iter(SVG + "path")}
    assert subpaths == {"frame": 4, "strong": 6, "faint": 24}


def test_one_dimension_has_lines_and_no_circles():
    root = parsed(POINTS[:, :1])
    assert not list(root.iter(SVG + "circle"))
    assert next(path for path in root.iter(SVG + "path") if path.get("class") == "point").get("d").count("M") == 16


def test_title_and_metadata_survive_whatever_they_hold():
    metadata = {"sampler": "<a & b> ]]> \x00 é", "seed": "18446744073709551615"}
    root = parsed(POINTS[:, :2], title='a<b>&"c"\x07', metadata=metadata)
    assert root.find(SVG + "title").text == 'a<b>&"c"?'
    assert json.loads(root.find(SVG + "metadata").text) == metadata


def test_metadata_that_is_no_json_is_an_error():
    with pytest.raises(SamplekitError, match="JSON"):
        parsed(POINTS, metadata={"a": float("nan")})


def test_pieces_stay_small():
    picture = make_picture(np.random.default_rng(3).random((40_000, 2)), (), "")
    pieces = list(svg_text(picture, {}))
    assert max(map(len, pieces)) < 2_000_000
    assert "".join(pieces).count("<circle") == 40_000
