"""samplekit: a laboratory for the point samplers of rendering.

Public names are loaded when first used: ``import samplekit`` imports no NumPy.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from samplekit.api import estimate, plugins, points, render, sampler, samplers, scene, scenes
    from samplekit.errors import SamplekitError, UsageError
    from samplekit.hookspecs import hookimpl
    from samplekit.integration.scene import Scene
    from samplekit.sampling.realizations import Realizations
    from samplekit.sampling.sampler import Sampler
    from samplekit.specs import (
        CommandSpec,
        GridStrata,
        LatinStrata,
        MinimumDistance,
        Net,
        Option,
        OrthogonalArray,
        RandomizerSpec,
        SamplerSpec,
        SceneSpec,
    )
    from samplekit.study.compare import compare
    from samplekit.study.results import Results

__version__ = "0.1.0"

_HOME = {
    "samplekit.api": ("estimate", "plugins", "points", "render", "sampler", "samplers", "scene", "scenes"),
    "samplekit.errors": ("SamplekitError", "UsageError"),
    "samplekit.hookspecs": ("hookimpl",),
    "samplekit.sampling.realizations": ("Realizations",),
    "samplekit.sampling.sampler": ("Sampler",),
    "samplekit.study.compare": ("compare",),
    "samplekit.study.results": ("Results",),
    "samplekit.integration.scene": ("Scene",),
    "samplekit.specs": (
        "CommandSpec",
        "GridStrata",
        "LatinStrata",
        "MinimumDistance",
        "Net",
        "Option",
        "OrthogonalArray",
        "RandomizerSpec",
        "SamplerSpec",
        "SceneSpec",
    ),
}
_MODULE_OF = {name: module for module, names in _HOME.items() for name in names}

__all__ = [
    "CommandSpec",
    "GridStrata",
    "LatinStrata",
    "MinimumDistance",
    "Net",
    "Option",
    "OrthogonalArray",
    "RandomizerSpec",
    "Realizations",
    "Results",
    "SamplekitError",
    "Sampler",
    "SamplerSpec",
    "Scene",
    "SceneSpec",
    "UsageError",
    "compare",
    "estimate",
    "hookimpl",
    "plugins",
    "points",
    "render",
    "sampler",
    "samplers",
    "scene",
    "scenes",
]


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'samplekit' has no attribute {name!r}")
    value = getattr(importlib.import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_MODULE_OF])
