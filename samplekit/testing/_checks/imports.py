"""Light import: a name is listed, completed and checked without NumPy and without the implementation."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from samplekit._registry import ALLOW_VARIABLE, BUILTIN, registry
from samplekit.testing._process import NoResultError, run_elsewhere
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check

if TYPE_CHECKING:
    # The other process imports this module, which must not import NumPy itself.
    from samplekit.testing._subject import Subject

_HEAVY = {"numpy", "numba", "scipy", "OpenImageIO", "skimage"}
_SECONDS = 60.0


def _judge_light_import(subject: Subject) -> None:
    """Naming, listing and completing it imports neither NumPy nor the implementation."""
    if not isinstance(subject.recipe, str):
        raise NotApplicable("it is not installed: there is no plugin whose import could be judged")
    plugin = subject.plugin.name
    try:
        loaded = _loaded(plugin)
    except NoResultError as error:
        raise CheckFailed(f"listing names in a fresh process: {error}") from None
    if loaded:
        raise CheckFailed(
            f"listing the names of plugin {plugin} imports {', '.join(loaded)}: keep the module that the entry point"
            " names to declarations, and name the implementation by target="
        )


check_light_import = conformance_check("light-import", 19)(_judge_light_import)
check_scene_import = conformance_check("light-import", 6, kind="scene")(_judge_light_import)


@functools.cache
def _loaded(plugin: str) -> list[str]:
    """Return the heavy modules that the plugin's declarations import, in a process of their own."""
    environment = {ALLOW_VARIABLE: "" if plugin == BUILTIN else plugin}
    return list(run_elsewhere(f"{__name__}:answer", seconds=_SECONDS, environment=environment))


def answer() -> Iterator[str]:
    """List and complete all names, and yield the heavy modules that this imported; this runs in the other process."""
    before = set(sys.modules)
    from samplekit.commands import complete_sampler, complete_scene

    offers = [*registry().all("sampler").values(), *registry().all("scene").values()]
    complete_sampler(""), complete_scene("")
    targets = {offer.spec.target.partition(":")[0] for offer in offers}
    yield from sorted((set(sys.modules) - before) & (targets | _HEAVY))
