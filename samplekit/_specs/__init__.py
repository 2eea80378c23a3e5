"""Declarations: plain data, no NumPy. Listing, completing and checking a request never imports an implementation."""

from samplekit._specs.declaration import API_VERSION, CommandOption, CommandSpec
from samplekit._specs.option import NAME, Option, OptionValue, written
from samplekit._specs.promise import (
    GridStrata,
    LatinStrata,
    MinimumDistance,
    Net,
    OrthogonalArray,
    Promise,
)
from samplekit._specs.randomizer import RandomizerSpec
from samplekit._specs.sampler import SamplerSpec
from samplekit._specs.scene import PIXEL_FILTER, SceneSpec

Spec = SamplerSpec | RandomizerSpec | SceneSpec | CommandSpec | CommandOption

__all__ = [
    "API_VERSION",
    "NAME",
    "PIXEL_FILTER",
    "CommandOption",
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
