"""The samplers, randomizers and scenes that come with samplekit, offered through the same hooks as any stranger's."""

from __future__ import annotations

from samplekit.hookspecs import hookimpl
from samplekit.specs import (
    GridStrata,
    LatinStrata,
    Net,
    Option,
    OrthogonalArray,
    RandomizerSpec,
    SamplerSpec,
    SceneSpec,
)

_SAMPLERS = "samplekit.builtin.samplers."
_RANDOMIZERS = "samplekit.builtin.randomizers."
_SCENES = "samplekit.builtin.scenes."
_CENTRE = (
    Option("cx", 0.4523, "centre, from the left edge"),
    Option("cy", 0.5317, "centre, from the top edge"),
)


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """The built-in samplers."""
    return [
        SamplerSpec(
            "random",
            _SAMPLERS + "random:Random",
            "independent uniform points: white noise",
            reference="Steele, Lea, Flood 2014 (the hash)",
            progressive="every-count",
            largest_index=2**63 - 1,
        ),
        SamplerSpec(
            "regular",
            _SAMPLERS + "grid:Regular",
            "the centres of a grid",
            counts="products",
            randomized=False,
            unbiased=False,
            promises=(GridStrata(),),
        ),
        SamplerSpec(
            "jittered",
            _SAMPLERS + "grid:Jittered",
            "a random place in each cell of a grid",
            reference="Cook, Porter, Carpenter 1984",
            counts="products",
            promises=(GridStrata(),),
        ),
        SamplerSpec(
            "uncorrelated-jitter",
            _SAMPLERS + "uncorrelated_jitter:UncorrelatedJitter",
            "jittered pairs of dimensions (pixel, lens, ...) in random order",
            reference="Cook, Porter, Carpenter 1984",
            counts="products-in-2",
            promises=(GridStrata(block=2),),
        ),
        SamplerSpec(
            "latin-hypercube",
            _SAMPLERS + "latin_hypercube:LatinHypercube",
            "one point in each of N intervals of every dimension",
            reference="McKay, Beckman, Conover 1979",
            promises=(LatinStrata(),),
        ),
        SamplerSpec(
            "n-rooks",
            _SAMPLERS + "latin_hypercube:LatinHypercube",
            "Latin hypercube in 2D",
            reference="Shirley 1991",
            dimensions=(2, 2),
            promises=(LatinStrata(),),
        ),
        SamplerSpec(
            "multi-jittered",
            _SAMPLERS + "multi_jittered:MultiJittered",
            "jittered and Latin at once",
            reference="Chiu, Shirley, Wang 1994",
            dimensions=(2, None),
            counts="products-in-2",
            promises=(LatinStrata(), GridStrata(block=2)),
        ),
        SamplerSpec(
            "correlated-multi-jittered",
            _SAMPLERS + "multi_jittered:CorrelatedMultiJittered",
            "multi-jittered with the same shuffle in all columns and rows",
            reference="Kensler 2013, Pixar 13-01",
            dimensions=(2, None),
            counts="products-in-2",
            promises=(LatinStrata(), GridStrata(block=2)),
        ),
        SamplerSpec(
            "orthogonal-array",
            _SAMPLERS + "orthogonal_array:OrthogonalArraySampler",
            "jittered in every pair (or triple) of dimensions, and Latin",
            reference="Jarosz, Enayet, Kensler, Kilpatrick, Christensen 2019; Bose 1938; Bush 1952",
            options=(
                Option("strength", 2, "dimensions that are stratified together", 2, 3),
                Option(
                    "offset",
                    "correlated",
                    "places within strata",
                    choices=("jittered", "multi-jittered", "correlated"),
                ),
            ),
            dimensions=(2, None),
            counts="prime-squares",
            promises=(OrthogonalArray(2), LatinStrata()),
        ),
        SamplerSpec(
            "van-der-corput",
            _SAMPLERS + "radical_inverses:VanDerCorput",
            "the mirrored digits of the index, in 1D",
            reference="van der Corput 1935",
            options=(Option("base", 2, "base of the digits", 2, 1000),),
            dimensions=(1, 1),
            progressive="every-count",
            randomized=False,
            unbiased=False,
            largest_index=2**40 - 1,
        ),
        SamplerSpec(
            "halton",
            _SAMPLERS + "radical_inverses:Halton",
            "radical inverses of the index in the primes",
            reference="Halton 1960",
            dimensions=(1, 1024),
            progressive="every-count",
            randomized=False,
            unbiased=False,
            largest_index=2**40 - 1,
            promises=(Net(dims=(0,), base=2), Net(dims=(1,), base=3), Net(dims=(2,), base=5)),
        ),
        SamplerSpec(
            "hammersley",
            _SAMPLERS + "radical_inverses:Hammersley",
            "index / count, then radical inverses in the primes",
            reference="Hammersley 1960",
            dimensions=(1, 1025),
            randomized=False,
            unbiased=False,
            largest_index=2**40 - 1,
            promises=(LatinStrata(dims=(0,)), Net(dims=(0, 1), base=2, sequence=False)),
        ),
        SamplerSpec(
            "sobol",
            _SAMPLERS + "sobol:Sobol",
            "digital sequence in base 2 with good 2D projections",
            reference="Sobol' 1967; Joe and Kuo 2008",
            dimensions=(1, 4096),
            progressive="powers-of-2",
            randomized=False,
            unbiased=False,
            largest_index=2**32 - 1,
            promises=(Net(dims=(0, 1), base=2),),
        ),
    ]


