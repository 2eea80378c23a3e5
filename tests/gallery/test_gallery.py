"""The gallery makes what it says, once, and the same each time."""

import json
import re

import pytest

from samplekit._cli import run
from samplekit._gallery.figures import all_figures
from samplekit._gallery.page import page
from samplekit.files._images.png import read_png


def test_picture_is_made_once_and_the_same_each_time(tmp_path, capsys):
    folder = tmp_path / "pictures"
    arguments = ["gallery", "--output", str(folder), "--only", "random-and-jittered", "--json"]
    assert run(arguments) == 0
    path = folder / "random-and-jittered.png"
    first = path.read_bytes()
    assert json.loads(capsys.readouterr().out) == {"schema": "samplekit.gallery/1", "made": [str(path)], "kept": []}
    assert run(arguments) == 0
    assert json.loads(capsys.readouterr().out)["kept"] == [str(path)]
    assert run([*arguments, "--fresh"]) == 0
    assert path.read_bytes() == first
    assert not (folder / "README.md").exists(), "the page is of the whole gallery"


def test_picture_of_other_sources_is_made_anew(tmp_path, capsys, monkeypatch):
    arguments = ["gallery", "--output", str(tmp_path), "--only", "sampler-regular", "--json"]
    monkeypatch.setattr("samplekit._gallery.runner.made_from", lambda: "another")
    assert run(arguments) == 0
    monkeypatch.undo()
    capsys.readouterr()
    assert run(arguments) == 0
    assert json.loads(capsys.readouterr().out)["made"]
    _, metadata = read_png(tmp_path / "sampler-regular.png")
    assert metadata["command"] == "samplekit gallery --only sampler-regular"


def test_damaged_picture_is_made_anew(tmp_path, capsys):
    (tmp_path / "sampler-regular.png").write_bytes(b"\x89PNG\r\n\x1a\nnot a picture")
    assert run(["gallery", "--output", str(tmp_path), "--only", "sampler-regular"]) == 0
    assert capsys.readouterr().out.startswith("made")


def test_unknown_figure_is_refused(tmp_path, capsys):
    assert run(["gallery", "--output", str(tmp_path / "new"), "--only", "sampler-perfect"]) == 2
    assert "unknown figure 'sampler-perfect': there are zoneplate-four-samplers" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_folder_that_cannot_be_made_is_refused(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert run(["gallery", "--output", str(tmp_path / "file" / "x"), "--only", "sampler-regular"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_page_has_every_figure_with_its_caption_and_command():
    figures = all_figures()
    written = page(figures)
    assert re.findall(r"\]\(([^)]*)\.png\)", written) == [figure.name for figure in figures]
    for figure in figures:
        assert figure.caption in written
        assert figure.command in written


@pytest.mark.parametrize("figure", all_figures(), ids=lambda figure: figure.name)
def test_figure_is_declared_whole(figure):
    assert re.fullmatch(r"[a-z0-9-]+", figure.name)
    assert figure.command.startswith("samplekit ")
    assert figure.title
    assert figure.caption.endswith(".")
    assert figure.chapter
