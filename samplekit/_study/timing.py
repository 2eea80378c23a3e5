"""Run times: the seconds before the first sample, and the seconds of a trial, measured in many short laps.

Laps are taken in rounds that are spread over the study, while nothing else of the study runs. In a round all
combinations take one lap each, then all take the next, so that a machine that slows down affects all alike. A lap lasts
about two milliseconds or longer and has at least 64 pixels; its seconds are scaled to those of a trial.

A lap that another process disturbs is an outlier, and laps that follow each other are not independent. So the laps of
a combination in a round count as one value, their median, and intervals are taken over rounds.
"""

from __future__ import annotations

import math
import time
import warnings
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import bdtr

from samplekit._integrate.loop import Clock, integrate, unit_square
from samplekit._study.results import LEVEL, Interval

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from samplekit._bases.realizations import Realizations
    from samplekit._study.combinations import Combination
    from samplekit._study.request import Request
    from samplekit._study.resources import Resources
    from samplekit._study.store import Store
    from samplekit._study.trials import Array

    Lap = tuple[float, float, float, float]

ROUNDS = 9
"""Rounds of a study: so many that one outlier among them does not reach the interval."""
LAP_SECONDS = 0.002
"""Length of a lap that is counted."""
ESTIMATE_SECONDS = 0.0001
"""Length of a lap that only estimates how long jobs take."""
_LEAST_PIXELS, _MOST_PIXELS = 64, 2**18
_MANY = 16
"""A lap may have fewer pixels than the least number if it is this many times as long as a lap must be."""
_CALLS = 3
"""The fastest of this many calls tells how long a lap is, so that one slow call does not."""
_MOST_LAPS = 12
"""Most laps of a combination in one round."""
_PATIENCE = 4.0
"""Seconds by the wall clock that may pass for each second of the budget, which is the processor's."""
_QUICK = 0.1
_PLACES = 2**12
_NEIGHBOURS = 8
"""Number of neighbouring pixels in a group; the groups are spread over the image."""
_POLISHINGS = 10
"""Steps of the fit by medians; it hardly changes after three."""


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
        out = np.empty((1, dims, 1 if sampler.streams else count))
        realizations = sampler.trials(0, 1, 0, scene.blocks)
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
    lap_seconds
        Approximate length of a lap by the wall clock, once it has been warmed up.
    """

    def __init__(self, combination: Combination, request: Request, resources: Resources) -> None:
        self.combination = combination
        self.lap_seconds = 0.0
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
        """Fix the number of pixels per lap: so many that a lap lasts about ``lap_seconds``, and at least 64.

        A lap that lasts much longer may have fewer pixels, and an image may have fewer. No call of this method counts
        as a lap.

        Returns
        -------
        Approximate seconds of one trial.
        """
        least = min(_LEAST_PIXELS, self.sampled)
        enough = 0.7 * lap_seconds
        while True:
            seconds = self._fastest_call(enough)
            many = self._pixels >= least or seconds >= _MANY * lap_seconds
            if (seconds >= enough and many) or self._pixels >= _MOST_PIXELS:
                self.lap_seconds = seconds
                return seconds * self.sampled / self._pixels
            wanted = int(self._pixels * min(lap_seconds / max(seconds, 1e-7), 64.0))
            self._pixels = min(max(wanted, 2 * self._pixels), _MOST_PIXELS)

    def _fastest_call(self, enough: float) -> float:
        """Return the wall-clock seconds of the fastest of several laps, or of the first that is not long enough."""
        fastest = math.inf
        for _ in range(_CALLS):
            _, points_wall, _, scene_wall = self._run(self._pixels)
            fastest = min(fastest, points_wall + scene_wall)
            if fastest < enough:
                break
        return fastest

    def lap(self) -> Lap:
        """Run one lap; return the seconds of one trial: of points by processor and wall clock, and of the scene."""
        # What ran before has left other data in the caches; a few pixels that do not count bring back those needed.
        self._run(self._pixels // 8)
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
    """Return the realisations and boxes of the pixels to time, and the number of such pixels in a trial.

    The cost of a scene changes from place to place, so any pixels that follow each other must be spread over the image.
    """
    if request.one_pixel:
        sampler, blocks = resources.sampler(combination.sampler), resources.scene(combination.scene).blocks
        return sampler.trials(0, _PLACES, request.seed, blocks), unit_square(_PLACES), 1
    pixels = resources.pixels(combination.scene, request.size)
    sampled = pixels.sampled
    if not sampled.size:
        return *pixels.locate(np.zeros(1, np.int64), request.seed), 0
    groups = -(-sampled.size // _NEIGHBOURS)
    starts = _NEIGHBOURS * np.linspace(0, groups, min(groups, _PLACES // _NEIGHBOURS), endpoint=False).astype(np.int64)
    # Multiples of the golden ratio modulo 1: any run of them is spread evenly.
    starts = starts[np.argsort(np.arange(starts.size) * 0.6180339887498949 % 1.0)]
    chosen = (starts[:, None] + np.arange(_NEIGHBOURS)).ravel()
    return *pixels.locate(sampled[chosen[chosen < sampled.size]], request.seed), int(sampled.size)


def run_round(
    timings: Sequence[TimingRun],
    number: int,
    seconds: float,
    store: Store,
    progress: Callable[[int, int], None],
) -> None:
    """Run a round: laps in turn until the time is up, at least one lap of each combination and at most twelve.

    Combinations whose laps take more than their share of the time leave out every third round.

    Parameters
    ----------
    timings
        The combinations, warmed up.
    number
        Number of the round, which no earlier round of the study has.
    seconds
        The processor's time that is available.
    store
        It keeps the laps.
    progress
        Called with hundredths of a second spent and available.
    """
    cpu, wall = time.process_time(), time.perf_counter()
    taking = [each for each in timings if number % 3 != 1 or each.lap_seconds * len(timings) <= seconds]
    for _ in range(_MOST_LAPS):
        store.add_laps(number, [(timing.combination, timing.lap()) for timing in taking])
        # Other processes lengthen the wait, and must not leave fewer laps just where more are needed.
        spent = max(time.process_time() - cpu, (time.perf_counter() - wall) / _PATIENCE)
        progress(int(100 * min(spent, seconds)), int(100 * seconds) + 1)
        if spent >= seconds:
            return


def typical_seconds(laps: Mapping[Combination, Array]) -> dict[Combination, Interval]:
    """Return the processor seconds of a trial of each combination, points and scene together.

    What slows all combinations of a round alike (another process, the frequency of the processor) is estimated and
    taken out: the logarithm of a round's median is the sum of a term of the combination and a term of the round, both
    fitted by medians (median polish; Tukey 1977, "Exploratory Data Analysis"). What is left is the combination's own
    scatter between rounds, and its interval is that of a median by the sign test, which assumes no distribution. So the
    interval is for comparing combinations of one study: the common speed of the machine is in it only if there is a
    single combination.

    Parameters
    ----------
    laps
        For each combination float64[L, 5], as :meth:`Store.laps` returns them.

    Returns
    -------
    For each combination with laps the estimate and its 95 % interval, which needs six rounds.
    """
    timed = [combination for combination, own in laps.items() if len(own)]
    numbers = np.unique(np.concatenate([own[:, 0] for own in laps.values()]))
    logs = np.full((len(timed), numbers.size), np.nan)
    for row, combination in enumerate(timed):
        own = laps[combination]
        for column in np.flatnonzero(np.isin(numbers, own[:, 0])):
            totals = own[own[:, 0] == numbers[column]][:, [1, 3]].sum(axis=1)
            # Of an even number the lower of the middle two: what disturbs a lap makes it longer.
            seconds = float(np.percentile(totals, 50, method="lower"))
            # A clock may show 0, and an image whose pixels are all constant takes no time.
            logs[row, column] = math.log(seconds) if seconds > 0.0 else math.nan
    relative = _without_common_terms(logs)
    return {
        combination: _median_interval(own[np.isfinite(own)]) for combination, own in zip(timed, relative, strict=True)
    }


def _without_common_terms(logs: Array) -> Array:
    """Subtract from each row of float64[combinations, rounds] what the others share in a round; NaN is no value.

    The others alone: a row that has a part in what is subtracted would show less than its own scatter. A row that is
    alone in a round has no value there.
    """
    if np.count_nonzero(np.isfinite(logs).any(axis=1)) < 2:
        return logs
    with warnings.catch_warnings():
        # The median of no values is NaN, as it should be.
        warnings.simplefilter("ignore", RuntimeWarning)
        common = np.zeros(logs.shape[1])
        for _ in range(_POLISHINGS):
            terms = np.nanmedian(logs - common, axis=1, keepdims=True)
            common = np.nanmedian(logs - terms, axis=0)
            common -= np.nanmedian(common)
        rest = logs - terms
        scatter = rest - [np.nanmedian(np.delete(rest, row, axis=0), axis=0) for row in range(len(rest))]
        return np.asarray(terms + scatter - np.nanmedian(scatter, axis=1, keepdims=True))


def _median_interval(logs: Array) -> Interval:
    """Return the median of logarithms and its interval by the sign test, as an interval of the values."""
    if not logs.size:
        return Interval(0.0)
    centre, ordered = math.exp(float(np.median(logs))), np.exp(np.sort(logs))
    # The largest rank from either end at which an interval still contains the median with this probability.
    rank = int(np.count_nonzero(bdtr(np.arange(logs.size), logs.size, 0.5) <= (1.0 - LEVEL) / 2.0))
    return Interval(centre, float(ordered[rank - 1]), float(ordered[-rank])) if rank else Interval(centre)


def falling(seconds: Mapping[Combination, Interval]) -> dict[Combination, Combination]:
    """Return the combinations that take less time than one of fewer samples of the same scene and sampler.

    Parameters
    ----------
    seconds
        From :func:`typical_seconds`; counts rise within a scene and sampler.

    Returns
    -------
    Each such combination, and the slowest of those with fewer samples.
    """
    slowest: dict[tuple[str, str], Combination] = {}
    found = {}
    for combination, own in seconds.items():
        slower = slowest.get(combination.pair)
        if slower is not None and (own.estimate or 0.0) < (seconds[slower].estimate or 0.0):
            found[combination] = slower
        else:
            slowest[combination.pair] = combination
    return found
