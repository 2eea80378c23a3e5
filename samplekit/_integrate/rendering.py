"""Rendering: a plan's pixels, in tiles and on threads, into an image with its reference and error."""

from __future__ import annotations

import math
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit._integrate.loop import TILE_BYTES, Estimator, Seconds
from samplekit._integrate.pixels import locate
from samplekit._integrate.threads import asking_for, check_threads

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._integrate.plan import Plan

_JOBS_PER_THREAD = 8


@dataclass(frozen=True)
class Rendering:
    """A rendered image.

    Attributes
    ----------
    image
        float64[h, w].
    reference, error
        float64[h, w], the exact image and image - reference; None when they were left out.
    metrics
        Names of ``--json`` to numbers.
    seconds
        ``setup`` (what the sets share), ``points`` and ``scene`` summed over threads, ``reference`` and ``total`` by
        the wall clock.
    plan
        What was rendered.
    reference_kind
        How exact the reference is, in words; empty when it was left out.
    """

    image: NDArray[np.float64]
    reference: NDArray[np.float64] | None
    error: NDArray[np.float64] | None
    metrics: dict[str, float]
    seconds: dict[str, float]
    plan: Plan = field(repr=False)
    reference_kind: str = ""


def render_plan(
    plan: Plan,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
    preparing: Callable[[int, int], None] = lambda _, __: None,
    tile_bytes: int | None = None,
    ssim: bool = False,
    flip: bool = False,
) -> Rendering:
    """Carry out a plan.

    Parameters
    ----------
    plan
        From :func:`make_plan`.
    threads
        At least 1; None: as many as there are processors. The image does not depend on it.
    progress
        Called with the numbers of samples done and to do.
    preparing
        Called with the numbers of steps done and to do while the sampler makes what its sets share.
    tile_bytes
        Size of a tile of points. The image does not depend on it.
    ssim, flip
        Compute these metrics as well.

    Raises
    ------
    UsageError
        Fewer than one thread; metrics without a reference, or SSIM of an image that is too small for it.
    SamplekitError
        A plugin failed.
    """
    threads = check_threads(threads)
    _check_metrics(plan, ssim, flip)
    if plan.reference:
        # One that cannot be given is told before the samples are drawn, not after.
        plan.scene.check_reference(plan.x_edges[:2], plan.y_edges[:2])
    began = time.perf_counter()
    estimator = Estimator(plan.scene, plan.sampler, plan.count, tile_bytes or TILE_BYTES)
    plan.sampler.prepare(plan.count, plan.scene.dims, preparing)
    setup_seconds = time.perf_counter() - began
    share = math.ceil(plan.sampled.size / (threads * _JOBS_PER_THREAD))
    job_pixels = math.ceil(share / estimator.pixels_per_tile) * estimator.pixels_per_tile
    image = np.empty(plan.pixels)
    _fill_constant(image, plan, estimator)
    jobs = [plan.sampled[first : first + job_pixels] for first in range(0, plan.sampled.size, max(1, job_pixels))]
    clock = _Clock(progress, plan.sampled.size * plan.count)
    if threads == 1 or len(jobs) <= 1:
        for job in jobs:
            image[job] = _means(job, plan, estimator, clock)
    else:
        _run_on_threads(jobs, threads, plan, estimator, clock, image)
    invalid = plan.sampled[~np.isfinite(image[plan.sampled])]
    metrics: dict[str, float] = {}
    if not np.isfinite(image).all():
        metrics["invalid_samples"] = estimator.invalid_samples(*locate(invalid, plan))
        metrics["invalid_pixels"] = int(np.count_nonzero(~np.isfinite(image)))
    shaped = image.reshape(plan.window[3], plan.window[2])
    reference = error = None
    reference_kind = ""
    reference_began = time.perf_counter()
    if plan.reference:
        from samplekit._metrics import metrics as image_metrics

        with asking_for(threads):
            exact = plan.scene.reference(plan.x_edges, plan.y_edges)
        reference, reference_kind = exact.image, exact.kind
        reference_seconds = time.perf_counter() - reference_began
        error = shaped - reference
        metrics |= image_metrics(shaped, reference, ssim=ssim, flip=flip)
        if exact.error > 0.0:
            metrics["reference_error"] = exact.error
    metrics |= {
        "samples": int(plan.sampled.size) * plan.count,
        "dims": plan.scene.dims,
        "pixels_sampled": int(plan.sampled.size),
        "pixels_left_out": plan.pixels - int(plan.sampled.size),
    }
    seconds = {
        "setup": setup_seconds,
        "points": clock.seconds.points,
        "scene": clock.seconds.scene,
        "reference": reference_seconds if plan.reference else 0.0,
        "total": time.perf_counter() - began,
    }
    return Rendering(shaped, reference, error, metrics, seconds, plan, reference_kind)


