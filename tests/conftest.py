"""Plugins made on the fly, as a stranger's distribution looks to the registry."""

import importlib
import os
import sys
import textwrap
from pathlib import Path

import pytest

from samplekit import _registry as registry_module

HEADER = "from samplekit import CommandSpec, Option, PowersOf, RandomizerSpec, SamplerSpec, SceneSpec, hookimpl\n"


class Plugins:
    """A folder on the import path; ``add`` puts a distribution with one plugin there, ``modules`` are what it names."""

    def __init__(self, folder: Path):
        self.folder = folder

    def add(self, name, code, *, distribution=None, entries=None, metadata=True, version="1.0"):
        """A module ``name`` with ``code`` behind the usual imports, and the distribution that offers it."""
        self.module(name, HEADER + textwrap.dedent(code))
        distribution = distribution or f"{name}-distribution"
        info = self.folder / f"{distribution.replace('-', '_')}-{version}.dist-info"
        info.mkdir()
        lines = entries or [f"{name} = {name}"]
        (info / "entry_points.txt").write_text("\n".join(["[samplekit]", *lines]) + "\n", encoding="utf-8")
        if metadata:
            text = f"Metadata-Version: 2.1\nName: {distribution}\nVersion: {version}\n"
            (info / "METADATA").write_text(text, encoding="utf-8")
        self.refresh()

    def offer(self, name, kind, *specs, **more):
        """A plugin whose only hook returns these declarations, given as source text."""
        self.add(name, f"@hookimpl\ndef samplekit_{kind}s():\n    return [{', '.join(specs)}]\n", **more)

    def module(self, name, code):
        """A module that a declaration may name."""
        (self.folder / f"{name}.py").write_text(textwrap.dedent(code), encoding="utf-8")
        self.refresh()

    def refresh(self):
        """Have the next look at plugins see what is there now."""
        importlib.invalidate_caches()
        registry_module.registry.cache_clear()

    @property
    def environment(self):
        """For another process: the plugins on its path, and no dependence on the terminal."""
        path = os.pathsep.join(filter(None, [str(self.folder), os.environ.get("PYTHONPATH", "")]))
        return {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1", **PLAIN_TERMINAL}


PLAIN_TERMINAL = {"TERM": "dumb", "COLUMNS": "200", "_TYPER_FORCE_DISABLE_TERMINAL": "1"}


@pytest.fixture
def plugins(tmp_path_factory, monkeypatch):
    """An empty folder of plugins, seen by this process; others' plugins are seen as well."""
    made = Plugins(tmp_path_factory.mktemp("plugins"))
    monkeypatch.syspath_prepend(made.folder)
    monkeypatch.delenv("SAMPLEKIT_PLUGINS", raising=False)
    monkeypatch.delenv("SAMPLEKIT_BLOCK", raising=False)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    before = set(sys.modules)
    made.refresh()
    yield made
    for name in set(sys.modules) - before:
        if str(getattr(sys.modules[name], "__file__", None) or "").startswith(str(made.folder)):
            del sys.modules[name]
    made.refresh()
