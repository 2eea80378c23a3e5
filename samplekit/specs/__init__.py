"""Declarations: plain data, no NumPy. Listing, completing and checking a request never imports an implementation."""

from samplekit.specs.declarations import (
    API_VERSION,
    PIXEL_FILTER,
    CommandSpec,
    RandomizerSpec,
    SamplerSpec,
    SceneSpec,
    Spec,
)
from samplekit.specs.option import NAME, Option, OptionValue, written
from samplekit.specs.promise import (
    GridStrata,
    LatinStrata,
    MinimumDistance,
    Net,
    OrthogonalArray,
    Promise,
)

__all__ = [
    "API_VERSION",
    "NAME",
    "PIXEL_FILTER",
    "CommandSpec",
    "GridStrata",
    "LatinStrata",
    "MinimumDistance",
    "Net",
    "Option",
    "OptionValue",
    "OrthogonalArray",
    "Promise",
    "RandomizerSpec",
    "SamplerSpec",
    "SceneSpec",
    "Spec",
    "written",
]
