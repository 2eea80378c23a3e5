"""``samplekit new-plugin``: a plugin that works and conforms as it is written; nothing is overwritten."""

import json
import os
import subprocess
import sys
import tomllib

import pytest

from samplekit._cli import run

pytestmark = pytest.mark.slow


@pytest.fixture
def plugin(tmp_path, capsys):
    assert run(["new-plugin", "golden-ratio", "--directory", str(tmp_path)]) == 0
    capsys.readouterr()
    return tmp_path / "samplekit-golden-ratio"


def test_it_is_complete(plugin):
    files = {str(path.relative_to(plugin)).replace(os.sep, "/") for path in plugin.rglob("*") if path.is_file()}
    package = "samplekit_golden_ratio"
    expected = {"pyproject.toml", "README.md", f"{package}/__init__.py", f"{package}/sampler.py"}
    assert expected | {"tests/test_conformance.py"} <= files
    assert all("$" not in (plugin / file).read_text() for file in files)


def test_it_depends_on_the_right_distribution(plugin):
    project = tomllib.loads((plugin / "pyproject.toml").read_text())["project"]
    assert project["name"] == "samplekit-golden-ratio"
    assert any(each.startswith("samplekit-core>=") for each in project["dependencies"])
    assert not any(each.split(">")[0].strip() == "samplekit" for each in project["dependencies"])
    assert project["entry-points"]["samplekit"] == {"golden-ratio": "samplekit_golden_ratio"}


def test_it_is_listed_and_conforms(plugin):
    metadata = plugin / "samplekit_golden_ratio-0.1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: samplekit-golden-ratio\nVersion: 0.1.0\n")
    (metadata / "entry_points.txt").write_text("[samplekit]\ngolden-ratio = samplekit_golden_ratio\n")
    environment = {**os.environ, "PYTHONPATH": str(plugin)}
    only = [
        f"--only={check}" for check in ("range", "shape", "seed", "strata", "unbiasedness", "purity", "light-import")
    ]
    command = [sys.executable, "-m", "samplekit", "check", "golden-ratio", "--quick", "--json", *only]
    result = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    checks = {each["check"]: each["status"] for each in json.loads(result.stdout)["subjects"][0]["checks"]}
    assert checks["strata"] == checks["light-import"] == checks["unbiasedness"] == "passed"


def test_nothing_is_overwritten(plugin, capsys):
    (plugin / "mine.txt").write_text("mine")
    assert run(["new-plugin", "golden-ratio", "--directory", str(plugin.parent)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert (plugin / "mine.txt").read_text() == "mine"
    assert [path.name for path in plugin.parent.iterdir()] == [plugin.name]


@pytest.mark.parametrize("name", ["Bad", "a b", "../x", "x/y", "a--b", "-x", "1x", "", "é", "core", "sobol", "x" * 60])
def test_bad_names_are_one_line(name, tmp_path, capsys):
    assert run(["new-plugin", "--directory", str(tmp_path), "--", name]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "plugin name" in error
    assert list(tmp_path.iterdir()) == []
