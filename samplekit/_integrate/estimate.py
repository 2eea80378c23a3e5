"""Estimates of the mean of a scene over the unit square, many times over."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._arguments import check_positive
from samplekit._bases.realizations import check_seed
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import scene as configured_scene
from samplekit._integrate.loop import integrate, unit_square
from samplekit._integrate.plan import check_points
from samplekit._memory import check_memory
from samplekit._threads import check_threads, on_threads

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene
    from samplekit._specs import SamplerSpec, SceneSpec

_BYTES_PER_REALIZATION = 9 * 8
"""An estimate and a sum, a box of four numbers, a key and a pixel."""
_BLOCK = 256
"""Number of realisations in a job."""


def estimate(
    scene: str | SceneSpec | ConfiguredScene,
    sampler: str | SamplerSpec | ConfiguredSampler,
    count: int,
    *,
    realizations: int = 1,
    first: int = 0,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> NDArray[np.float64]:
    """Estimate the mean of a scene over the unit square, which is taken as one pixel.

    Parameters
    ----------
    scene, sampler
        As on the command line, or what :func:`samplekit.scene` and :func:`samplekit.sampler` returned.
    count
        Samples of each estimate.
    realizations, first
        Number of independent estimates, and the number of the first realisation.
    seed
        From 0 to 2^64 - 1.
    threads
        None: as many as there are processors. No estimate depends on it.
    progress
        Called with the numbers of realisations done and to do.

    Returns
    -------
    float64[realizations]

    Raises
    ------
    UsageError
        The request cannot be carried out.
    PluginError
        A plugin failed.

    Examples
    --------
    >>> import samplekit
    >>> estimates = samplekit.estimate("bilinear", "jittered", count=256, realizations=100)
    >>> bool(abs(estimates.mean() - 0.25) < 1e-3)
    True
    """
    integrand, source = configured_scene(scene), configured_sampler(sampler)
    check_points(integrand, source, count)
    seed, count, realizations = check_seed(seed), int(count), check_positive("realizations", realizations)
    check_memory(_BYTES_PER_REALIZATION * realizations, "these estimates")
    source.prepare(count, integrand.dims)
    estimates = np.empty(realizations)

    def work(start: int, tick: Callable[[int], None]) -> NDArray[np.float64]:
        stop = min(start + _BLOCK, realizations)
        trials = source.trials(first + start, first + stop, seed, integrand.blocks)
        (means,) = integrate(integrand, source, (count,), trials, unit_square(stop - start), tick=tick)
        return np.asarray(means)

    starts, done = range(0, realizations, _BLOCK), 0
    for start, means in on_threads(work, starts, check_threads(threads)):
        estimates[start : start + means.size] = means
        done += means.size
        progress(done, realizations)
    return estimates
