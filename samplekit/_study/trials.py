"""Carrying out a job: its trials drawn, evaluated, compared with the reference, and summed in batches.

A trial of the unit square takes the realisation of a pixel far from those of the others, so that samplers that spread
error over the pixels of an image cannot tie trials together; a trial of an image takes a seed of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations, seed_word
from samplekit._integrate.loop import integrate, unit_square
from samplekit._study.blurred import blurred_mean_square
from samplekit.kernels._compile import kernel

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._study.jobs import Job
    from samplekit._study.subjects import Subjects

    Array = NDArray[np.float64]
    Tick = Callable[[int], None]

TRIALS, ERROR, SQUARE, PAIRS, PRODUCT, BLURRED, INVALID = range(7)
"""Columns of what a job gives: number of trials; sums over them of the error, of its square (for an image: means over
its pixels), over pairs of neighbouring trials (their number; the product of their errors), of the square of the blurred
error; number of pixels that are not finite."""
COLUMNS = 7
_STRIDE = 4099
"""Pixels between trials: a prime, so that no tile or period of a sampler gives two the same place within it."""
_ROW = 2**20
_STEP = 0xD1342543DE82EF95
_PIXELS_AT_ONCE = 2**16


def seed_of(seed: int, trial: int) -> int:
    """The seed of an image: that of the study for the first, hashed for the others."""
    return int(seed_word((seed + trial * _STEP) % 2**64)) if trial else seed


def carry_out(job: Job, subjects: Subjects, tick: Tick = lambda _: None) -> Array:
    """Do a job.

    Returns
    -------
    float64[counts, batches, COLUMNS]

    Raises
    ------
    SamplekitError
        A plugin failed.
    """
    subjects.prepared(job.sampler, job.counts[-1], subjects.scene(job.scene).dims)
    with np.errstate(all="ignore"):
        return _of_square(job, subjects, tick) if job.size == (1, 1) else _of_images(job, subjects, tick)


def _of_square(job: Job, subjects: Subjects, tick: Tick) -> Array:
    scene = subjects.scene(job.scene)
    trial = np.arange(job.first, job.last, dtype=np.int64)
    row = np.zeros_like(trial) if job.last <= _ROW else trial // _ROW
    realizations = Realizations.of_pixels((trial - row * _ROW) * _STRIDE, row * _STRIDE, job.seed, scene.blocks)
    means = _means(job, subjects, realizations, unit_square(trial.size), tick)
    errors = means - subjects.reference(job.scene, (1, 1)).image[0, 0]
    return np.stack([_batches(row, job.batch) for row in errors])


@kernel("void(float64[::1], int64, float64[:,::1])")
def _sum_batches(errors: Array, batch: int, columns: Array) -> None:
    """Write the sums over batches of the errors float64[T] of single pixels to float64[B, COLUMNS], which are 0."""
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


def _batches(errors: Array, batch: int) -> Array:
    columns = np.zeros((-(-errors.size // batch), COLUMNS))
    _sum_batches(np.ascontiguousarray(errors), batch, columns)
    return columns


def _means(job: Job, subjects: Subjects, realizations: Realizations, boxes: Array, tick: Tick) -> Array:
    """The estimates float64[counts, P]."""
    scene, sampler = subjects.scene(job.scene), subjects.sampler(job.sampler)
    return integrate(scene, sampler, job.counts, realizations, boxes, tick=tick)


def _of_images(job: Job, subjects: Subjects, tick: Tick) -> Array:
    reference = subjects.reference(job.scene, job.size).image.ravel()
    pixels = subjects.pixels(job.scene, job.size)
    constant = np.stack([_constant_means(job, subjects, count) for count in job.counts])
    rows = np.zeros((job.last - job.first, len(job.counts), COLUMNS))
    previous = np.empty((len(job.counts), reference.size))
    for number, trial in enumerate(range(job.first, job.last)):
        images = constant.copy()
        seed = seed_of(job.seed, trial)
        for start in range(0, pixels.sampled.size, _PIXELS_AT_ONCE):
            part = pixels.sampled[start : start + _PIXELS_AT_ONCE]
            images[:, part] = _means(job, subjects, *pixels.locate(part, seed), tick)
        errors = images - reference
        for row, error in enumerate(errors):
            rows[number, row] = _of_image(error, job.size)
            if trial % 2 == 1 and number > 0:
                rows[number - 1, row, PAIRS : PRODUCT + 1] = _product(error, previous[row])
        previous = errors
    starts = np.arange(0, job.last - job.first, job.batch)
    return np.add.reduceat(rows, starts, axis=0).transpose(1, 0, 2)


def _of_image(error: Array, size: tuple[int, int]) -> Array:
    """The columns of one image's error float64[P], those of its pair left 0."""
    columns = np.zeros(COLUMNS)
    valid = np.isfinite(error * error)
    if not valid.any():
        columns[INVALID] = error.size
        return columns
    shape = size[1], size[0]
    shown = error if valid.all() else np.where(valid, error, 0.0)
    blurred = blurred_mean_square(shown.reshape(shape), valid.reshape(shape))
    error = error if valid.all() else error[valid]
    columns[[TRIALS, ERROR, SQUARE, BLURRED]] = 1.0, _mean(error), _mean(error * error), blurred
    columns[INVALID] = valid.size - error.size
    return columns


def _product(error: Array, other: Array) -> tuple[float, float]:
    """1 and the mean product of the errors of a pair; 0 and 0 where no pixel has both."""
    products = error * other
    mean = _mean(products)
    if not np.isfinite(mean):
        products = products[np.isfinite(products)]
        mean = _mean(products)
    return float(products.size > 0), mean


def _mean(values: Array) -> float:
    return float(values.mean()) if values.size else 0.0


def _constant_means(job: Job, subjects: Subjects, count: int) -> Array:
    """Return the image float64[P] of the pixels that are not sampled, NaN elsewhere."""
    pixels = subjects.pixels(job.scene, job.size)
    return subjects.kept(("constant means", job.scene, job.size, count), lambda: pixels.constant_means(count))
