"""The page for authors of plugins says what is true: its examples run and conform, its table has every check."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from samplekit.testing._suite import SUITES

pytestmark = pytest.mark.slow

PAGE = (Path(__file__).parents[2] / "docs" / "writing-a-sampler.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def plugin(tmp_path_factory):
    """The plugin of the page, as if it were installed."""
    folder = tmp_path_factory.mktemp("kronecker")
    for path, code in re.findall(r"```python\n# (\S+\.py)\n(.*?)```", PAGE, re.DOTALL):
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(code)
    metadata = folder / "samplekit_kronecker-0.1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: samplekit-kronecker\nVersion: 0.1.0\n")
    (metadata / "entry_points.txt").write_text("[samplekit]\nkronecker = samplekit_kronecker\n")
    return folder


def run(plugin, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(plugin), "TERM": "dumb"}
    command = [sys.executable, "-m", *arguments]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=plugin, check=False)


def test_the_samplers_and_the_scene_conform(plugin):
    names = ("kronecker", "kronecker-drawn", "kronecker-kernel", "ramp")
    result = run(plugin, "samplekit", "check", *names, "--quick", "--json")
    assert result.returncode == 0, result.stdout + result.stderr
    assert len(json.loads(result.stdout)["subjects"]) == 4


def test_numpy_and_the_kernel_give_the_same_points(plugin):
    program = (
        "import samplekit; a, b = (samplekit.points(n, count=100, dims=8, realizations=5)"
        " for n in ('kronecker', 'kronecker-kernel')); raise SystemExit(int(not (a == b).all()))"
    )
    environment = {**os.environ, "PYTHONPATH": str(plugin)}
    assert subprocess.run([sys.executable, "-c", program], env=environment, check=False).returncode == 0


def test_the_command_runs(plugin):
    result = run(plugin, "samplekit", "steps", "--dims", "1")
    assert float(result.stdout) == pytest.approx(2**0.5 - 1)


def test_the_class_runs_under_pytest(plugin):
    result = run(plugin, "pytest", "-q", "-p", "no:cacheprovider", "tests", "-k", "strata or shape")
    assert result.returncode == 0, result.stdout
    assert "3 passed, 3 skipped" in result.stdout


def test_every_check_is_in_the_table():
    assert re.findall(r"^\| `([a-z-]+)` \| .* \| .* \| .*\|$", PAGE, re.MULTILINE) == [
        check.name for check in SUITES["sampler"]
    ]
