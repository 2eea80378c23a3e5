"""The declarations of blue noise. Nothing here imports NumPy; a sampler is imported when it is first used."""

from samplekit import MinimumDistance, Option, SamplerSpec, hookimpl

DEFAULT_RADIUS = 0.698
"""A distance of 0.75 / sqrt(N): the disks cover 0.44 of the torus, where random disks jam at 0.547."""
LARGEST_RADIUS = 0.76
"""The disks cover 0.524 of the torus: dart throwing still finds room for the last point within a few attempts."""


def _bank_option(sets: int) -> Option:
    return Option(
        "bank",
        sets,
        "number of sets that all pixels share, shifted and mirrored; 0: each pixel has a fresh set",
        0,
        2**16,
    )


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """Declare the blue-noise samplers."""
    return [
        SamplerSpec(
            "poisson-disk",
            "samplekit_bluenoise.poisson_disk:PoissonDisk",
            "random points that keep a distance on the torus",
            reference="Cook 1986; Jones 2006; White, Cline, Egbert 2007; Yuksel 2015 (elimination)",
            options=(
                Option(
                    "radius",
                    DEFAULT_RADIUS,
                    "least distance as a fraction of the densest packing's; random disks jam at 0.777",
                    0.0,
                    LARGEST_RADIUS,
                ),
                Option("method", "darts", "how the points are found", choices=("darts", "elimination")),
                _bank_option(0),
            ),
            dimensions=(2, 2),
            largest_index=2**20 - 1,
            promises=(MinimumDistance(DEFAULT_RADIUS),),
            fresh_options={"bank": 0},
        ),
        SamplerSpec(
            "lloyd",
            "samplekit_bluenoise.lloyd:Lloyd",
            "points relaxed to the centroids of their Voronoi cells",
            reference="Lloyd 1982; McCool, Fiume 1992",
            options=(
                Option("steps", 10, "number of steps", 0, 10_000),
                Option(
                    "initial",
                    "poisson-disk",
                    "points before the first step",
                    choices=("poisson-disk", "jittered", "random"),
                ),
                _bank_option(64),
            ),
            dimensions=(2, 2),
            largest_index=2**20 - 1,
            fresh_options={"bank": 0},
        ),
        SamplerSpec(
            "ccvt",
            "samplekit_bluenoise.ccvt:CapacityConstrained",
            "capacity-constrained Voronoi tessellation: centroids of cells of equal area",
            reference="Balzer, Schlömer, Deussen 2009",
            options=(
                Option("capacity", 0, "background points for each point; 0: 256, or 1024 below 64 points", 0, 2**16),
                _bank_option(64),
            ),
            dimensions=(2, 2),
            largest_index=2**16 - 1,
            fresh_options={"bank": 0},
        ),
    ]
