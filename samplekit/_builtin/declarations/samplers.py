"""The samplers that come with samplekit: what each declares, without importing it."""

from __future__ import annotations

from samplekit import (
    AnyCount,
    GridStrata,
    LatinStrata,
    Net,
    Option,
    OrthogonalArray,
    PowersOf,
    PrimePowers,
    Products,
    SamplerSpec,
)

_SAMPLERS = "samplekit._builtin.samplers."


def _sobol_nets(first: int) -> tuple[Net, ...]:
    """Return the nets of dimensions ``first`` to ``first + 3`` where these are Sobol's first four (Sobol' 1967).

    The quality t of a projection is the sum of degree - 1 over the polynomials of its dimensions; one dimension alone
    has t = 0.
    """
    quality = {(0, 1): 0, (0, 2): 1, (1, 2): 1, (0, 3): 2, (1, 3): 2, (2, 3): 3, (0, 1, 2): 1, (0, 1, 2, 3): 3}
    quality |= {(2,): 0, (3,): 0}
    return tuple(Net(dims=tuple(first + d for d in dims), t=t) for dims, t in quality.items())


SAMPLERS = (
    SamplerSpec(
        "random",
        _SAMPLERS + "random:Random",
        "independent uniform points: white noise",
        reference="Steele, Lea, Flood 2014 (the hash)",
        progressive=AnyCount(),
        largest_index=2**63 - 1,
    ),
    SamplerSpec(
        "regular",
        _SAMPLERS + "grid:Regular",
        "the centres of a grid",
        extensible_dims=False,
        counts=Products(),
        randomized=False,
        unbiased=False,
        promises=(GridStrata(),),
    ),
    SamplerSpec(
        "jittered",
        _SAMPLERS + "grid:Jittered",
        "a random place in each cell of a grid",
        reference="Cook, Porter, Carpenter 1984",
        extensible_dims=False,
        counts=Products(),
        promises=(GridStrata(),),
    ),
    SamplerSpec(
        "uncorrelated-jitter",
        _SAMPLERS + "grid:UncorrelatedJitter",
        "jittered pairs of dimensions (pixel, lens, ...) in random order",
        reference="Cook, Porter, Carpenter 1984",
        extensible_dims=False,
        counts=Products(2),
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
        counts=Products(2),
        promises=(LatinStrata(), GridStrata(block=2)),
    ),
    SamplerSpec(
        "correlated-multi-jittered",
        _SAMPLERS + "multi_jittered:CorrelatedMultiJittered",
        "multi-jittered with the same shuffle in all columns and rows",
        reference="Kensler 2013, Pixar 13-01",
        dimensions=(2, None),
        counts=Products(2),
        promises=(LatinStrata(), GridStrata(block=2)),
    ),
    SamplerSpec(
        "orthogonal-array",
        _SAMPLERS + "orthogonal_array:OrthogonalArraySampler",
        "jittered in every pair (or triple) of dimensions, and Latin",
        reference="Jarosz, Enayet, Kensler, Kilpatrick, Christensen 2019; Bose 1938; Bush 1952",
        options=(
            Option("strength", 2, "number of dimensions that are stratified together", 2, 3),
            Option(
                "offset",
                "correlated",
                "how places within strata are chosen",
                choices=("jittered", "multi-jittered", "correlated"),
            ),
        ),
        dimensions=(2, None),
        counts=PrimePowers(2),
        promises=(OrthogonalArray(2), LatinStrata()),
    ),
    SamplerSpec(
        "van-der-corput",
        _SAMPLERS + "radical_inverses:VanDerCorput",
        "the mirrored digits of the index, in 1D",
        reference="van der Corput 1935",
        options=(Option("base", 2, "base of the digits", 2, 1000),),
        dimensions=(1, 1),
        progressive=AnyCount(),
        randomized=False,
        unbiased=False,
        largest_index=2**40 - 1,
    ),
    SamplerSpec(
        "halton",
        _SAMPLERS + "radical_inverses:Halton",
        "radical inverses of the index in the primes",
        reference="Halton 1960; Owen 2017 (digits); Owen 1995; Helmer, Christensen, Kensler 2021 (owen)",
        options=(
            Option(
                "scramble",
                "none",
                "how digits are scrambled, so that large bases are not correlated: 256 points in bases 7907 and 7919"
                " have the correlation 1.00 without, 0.06 with digits and 0.07 with owen (root mean square)",
                choices=("none", "digits", "owen"),
            ),
        ),
        dimensions=(1, 1024),
        progressive=AnyCount(),
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
        "faure",
        _SAMPLERS + "faure:Faure",
        "digital sequence in a prime base with t = 0 in as many dimensions as the base",
        reference="Faure 1982",
        options=(Option("base", 5, "a prime, the largest number of dimensions; its powers are good counts", 2, 1021),),
        dimensions=(1, 5),
        progressive=PowersOf(5),
        randomized=False,
        unbiased=False,
        largest_index=2**40 - 1,
        promises=(Net(dims=(0, 1), base=5), Net(dims=(0, 1, 2, 3, 4), base=5)),
    ),
    SamplerSpec(
        "sobol",
        _SAMPLERS + "sobol:Sobol",
        "digital sequence in base 2 with good 2D projections",
        reference="Sobol' 1967; Joe and Kuo 2008",
        dimensions=(1, 4096),
        progressive=PowersOf(2),
        randomized=False,
        unbiased=False,
        largest_index=2**32 - 1,
        # Each of the 4096 dimensions alone is such a net; a few are enough to declare.
        promises=(*_sobol_nets(0), *(Net(dims=(d,)) for d in range(4, 8))),
    ),
    SamplerSpec(
        "niederreiter",
        _SAMPLERS + "niederreiter:Niederreiter",
        "digital sequence in base 2 from irreducible polynomials",
        reference="Niederreiter 1988; Bratley, Fox, Niederreiter 1992",
        dimensions=(1, 412),
        progressive=PowersOf(2),
        randomized=False,
        unbiased=False,
        largest_index=2**32 - 1,
        promises=(Net(dims=(0, 1)), Net(dims=(0, 1, 2), t=1), Net(dims=(0, 1, 2, 3), t=3)),
    ),
    SamplerSpec(
        "owen-sobol",
        _SAMPLERS + "owen_sobol:OwenSobol",
        "Sobol points in blocks of four dimensions, each Owen-scrambled (32 digits) and shuffled",
        reference="Burley 2020; Laine, Karras 2011; Joe, Kuo 2008",
        progressive=PowersOf(2),
        promises=(*_sobol_nets(0), *_sobol_nets(4)),
    ),
    SamplerSpec(
        "pmj02",
        _SAMPLERS + "pmj02:Pmj02",
        "progressive multi-jittered (0, 2)-sequence of 32 digits, in pairs of dimensions",
        reference="Christensen, Kensler, Kilpatrick 2018; Helmer, Christensen, Kensler 2021",
        progressive=PowersOf(2),
        promises=tuple(Net(dims=(first, first + 1)) for first in (0, 2, 4, 6)),
    ),
    SamplerSpec(
        "z-sobol",
        _SAMPLERS + "z_sobol:ZSobol",
        "one Owen-scrambled Sobol sequence (32 digits) for neighbouring pixels: blue noise in the error image",
        reference="Ahmed, Wonka 2020",
        options=(
            Option(
                "orders",
                "matched",
                "orders of the pixels: one in which nearby pixels complement each other along edges, or random ones",
                choices=("matched", "random"),
            ),
        ),
        counts=PowersOf(2),
        promises=(
            LatinStrata(),
            GridStrata(block=2),
            *(Net(dims=(first, first + 1), sequence=False) for first in (0, 2, 4, 6)),
        ),
        screen_block=64,
    ),
    SamplerSpec(
        "file",
        _SAMPLERS + "point_file:PointFile",
        "the point sets of a file",
        options=(
            Option(
                "path",
                "",
                "a CSV, .npy, or UTK text or .bin file; the path has no comma, and no plus sign before a letter",
                required=True,
            ),
        ),
        randomized=False,
        unbiased=False,
    ),
)