def _check_metrics(plan: Plan, ssim: bool, flip: bool) -> None:
    if (ssim or flip) and not plan.reference:
        raise UsageError("ssim and flip compare with the reference, which is left out")
    if ssim:
        from samplekit._metrics import check_ssim

        check_ssim(plan.window[2:])


class _Clock:
    """Progress and times from all threads, and the word to stop."""

    def __init__(self, progress: Callable[[int, int], None] | None, total: int) -> None:
        self.seconds = Seconds()
        self.stop = threading.Event()
        self._progress = progress
        self._total = total
        self._done = 0
        self._lock = threading.Lock()

    def tick(self, samples: int) -> None:
        if self.stop.is_set():
            raise _StoppedError
        if self._progress is not None:
            with self._lock:
                self._done += samples
                self._progress(self._done, self._total)

    def add(self, seconds: Seconds) -> None:
        with self._lock:
            self.seconds.points += seconds.points
            self.seconds.scene += seconds.scene


class _StoppedError(Exception):
    """Another thread failed, or the user interrupted."""


def _fill_constant(image: NDArray[np.float64], plan: Plan, estimator: Estimator) -> None:
    if plan.sampled.size == plan.pixels:
        return
    constant = plan.constant.ravel()
    rest = np.flatnonzero(~np.isnan(constant))
    constant = constant[rest]
    # Neighbours are mostly equal: a run of them counts once, which is many times as fast as sorting all pixels.
    starts = np.flatnonzero(np.concatenate([[True], constant[1:] != constant[:-1]]))
    values, place = np.unique(constant[starts], return_inverse=True)
    means = np.array([estimator.mean_of_constant(float(value)) for value in values])
    image[rest] = np.repeat(means[place], np.diff(starts, append=rest.size))


def _means(job: NDArray[np.int64], plan: Plan, estimator: Estimator, clock: _Clock) -> NDArray[np.float64]:
    seconds = Seconds()
    try:
        means = estimator.means(*locate(job, plan), seconds, clock.tick)
    except BaseException:
        # At once, so that the other threads stop at their next tile and not when this one's failure is noticed.
        clock.stop.set()
        raise
    clock.add(seconds)
    return means


def _run_on_threads(
    jobs: list[NDArray[np.int64]],
    threads: int,
    plan: Plan,
    estimator: Estimator,
    clock: _Clock,
    image: NDArray[np.float64],
) -> None:
    with ThreadPoolExecutor(threads) as pool:
        futures: dict[Future[NDArray[np.float64]], NDArray[np.int64]] = {}
        try:
            # Here as well an interrupt must stop what has begun: leaving the pool waits for all of it.
            for job in jobs:
                futures[pool.submit(_means, job, plan, estimator, clock)] = job
            for future in as_completed(futures):
                image[futures[future]] = future.result()
        except BaseException as error:
            clock.stop.set()
            pool.shutdown(wait=True, cancel_futures=True)
            if not isinstance(error, _StoppedError):
                raise
            failures = (future.exception() for future in futures if not future.cancelled())
            raise next(failure for failure in failures if failure and not isinstance(failure, _StoppedError)) from None
