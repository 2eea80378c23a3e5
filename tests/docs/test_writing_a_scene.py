"""The scene of docs/writing-a-scene.md, as a reader would install it."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.slow

PAGE = Path(__file__).parents[2] / "docs" / "writing-a-scene.md"

SCRIPT = """
import json, samplekit
result = samplekit.render("lamp:height=0.2", "jittered", 16, size=(24, 16))
x, y = 7.5 / 24, 3.5 / 16
print(json.dumps({"metrics": result.metrics, "reference": result.reference[3, 7], "kind": result.reference_kind,
                  "point": 0.2**4 / ((x - 0.5) ** 2 + (y - 0.5) ** 2 + 0.04) ** 2}))
"""


@pytest.fixture
def installed(tmp_path):
    """The page's files, with the metadata that an installation would leave."""
    for name, text in re.findall(r"```python\n# (samplekit_lamp/\w+\.py)\n(.*?)```", PAGE.read_text("utf-8"), re.S):
        file = tmp_path / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
    entry = re.search(r"entry-points\.samplekit\.(\w+) = \"(\w+)\"", PAGE.read_text("utf-8"))
    information = tmp_path / "samplekit_lamp-0.1.dist-info"
    information.mkdir()
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: samplekit-lamp\nVersion: 0.1\n")
    (information / "entry_points.txt").write_text(f"[samplekit]\n{entry[1]} = {entry[2]}\n")
    return tmp_path


def test_the_pages_scene_renders_with_a_reference_that_says_what_it_is(installed):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(installed), *sys.path])}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], env=environment, capture_output=True, text=True, timeout=200, check=False
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["metrics"]["rmse"] < 0.01
    assert 0 < found["metrics"]["reference_error"] < 1e-6
    assert found["kind"].startswith("adaptive quadrature")
    assert found["reference"] == pytest.approx(found["point"], rel=2e-2)


def test_it_is_twenty_lines(installed):
    lines = [line for file in installed.glob("samplekit_lamp/*.py") for line in file.read_text("utf-8").splitlines()]
    assert np.count_nonzero([bool(line) for line in lines]) <= 20
