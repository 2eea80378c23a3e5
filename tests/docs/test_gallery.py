"""The gallery: every script is a figure of the page, and makes it, the same each time."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

ROOT = Path(__file__).parents[2]
BUILD = ROOT / "docs" / "gallery" / "build.py"
CHEAP = ("random-and-jittered", "sampler-regular", "net-with-a-wrong-bit")

_spec = importlib.util.spec_from_file_location("build", BUILD)
build = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(build)


def make(folder, *names):
    folder.mkdir(exist_ok=True)
    command = [sys.executable, str(BUILD), "--output", str(folder), *names]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, env=os.environ, check=False)


def test_every_script_is_on_the_page_and_has_its_picture():
    scripts = sorted(path.stem for path in BUILD.parent.glob("*.py") if path.name not in ("build.py", "_shared.py"))
    assert sorted(build.NAMES) == scripts
    assert scripts == sorted(path.stem for path in (ROOT / "images").glob("*.png"))


def test_page_is_what_the_scripts_say():
    assert (ROOT / "images" / "README.md").read_text(encoding="utf-8") == build.page(), "run: docs/gallery/build.py"


@pytest.mark.parametrize("name", build.NAMES)
def test_script_says_what_its_figure_shows(name):
    assert re.fullmatch(r"[a-z0-9-]+", name)
    title, caption, command = build.read(name)
    assert title
    assert caption.endswith(".")
    assert command.startswith("samplekit ")
    assert "\n" not in command


@pytest.mark.parametrize("name", CHEAP)
@pytest.mark.slow
def test_script_makes_its_figure_and_the_same_each_time(name, tmp_path):
    pictures = []
    for folder in (tmp_path / "once", tmp_path / "again"):
        done = make(folder, name)
        assert done.returncode == 0, done.stderr
        assert sorted(path.name for path in folder.iterdir()) == ["README.md", f"{name}.png"]
        pictures.append((folder / f"{name}.png").read_bytes())
    assert pictures[0] == pictures[1]
    pixels = imread(tmp_path / "once" / f"{name}.png")[..., :3]
    assert np.ptp(pixels) == 1.0


def test_unknown_figure_is_refused(tmp_path):
    done = make(tmp_path, "sampler-perfect")
    assert done.returncode == 2
    assert "unknown figure sampler-perfect: there are zoneplate-four-samplers" in done.stderr
    assert not list(tmp_path.iterdir())
