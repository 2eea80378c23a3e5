"""Files of figures: whole or not at all, the same bytes for the same figure, with how they were made."""

import json
import subprocess
import sys
import xml.etree.ElementTree as ET

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure

from samplekit import SamplekitError, UsageError
from samplekit.files import read_info, read_png
from samplekit.plots import ENDINGS, PointsDisplay, figure_writer, make_axes, save, style

METADATA = {"seed": "7", "command": "samplekit <&>"}
PROGRAM = """
import sys
from samplekit.plots import PointsDisplay
PointsDisplay.from_sampler("jittered", 96).save(sys.argv[1], {"seed": "7"})
"""


def display():
    return PointsDisplay.from_sampler("jittered", 16)


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_same_figure_gives_the_same_bytes_in_every_process(tmp_path, ending):
    PointsDisplay.from_sampler("jittered", 96).save(tmp_path / f"here{ending}", {"seed": "7"})
    subprocess.run([sys.executable, "-c", PROGRAM, str(tmp_path / f"there{ending}")], check=True)
    assert (tmp_path / f"here{ending}").read_bytes() == (tmp_path / f"there{ending}").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"here{ending}", f"there{ending}"]


def test_a_png_has_the_size_of_the_figure_and_the_metadata_that_info_reads(tmp_path):
    made = display()
    made.save(tmp_path / "a.png", METADATA)
    pixels, metadata = read_png(tmp_path / "a.png")
    width, height = made.figure_.get_size_inches()
    assert pixels.shape == (int(200 * height), int(200 * width), 3)
    assert metadata == METADATA == read_info(tmp_path / "a.png")["metadata"]


def test_an_svg_has_text_as_text_and_the_metadata_as_its_description(tmp_path):
    display().save(tmp_path / "a.svg", METADATA)
    root = ET.parse(tmp_path / "a.svg").getroot()
    assert json.loads(root.find(".//{http://purl.org/dc/elements/1.1/}description").text) == METADATA
    texts = ["".join(element.itertext()) for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert "jittered, 16 points in 2D, seed 0, realisation 0" in texts
    assert root.find(".//{http://purl.org/dc/elements/1.1/}date") is None


def test_a_pdf_has_text_in_a_font_and_no_date(tmp_path):
    display().save(tmp_path / "a.pdf", METADATA)
    written = (tmp_path / "a.pdf").read_bytes()
    assert written.startswith(b"%PDF")
    assert written.rstrip().endswith(b"%%EOF")
    assert b"/FontFile2" in written
    assert b"CreationDate" not in written
    assert b'"seed": "7"' in written


def test_capitals_are_the_same_ending(tmp_path):
    display().save(tmp_path / "a.SVG")
    assert (tmp_path / "a.SVG").read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize("name", ["a.jpg", "a", "a.svgz", ".png"])
def test_other_endings_are_refused(tmp_path, name):
    with pytest.raises(UsageError, match=r"ends in \.png, \.svg or \.pdf"):
        display().save(tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_failure_leaves_the_old_file(tmp_path, ending, monkeypatch):
    path = tmp_path / f"a{ending}"
    path.write_text("old")
    with pytest.raises(SamplekitError, match="metadata cannot be stored as JSON"):
        display().save(path, {"a": float("nan")})
    monkeypatch.setattr(
        "samplekit.files._writing._flush", lambda _: (_ for _ in ()).throw(OSError(28, "No space left"))
    )
    with pytest.raises(SamplekitError, match="No space left"):
        display().save(path)
    assert path.read_text() == "old"
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


def test_no_such_folder(tmp_path):
    with pytest.raises(UsageError, match="does not exist"):
        display().save(tmp_path / "missing" / "a.svg")


def test_any_figure_of_matplotlib_can_be_saved(tmp_path):
    figure = Figure(figsize=(2.0, 1.0), dpi=50)
    figure.subplots().plot([0, 1])
    canvas = figure.canvas
    save(figure, tmp_path / "a.png")
    assert read_png(tmp_path / "a.png")[0].shape == (50, 100, 3)
    assert figure.canvas is canvas
    figure_writer(figure, ".svg")(tmp_path / "a.svg")
    ET.parse(tmp_path / "a.svg")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("ending", ENDINGS)
def test_names_in_any_script_and_with_any_character_are_drawn_without_a_word(tmp_path, ending, capfd):
    PointsDisplay([[0.5, 0.5]], title="漢字 \x01\udc80 $x <&> \\frac{1}").save(tmp_path / f"a{ending}")
    assert capfd.readouterr() == ("", "")
    if ending == ".svg":
        ET.parse(tmp_path / "a.svg")


def test_the_settings_of_matplotlib_and_its_global_figures_are_left_alone():
    with matplotlib.rc_context({"font.size": 31.0, "svg.fonttype": "path", "lines.linewidth": 7.0}):
        before = dict(matplotlib.rcParams)
        made = display().plot()
        with style():
            assert matplotlib.rcParams["svg.fonttype"] == "none"
        assert dict(matplotlib.rcParams) == before
        assert made.ax_.xaxis.label.get_size() == 8.0
    code = (
        "import sys; from samplekit.plots import PointsDisplay\n"
        "assert 'matplotlib' not in sys.modules\n"
        "PointsDisplay.from_sampler('random', 4).plot()\n"
        "assert 'matplotlib.figure' in sys.modules and 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_display_shows_itself_in_a_notebook():
    made = display()
    assert made._repr_png_().startswith(b"\x89PNG")
    assert made.figure_.dpi == 200


def test_panels_have_their_size_and_lie_on_whole_pixels():
    figure, axes = make_axes([(0, 0), (0, 1), (1, 0)], 1.005, (0.5, 0.725), title="a title", caption=["a line"])
    for ax, height in zip(axes, (100.0, 100.0, 145.0), strict=True):
        assert (ax.bbox.width, ax.bbox.height) == pytest.approx((201.0, height))
        assert np.allclose(ax.bbox.extents, np.rint(ax.bbox.extents), atol=1e-6)
    assert [text.get_text() for text in figure.texts] == ["a title", "a line"]
