"""The conformance suite: every property that a sampler or a scene declares, tied to a check that can fail.

Checks are plain functions and need no test framework. Three doors lead to them: ``samplekit check NAME``,
``pytest --pyargs samplekit.conformance --sampler NAME``, and a subclass of ``SamplerConformance`` in a test file.
Importing this module imports no NumPy.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from samplekit.conformance.cases import SamplerConformance, SceneConformance
    from samplekit.conformance.suite import check_sampler, check_scene

_HOME = {
    "SamplerConformance": "samplekit.conformance.cases",
    "SceneConformance": "samplekit.conformance.cases",
    "check_sampler": "samplekit.conformance.suite",
    "check_scene": "samplekit.conformance.suite",
}

__all__ = ["SamplerConformance", "SceneConformance", "check_sampler", "check_scene"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)
