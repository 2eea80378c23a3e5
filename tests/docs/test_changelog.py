"""The changelog is about this version, and the names that it gives to authors of plugins exist."""

import importlib
import re
import tomllib
from pathlib import Path

import pytest

import samplekit

ROOT = Path(__file__).parents[2]
CHANGELOG = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (`.*) \| (`.*) \|$", CHANGELOG, re.MULTILINE)


def test_first_entry_is_this_version():
    assert re.search(r"^## \[(.*?)\]", CHANGELOG, re.MULTILINE)[1] == samplekit.__version__


def test_plugins_need_this_version():
    for path in (ROOT / "plugins").glob("*/pyproject.toml"):
        project = tomllib.loads(path.read_text(encoding="utf-8"))["project"]
        major_and_minor = ".".join(samplekit.__version__.split(".")[:2])
        assert f"samplekit-core>={major_and_minor}" in project["dependencies"], path


@pytest.mark.parametrize("new", [new for _, new in ROWS])
def test_new_name_exists(new):
    for name in re.findall(r"`(samplekit[\w.]*)`", new):
        try:
            importlib.import_module(name)
        except ModuleNotFoundError:
            package, _, attribute = name.rpartition(".")
            assert hasattr(importlib.import_module(package), attribute), name


def test_new_declarations_are_rules():
    rules = [rule for old, new in ROWS if old.startswith("`counts=") for rule in re.findall(r"[A-Z]\w+\(\d*\)", new)]
    assert len(rules) >= 9
    for rule in rules:
        assert isinstance(eval(rule, {name: getattr(samplekit, name) for name in samplekit.__all__}), samplekit.Counts)
