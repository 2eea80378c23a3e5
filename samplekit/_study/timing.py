"""Run times: the seconds before the first sample, and the seconds of a trial, measured in many short laps.

All combinations take one lap each, then all take the next, so that a machine that slows down affects all alike. One
thread works. The first laps warm up and are not counted. A lap draws as many sets as take two milliseconds; its
seconds are scaled to those of a trial.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from samplekit._integrate.loop import Clock, integrate, unit_square

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit._bases.realizations import Realizations
    from samplekit._study.combinations import Combination
    from samplekit._study.request import Request
    from samplekit._study.resources import Resources
    from samplekit._study.store import Store
    from samplekit._study.trials import Array

    Lap = tuple[float, float, float, float]

LAP_SECONDS = 0.002
"""Length of a lap that is counted."""
ESTIMATE_SECONDS = 0.0001
"""Length of a lap that only estimates how long jobs take."""
_FEWEST, _MOST = 5, 101
"""Laps of a combination: at least, and until its median counts as known in any case."""
_NARROW = 0.02
"""Half the width of the median's interval, relative to the median, at which a combination needs no more laps."""
_QUICK = 0.1
_MOST_PIXELS = 2**18
_PLACES = 2**12


def set_up(combination: Combination, resources: Resources, progress: Callable[[int, int], None]) -> tuple[float, float]:
    """Make everything that the samples of a combination need: kernels, tables, banks of sets.

    What several combinations share is made for the first of them, and its seconds count for each.

    Parameters
    ----------
    combination, resources
        What is set up, and where it is kept.
    progress
        Called with the number of point sets done and to do.

    Returns
    -------
    Seconds by the processor's clock and by the wall clock.
    """
    scene, sampler = resources.scene(combination.scene), resources.sampler(combination.sampler)
    dims, count = combination.dims, combination.count
    resources.prepare(combination.sampler, count, dims, progress)

    def fill() -> tuple[float, float]:
        out, realizations = np.empty((1, dims, count)), sampler.trials(0, 1, 0, scene.blocks)
        return _first_call_overhead(lambda: sampler.fill(out, realizations, count, 0))

    def evaluate() -> tuple[float, float]:
        tile, box, sums = np.zeros((1, dims, 1)), unit_square(1), np.empty(1)
        return _first_call_overhead(lambda: scene.sums(tile, box, sums))

    seconds = [
        resources.once(("first points", combination.sampler, dims), fill),
        resources.once(("first values", combination.scene), evaluate),
        *resources.setup_seconds(combination.scene, combination.sampler, count, dims),
    ]
    return sum(cpu for cpu, _ in seconds), sum(wall for _, wall in seconds)


def _first_call_overhead(call: Callable[[], None]) -> tuple[float, float]:
    """Return the seconds, by processor and wall clock, that the first call takes beyond the second."""
    marks = [(time.process_time(), time.perf_counter())]
    for _ in range(2):
        call()
        marks.append((time.process_time(), time.perf_counter()))
    (cpu0, wall0), (cpu1, wall1), (cpu2, wall2) = marks
    return max(0.0, (cpu1 - cpu0) - (cpu2 - cpu1)), max(0.0, (wall1 - wall0) - (wall2 - wall1))


