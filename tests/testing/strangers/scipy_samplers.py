"""scipy.stats.qmc as a plugin's samplers, with what its documentation says of them as their declarations."""

import math

import numpy as np
from scipy.stats import qmc

from samplekit import AnyCount, LatinStrata, MinimumDistance, Net, PowersOf, Sampler, SamplerSpec

FRACTION = 0.5


class Sobol(Sampler):
    def draw(self, count, dims, rng):
        return qmc.Sobol(dims, rng=rng).random(count)


class Halton(Sampler):
    def draw(self, count, dims, rng):
        return qmc.Halton(dims, rng=rng).random(count)


class PlainHalton(Sampler):
    def draw(self, count, dims, rng):
        return qmc.Halton(dims, scramble=False).random(count)


class LatinHypercube(Sampler):
    def draw(self, count, dims, rng):
        return qmc.LatinHypercube(dims, rng=rng).random(count)


class PoissonDisk(Sampler):
    def draw(self, count, dims, rng):
        radius = FRACTION * math.sqrt(2 / (math.sqrt(3) * count))
        return np.minimum(qmc.PoissonDisk(dims, radius=radius, rng=rng).random(count), 1 - 2**-53)


def spec(name, target, **declared):
    return SamplerSpec(name, f"scipy_samplers:{target}", f"scipy.stats.qmc.{target}", **declared)


NETS_1D = (Net(dims=(0,), base=2), Net(dims=(1,), base=3), Net(dims=(2,), base=5))
SPECS = [
    spec(
        "scipy-sobol",
        "Sobol",
        dimensions=(1, 21201),
        counts=PowersOf(2),
        progressive=PowersOf(2),
        largest_index=2**30 - 1,
        promises=(Net(),),
    ),
    spec("scipy-halton", "Halton", progressive=AnyCount(), promises=NETS_1D),
    spec(
        "scipy-halton-plain",
        "PlainHalton",
        progressive=AnyCount(),
        randomized=False,
        unbiased=False,
        promises=NETS_1D,
    ),
    spec("scipy-latin-hypercube", "LatinHypercube", promises=(LatinStrata(),)),
    spec(
        "scipy-poisson-disk",
        "PoissonDisk",
        dimensions=(2, 2),
        unbiased=False,
        promises=(MinimumDistance(FRACTION),),
    ),
]
