"""Run times of a trial: the seconds for its points and for the scene, measured lap after lap.

All cells take a lap each, then all again, so that a machine that gets slower harms all alike. One thread works. The
first laps warm up and are not counted. A lap draws as many sets as take two milliseconds; its seconds are scaled to
those of a trial.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._integrate.loop import Clock, integrate, unit_square

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit._study.cells import Cell
    from samplekit._study.request import Request
    from samplekit._study.subjects import Subjects

    Array = NDArray[np.float64]
    Seconds = tuple[float, float, float, float]

FEWEST = 5
MOST = 101
NARROW = 0.02
"""Half the width of the median's interval, relative, at which a cell needs no more laps."""
LAP_SECONDS, LOOK_SECONDS = 0.002, 0.0001
"""Of a lap that counts, and of one that only tells the length of jobs."""
_QUICK = 0.1
_MOST_PIXELS = 2**18
_PLACES = 2**12


class TimingRun:
    """Times the sets of one cell, lap by lap, over pixels that are spread over the image."""

    def __init__(self, cell: Cell, request: Request, subjects: Subjects) -> None:
        self.cell = cell
        self._scene = subjects.scene(cell.scene)
        self._sampler = subjects.prepared(cell.sampler, cell.count, cell.dims)
        self._realizations, self._boxes, self.sampled = _pixels(cell, request, subjects)
        self._pixels = 1
        self._next = 0
        began = time.perf_counter()
        self._sampler.prepare(cell.count, cell.dims)
        # What is shared may have been dropped for another count's: loading it again is no part of a lap.
        self._quick_to_prepare = time.perf_counter() - began < _QUICK

    def warm_up(self, lap_seconds: float = LAP_SECONDS) -> float:
        """Run laps that are not counted, until one lasts as long; it decides how many pixels a lap has.

        Returns
        -------
        Seconds of one trial, roughly.
        """
        while True:
            _, points_wall, _, scene_wall = self._run(self._pixels)
            seconds = points_wall + scene_wall
            if seconds >= 0.7 * lap_seconds or self._pixels >= _MOST_PIXELS:
                return seconds * self.sampled / self._pixels
            wanted = int(self._pixels * min(lap_seconds / max(seconds, 1e-7), 64.0))
            self._pixels = min(max(wanted, 2 * self._pixels), _MOST_PIXELS)

    def lap(self) -> Seconds:
        """Return the seconds of one trial, from one lap."""
        factor = self.sampled / self._pixels
        points_cpu, points_wall, scene_cpu, scene_wall = self._run(self._pixels)
        return points_cpu * factor, points_wall * factor, scene_cpu * factor, scene_wall * factor

    def _run(self, pixels: int) -> Seconds:
        """Return the seconds for so many pixels; where there are fewer, some are used again."""
        if self._quick_to_prepare:
            self._sampler.prepare(self.cell.count, self.cell.dims)
        clock = Clock(time.process_time, time.perf_counter)
        while pixels > 0:
            start = self._next % len(self._realizations)
            part = slice(start, start + min(pixels, len(self._realizations) - start))
            boxes = self._boxes[:, part]
            integrate(self._scene, self._sampler, (self.cell.count,), self._realizations[part], boxes, clock=clock)
            self._next += boxes.shape[1]
            pixels -= boxes.shape[1]
        return clock.points[0], clock.points[1], clock.scene[0], clock.scene[1]


def _pixels(cell: Cell, request: Request, subjects: Subjects) -> tuple[Realizations, Array, int]:
    """Return pixels to time, their boxes, and how many such pixels a trial has."""
    if request.one_pixel:
        trials = np.arange(_PLACES, dtype=np.int64)
        realizations = Realizations.of_pixels(
            trials, np.ones_like(trials), request.seed, subjects.scene(cell.scene).blocks
        )
        return realizations, unit_square(trials.size), 1
    pixels = subjects.pixels(cell.scene, request.size)
    if not pixels.sampled.size:
        return *pixels.locate(np.zeros(1, np.int64), request.seed), 0
    # Some run on from each other as in an image, the runs are spread over all of it.
    last = pixels.sampled.size - 1
    runs = np.linspace(0, max(last - 63, 0), max(1, min(_PLACES, last + 1) // 64)).astype(np.int64)
    chosen = np.unique((runs[:, None] + np.arange(64)).clip(max=last).ravel())
    return *pixels.locate(pixels.sampled[chosen], request.seed), last + 1


def narrow(totals: Array) -> bool:
    """Whether the median of laps float64[L] is known well enough."""
    if totals.size < FEWEST:
        return False
    lower, median, upper = np.percentile(totals, [25, 50, 75])
    # The interval of a median from the quartiles (McGill, Tukey, Larsen 1978, "Variations of box plots").
    return totals.size >= MOST or bool(1.57 * (upper - lower) / np.sqrt(totals.size) <= NARROW * median)


def run_laps(
    timings: list[TimingRun],
    seconds: float,
    known: Callable[[Cell], Array],
    keep: Callable[[list[tuple[Cell, Seconds]]], None],
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> None:
    """Take laps in turn until all are known well or the time is up; at least the fewest in any case.

    Parameters
    ----------
    timings
        Warmed up.
    seconds
        The time there is.
    known
        The totals float64[L] of a cell's laps so far.
    keep
        Takes the laps of each round.
    progress
        Takes hundredths of the time done and to do.
    """
    began = time.perf_counter()
    totals = {timing.cell: list(known(timing.cell)) for timing in timings}
    while True:
        over = time.perf_counter() - began >= seconds
        wanted = [
            timing
            for timing in timings
            if len(totals[timing.cell]) < FEWEST or not (over or narrow(np.array(totals[timing.cell])))
        ]
        if not wanted:
            return
        laps = [(timing.cell, timing.lap()) for timing in wanted]
        for cell, lap in laps:
            totals[cell].append(lap[0] + lap[2])
        keep(laps)
        progress(int(100 * min(time.perf_counter() - began, seconds)), int(100 * seconds) + 1)
