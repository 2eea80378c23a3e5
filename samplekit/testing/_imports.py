"""Light import: a name is listed, completed and checked without NumPy and without the implementation."""

from __future__ import annotations

import functools
import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING

from samplekit._registry import ALLOW_VARIABLE, BUILTIN
from samplekit.testing._result import CheckFailed, NotApplicable, check

if TYPE_CHECKING:
    from samplekit.testing._subject import Subject

HEAVY = ("numpy", "numba", "scipy", "OpenImageIO", "skimage")
_SECONDS = 60.0
_PROGRAM = """
import json, sys
before = set(sys.modules)
from samplekit._registry import registry
from samplekit.commands._completion import complete_sampler, complete_scene
offers = {**registry().all("sampler"), **registry().all("scene")}
complete_sampler(""), complete_scene("")
targets = {offer.spec.target.partition(":")[0] for offer in offers.values()}
loaded = set(sys.modules) - before
print(json.dumps(sorted(loaded & (targets | set(sys.argv[1:])))))
"""


@check("light-import", 19)
def check_light_import(subject: Subject) -> None:
    """Naming, listing and completing it imports neither NumPy nor the implementation."""
    judge_light_import(subject.sampler.plugin.name, installed=isinstance(subject.recipe, str))


def judge_light_import(plugin: str, *, installed: bool) -> None:
    """Raise if the plugin's declarations import what is heavy."""
    if not installed:
        raise NotApplicable("it is not installed: there is no plugin whose import could be judged")
    loaded = _loaded(plugin)
    if loaded:
        raise CheckFailed(
            f"listing the names of plugin {plugin} imports {', '.join(loaded)}: keep the module that the entry point"
            " names to declarations, and name the implementation by target="
        )


@functools.cache
def _loaded(plugin: str) -> tuple[str, ...]:
    """The heavy modules that the plugin's declarations import, in a process of their own."""
    done = subprocess.run(
        [sys.executable, "-c", _PROGRAM, *HEAVY],
        capture_output=True,
        timeout=_SECONDS,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
            ALLOW_VARIABLE: "" if plugin == BUILTIN else plugin,
        },
        check=False,
    )
    lines = done.stdout.decode(errors="replace").strip().splitlines()
    if done.returncode or not lines:
        last = (done.stderr.decode(errors="replace").strip().splitlines() or [""])[-1]
        raise CheckFailed(f"listing names in a fresh process ended with status {done.returncode}: {last}")
    return tuple(json.loads(lines[-1]))
