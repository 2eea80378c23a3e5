"""Points of a sampler in one call."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._configured.sampler import sampler as configured_sampler

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._specs import SamplerSpec


def points(
    sampler: str | SamplerSpec | ConfiguredSampler,
    count: int,
    dims: int = 2,
    *,
    realizations: int = 1,
    seed: int = 0,
) -> NDArray[np.float64]:
    """Return points of a sampler.

    Parameters
    ----------
    sampler
        ``NAME[:option=value,...][+RANDOMIZER]``, or what :func:`samplekit.sampler` returned.
    count, dims, realizations
        Points of a set, dimensions, number of independent sets.
    seed
        From 0 to 2^64 - 1.

    Returns
    -------
    float64[realizations, count, dims], in [0, 1).

    Raises
    ------
    UsageError
        The sampler is unknown or cannot make such sets.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.points("hammersley", count=4)[0].tolist()
    [[0.0, 0.0], [0.25, 0.5], [0.5, 0.25], [0.75, 0.75]]
    """
    return configured_sampler(sampler).points(count, dims, realizations=realizations, seed=seed)
