"""The declarations of the lattices. Nothing here imports NumPy; a sampler is imported when it is first used."""

from samplekit import (
    AnyCount,
    FibonacciNumbers,
    LatinStrata,
    MinimumDistance,
    Net,
    Option,
    PowersOf,
    SamplerSpec,
    hookimpl,
)


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """Declare the lattices."""
    return [
        SamplerSpec(
            "r2",
            "samplekit_lattice.r2:R2",
            "golden-ratio sequence, randomly shifted",
            reference="Roberts 2018, after Kronecker and Weyl",
            progressive=AnyCount(),
            # The steps are powers of a root of x^(d + 1) = x + 1: other ones for each number d of dimensions.
            extensible_dims=False,
            largest_index=2**32 - 1,
        ),
        SamplerSpec(
            "rank1",
            "samplekit_lattice.rank1:Rank1",
            "rank-1 lattice sequence, randomly shifted",
            reference="Cools, Kuo, Nuyens 2006; Hickernell, Kritzer, Kuo, Nuyens 2012",
            options=(
                Option(
                    "vector",
                    "ckn",
                    "generating vector: ckn for pairs of 250 dimensions from 2^10 points on, hkkn for smooth periodic"
                    " integrands in 10",
                    choices=("ckn", "hkkn"),
                ),
            ),
            dimensions=(1, 250),
            progressive=PowersOf(2),
            largest_index=2**20 - 1,
            # All components are odd, so that in any one dimension 2^m points lie one in each interval of 2^-m.
            promises=(Net(dims=(0,)), Net(dims=(1,))),
        ),
        SamplerSpec(
            "fibonacci",
            "samplekit_lattice.fibonacci:Fibonacci",
            "Fibonacci's lattice, randomly shifted",
            reference="Zaremba 1966",
            dimensions=(2, 2),
            counts=FibonacciNumbers(),
            # Three points are 0.76 apart; two points, or more than three, at least 0.86.
            promises=(LatinStrata(), MinimumDistance(0.75)),
        ),
    ]