@hookimpl
def samplekit_randomizers() -> list[RandomizerSpec]:
    """The built-in randomizers."""
    return [
        RandomizerSpec(
            "shift",
            _RANDOMIZERS + "shift:Shift",
            "one random toroidal shift of the whole set: homogenisation",
            reference="Cranley, Patterson 1976",
            keeps=("distance",),
        ),
        RandomizerSpec(
            "xor",
            _RANDOMIZERS + "xor:Xor",
            "one random digit added at each place",
            reference="L'Ecuyer, Lemieux 2002",
            keeps=("net",),
        ),
        RandomizerSpec(
            "owen",
            _RANDOMIZERS + "owen:Owen",
            "nested uniform scrambling of the digits",
            reference="Owen 1995; Laine, Karras 2011; Burley 2020",
            keeps=("net",),
        ),
    ]


@hookimpl
def samplekit_scenes() -> list[SceneSpec]:
    """The built-in scenes."""
    return [
        SceneSpec(
            "disk",
            _SCENES + "disk:Disk",
            "1 inside a disk, 0 outside",
            options=(Option("radius", 0.3, "radius", 0.0), *_CENTRE),
        ),
        SceneSpec(
            "gaussian",
            _SCENES + "gaussian:Gaussian",
            "exp(-|x - c|^2 / 2 sigma^2)",
            options=(Option("sigma", 0.1, "standard deviation", 1e-150), *_CENTRE),
        ),
        SceneSpec(
            "zoneplate",
            _SCENES + "zoneplate:ZonePlate",
            "1/2 + 1/2 cos(k |x - c|^2)",
            options=(
                Option("k", 1024.0, "radians at distance 1", 0.0),
                Option("cx", 0.0, "centre, from the left edge"),
                Option("cy", 0.0, "centre, from the top edge"),
            ),
        ),
        SceneSpec(
            "step",
            _SCENES + "step:Step",
            "1 on one side of a line",
            options=(
                Option("angle", 0.0, "of the line's normal from the x axis, degrees"),
                Option("offset", 0.5, "distance of the line from the origin"),
            ),
        ),
        SceneSpec(
            "checker",
            _SCENES + "checker:Checker",
            "a checkerboard",
            options=(Option("cells", 8, "along a side", 1, 2**20),),
        ),
        SceneSpec("bilinear", _SCENES + "bilinear:Bilinear", "x times y"),
    ]
