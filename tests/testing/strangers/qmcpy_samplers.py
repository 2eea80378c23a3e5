"""QMCPy's lattice and net as a plugin's samplers, with what its documentation says of them as their declarations."""

import qmcpy

from samplekit import Net, PowersOf, Sampler, SamplerSpec


class Lattice(Sampler):
    def draw(self, count, dims, rng):
        return qmcpy.Lattice(dims, seed=int(rng.integers(2**31))).gen_samples(count)


class DigitalNet(Sampler):
    def draw(self, count, dims, rng):
        return qmcpy.DigitalNetB2(dims, seed=int(rng.integers(2**31))).gen_samples(count)


def spec(name, target, **declared):
    return SamplerSpec(
        name,
        f"qmcpy_samplers:{target}",
        f"qmcpy.{target}",
        dimensions=(1, 100),
        counts=PowersOf(2),
        progressive=PowersOf(2),
        largest_index=2**20 - 1,
        **declared,
    )


SPECS = [spec("qmcpy-lattice", "Lattice"), spec("qmcpy-net", "DigitalNet", promises=(Net(),))]
