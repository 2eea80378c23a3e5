"""Plugins that misbehave: methods that raise, exit, say nothing, or answer with what was not asked for."""

from __future__ import annotations

import contextlib
import importlib
import sys
from typing import TYPE_CHECKING

from samplekit._registry import registry

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from random import Random

BEHAVIOURS = (
    "raise ValueError('two\\nlines')", "raise KeyError", "raise RecursionError", "raise MemoryError",
    "raise OSError(28, 'x')",
    "raise StopIteration", "raise AssertionError", "raise UnicodeDecodeError('utf-8', b'x', 0, 1, 'y')", "1 / 0",
    "sys.exit(0)", "sys.exit('bye')", "raise Exception(object())", "raise type('E', (Exception,), {'__str__': None})()",
    "return None", "return 5", "return 'text'", "return np.nan", "return np.full((8, 8), np.nan)", "return np.zeros(3)",
    "return np.zeros((8, 8), complex)", "return [[1, 2], [3]]", "return np.array(['a'])", "return {}", "return 10**400",
    "return float('inf')", "return True", "return (1, 2)", "return ['\\udcff', 5]",
    "return np.full((2, 9), 2.0)", "pass",
    "return self", "yield 1", "print('noise')", "a[0][...] = np.nan", "a[0][...] = 1.5", "a[0][...] = -1e-300",
    "a[0].resize(1)", "a[0][...] = np.random.random(a[0].shape)", "return a[0] * 0 + 1e308", "return a[0][0]",
    "def f(): f()\n    f()", "import nothing_there", "np.seterr(all='raise')", "return lambda: 1", "self.x = a",
)  # fmt: skip
METHODS = {
    "sampler": ("__init__", "fill", "prepare", "notes", "check", "refine", "streams", "draw", "bases", "fused"),
    "scene": ("__init__", "sums", "value", "exact", "constant", "dimensions", "exact_at", "notes"),
    "randomizer": ("__init__", "apply"),
}
BASES = {"sampler": "Sampler", "scene": "Scene", "randomizer": "Randomizer"}
SPECS = {
    "sampler": "SamplerSpec('stranger', 'stranger_made:Made', 's'{})",
    "scene": "SceneSpec('stranger', 'stranger_made:Made', 's'{})",
    "randomizer": "RandomizerSpec('stranger', 'stranger_made:Made', 's'{})",
    "command": "CommandSpec('stranger', 'stranger_made:made', 's')",
}
EXTRAS = (", options=(Option('n', 1),)", ", options=5", ", api_version=99", ", options=(Option('n', 1, '', 5, 2),)")


@contextlib.contextmanager
def stranger(folder: Path, random: Random) -> Iterator[str]:
    """A plugin of one kind, seen by this process while inside; gives the kind."""
    kind = random.choice([*METHODS, "command"])
    wrong = [*BEHAVIOURS[:12], "return {}", "return [{0}, {0}]", "return [5]"]
    hook = random.choice(wrong) if random.random() < 0.1 else "return [{}]"
    extra = random.choice(EXTRAS) if random.random() < 0.1 else ""
    declared = hook.replace("{}", "{0}").replace("{0}", SPECS[kind].format(extra))
    info = folder / "stranger-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "entry_points.txt").write_text("[samplekit]\nstranger = stranger_plugin\n", "utf-8")
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: stranger\nVersion: 1.0\n", "utf-8")
    head = "import sys\nimport numpy as np\nfrom samplekit import *\n"
    head += "from samplekit._bases.randomizer import Randomizer\n"
    text = f"{head}@hookimpl\ndef samplekit_{kind}s():\n    {declared}\n"
    (folder / "stranger_plugin.py").write_text(text, "utf-8")
    (folder / "stranger_made.py").write_text(head + _made(kind, random), "utf-8")
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    registry.cache_clear()
    try:
        yield kind
    finally:
        sys.path.remove(str(folder))
        for name in ("stranger_plugin", "stranger_made"):
            sys.modules.pop(name, None)
        registry.cache_clear()


def _made(kind: str, random: Random) -> str:
    if kind == "command":
        return f"def made(a: str = 'x'):\n    self = a\n    {random.choice(BEHAVIOURS)}\n"
    lines = [f"class Made({BASES[kind]}):"]
    if kind == "sampler":
        lines.append("  def fill(self, out, realizations, count, start): out[...] = 0.5")
    if kind == "scene":
        lines.append("  def value(self, p): return p[0]")
    methods = random.sample(METHODS[kind], random.choice([1, 1, 2]))
    lines += [f"  def {method}(self, *a, **k):\n    {random.choice(BEHAVIOURS)}" for method in methods]
    return "\n".join(lines) + "\n"


def request(kind: str, random: Random) -> list[str]:
    """A command that meets the plugin."""
    json = random.choice([[], ["--json"]])
    if random.random() < 0.15:
        return [*random.choice([["list"], ["list", f"{kind}s", "stranger"], ["list", "plugins"], ["--help"]]), *json]
    if kind == "command":
        return ["stranger", *random.choice([[], ["--help"], ["--a", "y"], ["nothing"]])]
    sampler = {"sampler": "stranger", "randomizer": "sobol+stranger", "scene": "random"}[kind]
    scene = "stranger" if kind == "scene" else "disk"
    rendering = ["render", "-s", sampler, "-n", "4", "--scene", scene, "--size", "8", "-o", "out"]
    study = ["compare", "-s", sampler, "--scene", scene, "-n", "4", "--trials", "4", "--size", "1", "--no-time"]
    points = ["points", "-s", sampler, "-n", "4"]
    return [*random.choice([rendering, study, points if kind != "scene" else rendering]), *json]
