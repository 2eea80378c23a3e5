"""Carry out a job: draw its trials, evaluate the scene, compare with the reference, and sum the errors in batches.

A trial of the unit square takes the realisation of a pixel far from those of the other trials, and a trial of an image
its own seed: samplers that spread error over neighbouring pixels of an image cannot correlate the trials.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from samplekit._bases.realizations import seed_words
from samplekit._integrate.loop import integrate, unit_square
from samplekit._study.blurred import blurred_mean_square
from samplekit._study.request import UNIT_SQUARE
from samplekit._study.resources import OF_PROCESS, Resources
from samplekit.kernels import kernel

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit._study.jobs import Job

    Tick = Callable[[int], None]

Array = NDArray[np.float64]

TRIALS, ERROR, SQUARE, PAIRS, PRODUCT, BLURRED, INVALID = range(7)
"""Columns of the sums of a batch.

``TRIALS``: number of trials. ``ERROR``, ``SQUARE``, ``BLURRED``: sums over the trials of the error, of its square, and
of the square of the blurred error; for an image, of their means over its pixels. ``PAIRS``, ``PRODUCT``: number of
pairs of neighbouring trials, and the sum of the products of their errors. ``INVALID``: number of pixels that are not
finite.
"""
COLUMNS = 7
_STRIDE = 4099
"""Pixels between trials: a prime, so that no two trials have the same place in a tile or a period of a sampler."""
_STEP = 0xD1342543DE82EF95
_PIXELS_AT_ONCE = 2**16


def seed_of(seed: int, trial: int) -> int:
    """Return the seed of an image: the seed of the study for trial 0, a hash of it for all others."""
    return int(seed_words((seed + trial * _STEP) % 2**64)[0]) if trial else seed


def carry_out(job: Job, resources: Resources = OF_PROCESS, tick: Tick = lambda _: None) -> Array:
    """Carry out a job.

    Parameters
    ----------
    job, resources
        The job, and the objects that it names; a worker process uses its own.
    tick
        Called now and then with the number of samples done since the last call.

    Returns
    -------
    float64[counts, batches, COLUMNS]

    Raises
    ------
    SamplekitError
        A plugin failed.
    """
    resources.prepare(job.sampler, job.counts[-1], resources.scene(job.scene).dims)
    with np.errstate(all="ignore"):
        sum_trials = _sum_squares if job.size == UNIT_SQUARE else _sum_images
        return sum_trials(job, resources, tick)


def _sum_squares(job: Job, resources: Resources, tick: Tick) -> Array:
    """Sum trials of the unit square: float64[counts, batches, COLUMNS]."""
    scene, sampler = resources.scene(job.scene), resources.sampler(job.sampler)
    trials = sampler.trials(job.first, job.last, job.seed, scene.blocks, apart=_STRIDE)
    means = integrate(scene, sampler, job.counts, trials, unit_square(len(trials)), tick=tick)
    errors = means - resources.reference(job.scene, UNIT_SQUARE).image[0, 0]
    sums = np.zeros((len(errors), -(-len(trials) // job.batch), COLUMNS))
    for own, batches in zip(errors, sums, strict=True):
        _sum_batches(own, job.batch, batches)
    return sums


@kernel("void(float64[::1], int64, float64[:,::1])")
def _sum_batches(errors: Array, batch: int, columns: Array) -> None:
    """Add the errors float64[T] of single pixels, batch by batch, to float64[B, COLUMNS], which holds zeros."""
    for b in range(columns.shape[0]):
        first = b * batch
        last = min(first + batch, errors.size)
        for t in range(first, last):
            square = errors[t] * errors[t]
            if not np.isfinite(square):
                columns[b, INVALID] += 1.0
                continue
            columns[b, TRIALS] += 1.0
            columns[b, ERROR] += errors[t]
            columns[b, SQUARE] += square
            # Batches begin at even trials, and so do jobs.
            if t % 2 == 0 and t + 1 < errors.size and np.isfinite(errors[t + 1] * errors[t + 1]):
                columns[b, PAIRS] += 1.0
                columns[b, PRODUCT] += errors[t] * errors[t + 1]


def _sum_images(job: Job, resources: Resources, tick: Tick) -> Array:
    """Sum trials of images: float64[counts, batches, COLUMNS]."""
    scene, sampler = resources.scene(job.scene), resources.sampler(job.sampler)
    reference = resources.reference(job.scene, job.size).image.ravel()
    pixels = resources.pixels(job.scene, job.size)

    def constant_means(count: int) -> Array:
        return resources.once(("constant means", job.scene, job.size, count), lambda: pixels.constant_means(count))

    constant = np.stack([constant_means(count) for count in job.counts])
    rows = np.zeros((job.last - job.first, len(job.counts), COLUMNS))
    previous = np.empty((len(job.counts), reference.size))
    for number, trial in enumerate(range(job.first, job.last)):
        images = constant.copy()
        seed = seed_of(job.seed, trial)
        for start in range(0, pixels.sampled.size, _PIXELS_AT_ONCE):
            part = pixels.sampled[start : start + _PIXELS_AT_ONCE]
            images[:, part] = integrate(scene, sampler, job.counts, *pixels.locate(part, seed), tick=tick)
        errors = images - reference
        for row, error in enumerate(errors):
            rows[number, row] = _sum_image(error, job.size)
            if trial % 2 == 1 and number > 0:
                rows[number - 1, row, PAIRS : PRODUCT + 1] = _sum_pair(error, previous[row])
        previous = errors
    starts = np.arange(0, job.last - job.first, job.batch)
    return np.add.reduceat(rows, starts, axis=0).transpose(1, 0, 2)


def _sum_image(error: Array, size: tuple[int, int]) -> Array:
    """Return the columns of one image with the error float64[P]; those of its pair are 0."""
    columns = np.zeros(COLUMNS)
    valid = np.isfinite(error * error)
    finite = error if valid.all() else error[valid]
    columns[INVALID] = error.size - finite.size
    if finite.size:
        shape = size[1], size[0]
        blurred = blurred_mean_square(error.reshape(shape), valid.reshape(shape))
        columns[[TRIALS, ERROR, SQUARE, BLURRED]] = 1.0, finite.mean(), (finite * finite).mean(), blurred
    return columns


def _sum_pair(error: Array, other: Array) -> tuple[float, float]:
    """Return 1 and the mean product of the errors of two images; 0 and 0 if no pixel is finite in both."""
    products = error * other
    mean = products.mean()
    if not np.isfinite(mean):
        products = products[np.isfinite(products)]
        mean = products.mean() if products.size else 0.0
    return float(products.size > 0), float(mean)
