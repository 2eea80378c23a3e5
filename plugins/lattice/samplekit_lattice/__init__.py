"""Lattices: the declarations. Nothing here imports NumPy; the samplers are imported when they are used."""

from samplekit import SamplerSpec, hookimpl


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """The lattices."""
    return [
        SamplerSpec(
            "r2",
            "samplekit_lattice.r2:R2",
            "golden-ratio sequence, randomly shifted",
            reference="Roberts 2018, after Kronecker and Weyl",
            dimensions=(1, 16),
            progressive="every-count",
            largest_index=2**32 - 1,
        ),
        SamplerSpec(
            "rank1",
            "samplekit_lattice.rank1:Rank1",
            "rank-1 lattice, randomly shifted",
            reference="Cools, Kuo, Nuyens 2006",
            dimensions=(1, 16),
            counts="powers-of-2",
            largest_index=2**20 - 1,
        ),
    ]
