"""The Python interface: the functions that the commands are thin shells of."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations, check_seed
from samplekit._chosen.sampler import ConfiguredSampler, configured_sampler
from samplekit._chosen.scene import ConfiguredScene, configured_scene
from samplekit._integrate.loop import UNIT_SQUARE, Estimator, Seconds
from samplekit._integrate.plan import check_points, make_plan
from samplekit._integrate.rendering import Rendering, render_plan
from samplekit._memory import check_memory
from samplekit._parsing import check_positive
from samplekit._registry import Plugin, registry

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec, SceneSpec

_BYTES_PER_REALIZATION = 9 * 8
"""Its estimate and sum, its box of four numbers, its key and its pixel."""

sampler = configured_sampler
scene = configured_scene


def _sampler(choice: str | ConfiguredSampler) -> ConfiguredSampler:
    return configured_sampler(choice) if isinstance(choice, str) else choice


def _scene(choice: str | ConfiguredScene) -> ConfiguredScene:
    return configured_scene(choice) if isinstance(choice, str) else choice


def points(
    sampler: str | ConfiguredSampler, count: int, dims: int = 2, *, realizations: int = 1, seed: int = 0
) -> NDArray[np.float64]:
    """Points of a sampler.

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
    return _sampler(sampler).points(count, dims, realizations=realizations, seed=seed)


def render(
    scene: str | ConfiguredScene,
    sampler: str | ConfiguredSampler,
    spp: int,
    *,
    size: tuple[int, int] = (512, 512),
    crop: tuple[int, int, int, int] | None = None,
    seed: int = 0,
    threads: int | None = None,
    error: bool = True,
    full: bool = False,
    ssim: bool = False,
    flip: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Rendering:
    """Render a scene, integrating every pixel with samples.

    Parameters
    ----------
    scene, sampler
        As on the command line, or what :func:`samplekit.scene` and :func:`samplekit.sampler` returned.
    spp
        Samples per pixel.
    size
        (width, height) in pixels.
    crop
        (x, y, width, height) of the part that is rendered; equal to the same pixels of the whole.
    seed
        From 0 to 2^64 - 1.
    threads
        None: as many as there are processors. The image does not depend on it.
    error
        Compute the exact reference, the error and the metrics.
    full
        Sample pixels in which the scene is constant as well; the image is the same bit for bit.
    ssim, flip
        Compute these metrics as well.
    progress
        Called with the numbers of samples done and to do.

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        A plugin failed.

    Examples
    --------
    >>> import samplekit
    >>> result = samplekit.render("disk:radius=0.25", "jittered", spp=16, size=(32, 32), seed=1)
    >>> result.image.shape, result.metrics["pixels_sampled"] < 200
    ((32, 32), True)
    """
    plan = make_plan(_scene(scene), _sampler(sampler), spp, size=size, crop=crop, seed=seed, full=full, reference=error)
    return render_plan(plan, threads=threads, progress=progress, ssim=ssim, flip=flip)


def estimate(
    scene: str | ConfiguredScene,
    sampler: str | ConfiguredSampler,
    count: int,
    *,
    realizations: int = 1,
    seed: int = 0,
) -> NDArray[np.float64]:
    """Estimates of the scene's mean over the unit square as one pixel, float64[realizations].

    Parameters
    ----------
    scene, sampler
        As on the command line, or what :func:`samplekit.scene` and :func:`samplekit.sampler` returned.
    count
        Samples of each estimate.
    realizations
        Number of independent estimates.
    seed
        From 0 to 2^64 - 1.

    Raises
    ------
    UsageError
        The request cannot be carried out.

    Examples
    --------
    >>> import samplekit
    >>> estimates = samplekit.estimate("bilinear", "jittered", count=256, realizations=100)
    >>> bool(abs(estimates.mean() - 0.25) < 1e-3)
    True
    """
    integrand, source = _scene(scene), _sampler(sampler)
    check_points(integrand, source, count)
    seed, count, realizations = check_seed(seed), int(count), check_positive("realizations", realizations)
    check_memory(_BYTES_PER_REALIZATION * realizations, "these estimates")
    source.prepare(count, integrand.dims)
    boxes = np.repeat(np.array(UNIT_SQUARE)[:, None], realizations, axis=1)
    return Estimator(integrand, source, count).means(
        Realizations.of_trials(0, realizations, seed, integrand.blocks), boxes, Seconds()
    )


def samplers() -> list[SamplerSpec]:
    """The declarations of all samplers, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [spec.name for spec in samplekit.samplers() if spec.progressive == samplekit.AnyCount()][:2]
    ['halton', 'r2']
    """
    return [offer.spec for offer in registry().all("sampler").values()]


def scenes() -> list[SceneSpec]:
    """The declarations of all scenes, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [option.name for spec in samplekit.scenes() if spec.name == "zoneplate" for option in spec.options]
    ['k', 'cx', 'cy', 'pixel-filter']
    """
    return [offer.spec for offer in registry().all("scene").values()]


def plugins() -> list[Plugin]:
    """All plugins that are installed, also those that failed, with their problems.

    Examples
    --------
    >>> import samplekit
    >>> "lattice" in [plugin.name for plugin in samplekit.plugins()]
    True
    """
    registry().discover()
    return registry().plugins
