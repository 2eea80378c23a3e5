"""The command of the page for authors of plugins runs as the page has it."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PAGE = (Path(__file__).parents[2] / "docs" / "writing-a-command.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def plugin(tmp_path_factory):
    """The plugin of the page, as if it were installed."""
    folder = tmp_path_factory.mktemp("gaps")
    for path, code in re.findall(r"```python\n# (\S+\.py)\n(.*?)```", PAGE, re.DOTALL):
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(code)
    metadata = folder / "samplekit_gaps-0.1.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: samplekit-gaps\nVersion: 0.1\n")
    (metadata / "entry_points.txt").write_text("[samplekit]\ngaps = samplekit_gaps\n")
    return folder


def samplekit(plugin, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(plugin), "TERM": "dumb"}
    command = [sys.executable, "-m", "samplekit", *arguments]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=plugin, check=False)


def test_it_runs(plugin):
    found = json.loads(samplekit(plugin, "gaps", "--sampler", "poisson-disk", "--count", "2^8", "--json").stdout)
    assert found["smallest"] >= 0.75 / 16
    assert found["smallest"] <= found["mean"] <= found["largest"]


def test_its_errors_read_like_ours(plugin):
    result = samplekit(plugin, "gaps", "--sampler", "jittered", "--count", "97")
    assert result.returncode == 2
    assert result.stderr.count("\n") == 1
    assert "96" in result.stderr
