"""Declarations: plain data, no NumPy. Listing, completing and checking a request never imports an implementation."""

from samplekit._specs.counts import AnyCount as AnyCount
from samplekit._specs.counts import Counts as Counts
from samplekit._specs.counts import PowersOf as PowersOf
from samplekit._specs.declaration import CommandOption as CommandOption
from samplekit._specs.declaration import CommandSpec as CommandSpec
from samplekit._specs.option import Option as Option
from samplekit._specs.option import OptionValue as OptionValue
from samplekit._specs.option import written as written
from samplekit._specs.promise import GridStrata as GridStrata
from samplekit._specs.promise import LatinStrata as LatinStrata
from samplekit._specs.promise import MinimumDistance as MinimumDistance
from samplekit._specs.promise import Net as Net
from samplekit._specs.promise import Promise as Promise
from samplekit._specs.promise import Strata as Strata
from samplekit._specs.randomizer import RandomizerSpec as RandomizerSpec
from samplekit._specs.sampler import SamplerSpec as SamplerSpec
from samplekit._specs.scene import PIXEL_FILTER as PIXEL_FILTER
from samplekit._specs.scene import SceneSpec as SceneSpec
