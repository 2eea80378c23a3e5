"""Declarations: plain data, no NumPy. Listing, completing and checking a request never imports an implementation."""

from samplekit._specs.counts import (
    AnyCount,
    Counts,
    Exactly,
    FibonacciNumbers,
    Powers,
    PowersOf,
    PrimePowers,
    Products,
)
from samplekit._specs.declaration import API_VERSION, CommandOption, CommandSpec
from samplekit._specs.option import NAME, Option, OptionValue, written
from samplekit._specs.promise import (
    GridStrata,
    LatinStrata,
    MinimumDistance,
    Net,
    OrthogonalArray,
    Promise,
    Strata,
)
from samplekit._specs.randomizer import RandomizerSpec
from samplekit._specs.sampler import SamplerSpec
from samplekit._specs.scene import PIXEL_FILTER, SceneSpec

Spec = SamplerSpec | RandomizerSpec | SceneSpec | CommandSpec | CommandOption

__all__ = [
    "API_VERSION",
    "NAME",
    "PIXEL_FILTER",
    "AnyCount",
    "CommandOption",
    "CommandSpec",
    "Counts",
    "Exactly",
    "FibonacciNumbers",
    "GridStrata",
    "LatinStrata",
    "MinimumDistance",
    "Net",
    "Option",
    "OptionValue",
    "OrthogonalArray",
    "Powers",
    "PowersOf",
    "PrimePowers",
    "Products",
    "Promise",
    "RandomizerSpec",
    "SamplerSpec",
    "SceneSpec",
    "Spec",
    "Strata",
    "written",
]