class TimingRun:
    """Times the sets of one combination, lap by lap, over pixels that are spread over the image.

    Attributes
    ----------
    combination
        What is timed.
    sampled
        Number of pixels of a trial that are sampled.
    """

    def __init__(self, combination: Combination, request: Request, resources: Resources) -> None:
        self.combination = combination
        self._scene = resources.scene(combination.scene)
        self._sampler = resources.sampler(combination.sampler)
        resources.prepare(combination.sampler, combination.count, combination.dims)
        self._realizations, self._boxes, self.sampled = _choose_pixels(combination, request, resources)
        self._pixels = 1
        self._next = 0
        began = time.perf_counter()
        self._sampler.prepare(combination.count, combination.dims)
        # Shared sets may have been dropped to make room for another count; loading them again is not part of a lap.
        self._quick_to_prepare = time.perf_counter() - began < _QUICK

    def warm_up(self, lap_seconds: float) -> float:
        """Run laps until one lasts ``lap_seconds``, and fix the number of pixels per lap. These laps are not counted.

        Returns
        -------
        Approximate seconds of one trial.
        """
        while True:
            _, points_wall, _, scene_wall = self._run(self._pixels)
            seconds = points_wall + scene_wall
            if seconds >= 0.7 * lap_seconds or self._pixels >= _MOST_PIXELS:
                return seconds * self.sampled / self._pixels
            wanted = int(self._pixels * min(lap_seconds / max(seconds, 1e-7), 64.0))
            self._pixels = min(max(wanted, 2 * self._pixels), _MOST_PIXELS)

    def lap(self) -> Lap:
        """Run one lap; return the seconds of one trial: of points by processor and wall clock, and of the scene."""
        factor = self.sampled / self._pixels
        points_cpu, points_wall, scene_cpu, scene_wall = self._run(self._pixels)
        return points_cpu * factor, points_wall * factor, scene_cpu * factor, scene_wall * factor

    def _run(self, pixels: int) -> Lap:
        """Return the seconds of that many pixels; pixels are used again where there are fewer."""
        count = self.combination.count
        if self._quick_to_prepare:
            self._sampler.prepare(count, self.combination.dims)
        clock = Clock(time.process_time, time.perf_counter)
        while pixels > 0:
            start = self._next % len(self._realizations)
            part = slice(start, start + min(pixels, len(self._realizations) - start))
            boxes = self._boxes[:, part]
            integrate(self._scene, self._sampler, (count,), self._realizations[part], boxes, clock=clock)
            self._next += boxes.shape[1]
            pixels -= boxes.shape[1]
        return clock.points[0], clock.points[1], clock.scene[0], clock.scene[1]


def _choose_pixels(combination: Combination, request: Request, resources: Resources) -> tuple[Realizations, Array, int]:
    """Return the realisations and boxes of the pixels to time, and the number of such pixels in a trial."""
    if request.one_pixel:
        sampler, blocks = resources.sampler(combination.sampler), resources.scene(combination.scene).blocks
        return sampler.trials(0, _PLACES, request.seed, blocks), unit_square(_PLACES), 1
    pixels = resources.pixels(combination.scene, request.size)
    if not pixels.sampled.size:
        return *pixels.locate(np.zeros(1, np.int64), request.seed), 0
    # Runs of 64 neighbouring pixels, as in an image; the runs are spread over all of it.
    last = pixels.sampled.size - 1
    runs = np.linspace(0, max(last - 63, 0), max(1, min(_PLACES, last + 1) // 64)).astype(np.int64)
    chosen = np.unique((runs[:, None] + np.arange(64)).clip(max=last).ravel())
    return *pixels.locate(pixels.sampled[chosen], request.seed), last + 1


def _is_known(totals: Array) -> bool:
    """Whether the laps float64[L] tell their median well enough."""
    lower, median, upper = np.percentile(totals, [25, 50, 75])
    # The interval of a median from the quartiles (McGill, Tukey, Larsen 1978, "Variations of box plots").
    return totals.size >= _MOST or bool(1.57 * (upper - lower) / np.sqrt(totals.size) <= _NARROW * median)


def run_laps(
    timings: list[TimingRun],
    seconds: float,
    store: Store,
    progress: Callable[[int, int], None],
) -> None:
    """Run laps in turn until all medians are known well or the time is up; each combination gets at least five laps.

    Parameters
    ----------
    timings
        The combinations, warmed up.
    seconds
        The time that is available.
    store
        It has the earlier laps, and keeps those of each round.
    progress
        Called with hundredths of a second spent and available.
    """
    began = time.perf_counter()
    # By the processor's clock, points and scene together.
    totals = {timing: list(store.laps(timing.combination)[:, [0, 2]].sum(axis=1)) for timing in timings}
    while True:
        over = time.perf_counter() - began >= seconds
        wanted = [
            timing
            for timing, known in totals.items()
            if len(known) < _FEWEST or not (over or _is_known(np.array(known)))
        ]
        if not wanted:
            return
        laps = {timing: timing.lap() for timing in wanted}
        for timing, lap in laps.items():
            totals[timing].append(lap[0] + lap[2])
        store.add_laps([(timing.combination, lap) for timing, lap in laps.items()])
        progress(int(100 * min(time.perf_counter() - began, seconds)), int(100 * seconds) + 1)
