"""Run times: how long the points of a trial take, and the scene, measured again and again in turn.

All cells take a lap each, then all again: a machine that gets slower harms all alike. One thread; the first laps warm
up and are not counted. A lap draws as many sets as last two milliseconds; its seconds are scaled to a trial.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._integrate.loop import TILE_BYTES, UNIT_SQUARE
from samplekit._integrate.pixels import locate
from samplekit._integrate.plan import make_plan
from samplekit.kernels._sums import BLOCK

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


class Course:
    """What a cell's laps run over: sets of as many pixels as fill some milliseconds, spread over the image."""

    def __init__(self, cell: Cell, request: Request, subjects: Subjects) -> None:
        self.cell = cell
        self._scene = subjects.scene(cell.scene)
        self._sampler = subjects.prepared(cell.sampler, cell.count, cell.dims)
        self._realizations, self._boxes, self.sampled = _pixels(cell, request, subjects)
        points = min(cell.count, BLOCK) if self._sampler.streams else cell.count
        self._at_once = min(len(self._realizations), max(1, TILE_BYTES // (8 * cell.dims * points)))
        self._buffer = np.empty(self._at_once * cell.dims * points)
        self._pixels = 1
        self._next = 0
        began = time.perf_counter()
        self._sampler.prepare(cell.count, cell.dims)
        # What is shared may have been dropped for another count's: loading it again is no part of a lap.
        self._quick_to_prepare = time.perf_counter() - began < _QUICK

    def warm_up(self, lap_seconds: float = LAP_SECONDS) -> float:
        """Run laps that are not counted, until one lasts as long; it tells how many pixels the others have.

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
        """The seconds of one trial, from one lap."""
        factor = self.sampled / self._pixels
        points_cpu, points_wall, scene_cpu, scene_wall = self._run(self._pixels)
        return points_cpu * factor, points_wall * factor, scene_cpu * factor, scene_wall * factor

    def _run(self, pixels: int) -> Seconds:
        """Seconds for so many pixels; where there are fewer, for some of them again."""
        if self._quick_to_prepare:
            self._sampler.prepare(self.cell.count, self.cell.dims)
        parts = []
        for first in range(0, pixels, self._at_once):
            start = (self._next + first) % (len(self._realizations) - self._at_once + 1)
            part = slice(start, start + min(self._at_once, pixels - first))
            parts.append((self._realizations[part], self._boxes[:, part].copy()))
        self._next += pixels
        # Apart, so that reading the clocks weighs nothing; points and sums stay in the cache as when they take turns.
        marks = [_clocks()]
        for realizations, _ in parts:
            self._fill(realizations)
        marks.append(_clocks())
        for _, boxes in parts:
            self._evaluate(boxes)
        marks.append(_clocks())
        (cpu0, wall0), (cpu1, wall1), (cpu2, wall2) = marks
        return cpu1 - cpu0, wall1 - wall0, cpu2 - cpu1, wall2 - wall1

    def _fill(self, realizations: Realizations) -> None:
        count, dims, pixels = self.cell.count, self.cell.dims, len(realizations)
        step = BLOCK if self._sampler.streams else count
        for first in range(0, count, step):
            length = min(step, count - first)
            tile = self._buffer[: pixels * dims * length].reshape(pixels, dims, length)
            self._sampler.fill(tile, realizations, count, first)

    def _evaluate(self, boxes: Array) -> None:
        count, dims, pixels = self.cell.count, self.cell.dims, boxes.shape[1]
        sums = np.empty(pixels)
        for first in range(0, count, BLOCK):
            length = min(BLOCK, count - first)
            tile = self._buffer[: pixels * dims * length].reshape(pixels, dims, length)
            self._scene.sums(tile, boxes, sums)


def _clocks() -> tuple[float, float]:
    return time.process_time(), time.perf_counter()


def _pixels(cell: Cell, request: Request, subjects: Subjects) -> tuple[Realizations, Array, int]:
    """Pixels to time, with their boxes, and how many of such a trial has."""
    scene = subjects.scene(cell.scene)
    if request.one_pixel:
        trials = np.arange(_PLACES, dtype=np.int64)
        realizations = Realizations.of_pixels(trials, np.ones_like(trials), request.seed, scene.blocks)
        return realizations, np.repeat(np.array(UNIT_SQUARE)[:, None], trials.size, axis=1), 1
    plan = make_plan(
        scene, subjects.sampler(cell.sampler), cell.count, size=request.size, seed=request.seed, reference=False
    )
    sampled = subjects.sampled(cell.scene, request.size)
    if not sampled.size:
        return *locate(np.zeros(1, np.int64), plan), 0
    # Some run on from each other as in an image, the runs are spread over all of it.
    runs = np.linspace(0, max(sampled.size - 64, 0), max(1, min(_PLACES, sampled.size) // 64)).astype(np.int64)
    chosen = np.unique((runs[:, None] + np.arange(64)).clip(max=sampled.size - 1).ravel())
    return *locate(sampled[chosen], plan), int(sampled.size)


def narrow(totals: Array) -> bool:
    """Whether the median of laps float64[L] is known well enough."""
    if totals.size < FEWEST:
        return False
    lower, median, upper = np.percentile(totals, [25, 50, 75])
    # The interval of a median from the quartiles (McGill, Tukey, Larsen 1978, "Variations of box plots").
    return totals.size >= MOST or bool(1.57 * (upper - lower) / np.sqrt(totals.size) <= NARROW * median)


def run_laps(
    courses: list[Course],
    seconds: float,
    known: Callable[[Cell], Array],
    keep: Callable[[list[tuple[Cell, Seconds]]], None],
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> None:
    """Take laps in turn until all are known well or the time is up; at least the fewest in any case.

    Parameters
    ----------
    courses
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
    totals = {course.cell: list(known(course.cell)) for course in courses}
    while True:
        over = time.perf_counter() - began >= seconds
        wanted = [
            course
            for course in courses
            if len(totals[course.cell]) < FEWEST or not (over or narrow(np.array(totals[course.cell])))
        ]
        if not wanted:
            return
        laps = [(course.cell, course.lap()) for course in wanted]
        for cell, lap in laps:
            totals[cell].append(lap[0] + lap[2])
        keep(laps)
        progress(int(100 * min(time.perf_counter() - began, seconds)), int(100 * seconds) + 1)
