"""Rank the samplers: the samples and time to a target error, the best for a budget, and where the order changes.

Nothing here names a winner beyond the intervals. An interval without an end is open on that side.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from samplekit._study.errors import FEW_TRIALS
from samplekit._study.intervals import derived_interval
from samplekit._study.results import Choice, Crossing, Flip, Interval, Lead, ToTarget

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from samplekit._study.results import Row


_STEPS = 17
"""Points of a curve from a row to the next, both included."""


class Ranking(NamedTuple):
    """The answers of a study, scene by scene; the fields are those of :class:`samplekit._study.results.Results`."""

    target: dict[str, float]
    to_target: list[ToTarget]
    front: list[Choice]
    flips: list[Flip]
    crossings: list[Crossing]


def rank(rows: Sequence[Row], target: float | None, cost: float) -> Ranking:
    """Rank the samplers on each scene.

    Parameters
    ----------
    rows
        The rows of a study.
    target
        The target error for all scenes; None: for each scene the smallest error that all samplers certainly reach.
    cost
        Extra cost per sample in nanoseconds that the times of the rows already include.
    """
    found = Ranking({}, [], [], [], [])
    for scene in dict.fromkeys(row.scene for row in rows):
        curves: dict[str, list[Row]] = {}
        for row in rows:
            if row.scene == scene:
                curves.setdefault(row.sampler, []).append(row)
        error = target if target is not None else _common_error(curves.values())
        if error is not None:
            found.target[scene] = error
            needs = {sampler: _Need(curve, error) for sampler, curve in curves.items()}
            found.to_target.extend(
                ToTarget(scene, sampler, error, need.count, need.seconds(cost)) for sampler, need in needs.items()
            )
            found.flips.extend(_flips(scene, error, needs))
        found.front.extend(_front(scene, curves))
        for pair in itertools.combinations(curves, 2):
            leads = _leads(*(curves[sampler] for sampler in pair))
            if len({lead.sampler for lead in leads}) > 1:
                found.crossings.append(Crossing(scene, pair, leads))
    return found


def may_be_least(numbers: Sequence[Interval]) -> list[bool]:
    """Return for each number whether it may be the smallest: no other is certainly smaller.

    Numbers without any interval may be, but if no interval has an upper end, nothing is known and the list has no True.
    """
    bound = min((each.high for each in numbers if each.high is not None), default=-math.inf)
    return [bound > -math.inf and (each.low is None or each.low <= bound) for each in numbers]


def _common_error(curves: Iterable[Sequence[Row]]) -> float | None:
    """Return the smallest error, rounded up, that all samplers certainly reach; None if it is 0 or there is none."""
    ends = [[row.mse.high for row in curve if row.mse.high is not None and not row.no_interval] for curve in curves]
    if not any(ends):
        ends = [
            [row.mse.estimate for row in curve if row.no_interval == FEW_TRIALS and row.mse.estimate]
            for curve in curves
        ]
    error = max((min(each) for each in ends if each), default=0.0)
    if not error > 0.0:
        return None
    rounded = float(f"{error:.1e}")
    return rounded if rounded >= error else float(f"{error * 1.1:.1e}")


class _Need:
    """The samples of a sampler at which its curve, and those of the ends of its intervals, first reach a target.

    Attributes
    ----------
    count
        The number of samples of a pixel; see :class:`ToTarget`.
    """

    def __init__(self, rows: Sequence[Row], target: float) -> None:
        known = [row for row in rows if row.mse.estimate is not None and row.no_interval in ("", FEW_TRIALS)]
        estimate = _reach([(row.count, row.mse.estimate or 0.0) for row in known], target)
        low = _reach(_ends_of(rows, lambda mse: 0.0 if mse.low is None else mse.low), target)
        high = _reach(_ends_of(rows, lambda mse: math.inf if mse.high is None else mse.high), target)
        first, last = rows[0].count, rows[-1].count
        if low is None:
            self.count = Interval(None, float(last), None)
        else:
            # Reached at the first row of which something is known, it may have been reached before.
            inside = estimate if estimate is not None and estimate > known[0].count else None
            self.count = Interval(inside, low if low > first else None, high)
        self.pixels = rows[0].samples / rows[0].count
        self._own = [(row.count, row.times.seconds) for row in rows if row.times is not None]

    def seconds_at(self, samples: float, share: float = 1.0, cost: float = 0.0) -> float:
        """Return the seconds of so many samples of a pixel, on straight lines in logarithms between the rows.

        Parameters
        ----------
        samples, cost
            Samples of a pixel, and the extra cost of each in nanoseconds.
        share
            A factor of the measured times.
        """
        counts = np.log([count for count, _ in self._own])
        seconds = np.log([time.estimate or 1.0 for _, time in self._own])
        measured = math.exp(float(np.interp(math.log(samples), counts, seconds)))
        return measured * share + cost * 1e-9 * samples * self.pixels

    @property
    def samples(self) -> float:
        """The number of samples, or a bound of it if only that is known; 0 if nothing is."""
        return next((each for each in (self.count.estimate, self.count.high, self.count.low) if each is not None), 0.0)

    @property
    def time_share(self) -> Interval | None:
        """The interval of the measured times near ``count``, relative to their estimates; None if there is none."""
        place = sum(count < self.samples for count, _ in self._own)
        near = [time for _, time in self._own[max(place - 1, 0) : place + 1]]
        ends = [(time.estimate, time.low, time.high) for time in near if time.estimate and time.low and time.high]
        if not near or len(ends) < len(near):
            return None
        return Interval(
            1.0, min(low / middle for middle, low, _ in ends), max(high / middle for middle, _, high in ends)
        )

    def seconds(self, cost: float) -> Interval:
        """Return the seconds that the sampler needs; the ends allow for the samples and for the measured times."""
        count, share, samples = self.count, self.time_share, self.samples
        if not self._own or not samples:
            return Interval(None)
        if share is None:
            return Interval(None if count.estimate is None else self.seconds_at(samples, 1.0, cost))
        closed = Interval(samples, count.low or samples, count.high or samples)
        found = derived_interval(lambda number, factor: self.seconds_at(number, factor, cost), [closed, share])
        return Interval(
            None if count.estimate is None else found.estimate,
            None if count.low is None else found.low,
            None if count.high is None else found.high,
        )


def _is_closed(interval: Interval) -> bool:
    return None not in (interval.estimate, interval.low, interval.high)


def _is_below(one: Interval, other: Interval) -> bool:
    """Return whether a number is certainly smaller than another."""
    return one.high is not None and other.low is not None and one.high < other.low


def _ends_of(rows: Sequence[Row], end: Callable[[Interval], float]) -> list[tuple[float, float]]:
    """Return the curve of one end of the intervals: counts and errors, at and between the rows.

    Between two rows the error is interpolated in logarithms, and its deviation follows from theirs: they add up if both
    rows come from the same draws, and their squares do if the rows are independent.
    """
    curve: list[tuple[float, float]] = []
    for row, following in zip(rows, [*rows[1:], None], strict=True):
        curve.append((row.count, end(row.mse)))
        numbers = [number for each in (row, following) if each for number in (each.mse.estimate or 0.0, end(each.mse))]
        if following is None or min(numbers) <= 0.0 or not max(numbers) < math.inf:
            continue
        middle, here, next_middle, there = map(math.log, numbers)
        for share in np.linspace(0.0, 1.0, _STEPS)[1:-1].tolist():
            deviations = (1.0 - share) * (here - middle), share * (there - next_middle)
            size = abs(sum(deviations)) if row.shared_draw else math.hypot(*deviations)
            error = (1.0 - share) * middle + share * next_middle + math.copysign(size, here - middle)
            curve.append((row.count * (following.count / row.count) ** share, math.exp(error)))
    return curve


def _reach(curve: Sequence[tuple[float, float]], target: float) -> float | None:
    """Return where a curve of counts and errors first reaches the target; None if it does not.

    Between its points it is a straight line in logarithms.
    """
    before, above = 0.0, math.inf
    for count, error in curve:
        if error <= target * (1.0 + 1e-12):
            if not math.isfinite(above):
                return count
            # An error of 0 may be reached anywhere between the two counts.
            share = math.log(above / target) / math.log(above / error) if error > 0.0 else 0.0
            return float(before * math.pow(count / before, share))
        before, above = count, error
    return None


def _front(scene: str, curves: Mapping[str, Sequence[Row]]) -> list[Choice]:
    """Return for rising budgets of time the samplers that may have the smallest error.

    A row is certainly within a budget if the upper end of its time is, and possibly if the lower end is. A sampler may
    be the best unless another one, with a row that is certainly within the budget, certainly has a smaller error than
    all rows of the first that are possibly within it.
    """
    rows = [row for curve in curves.values() for row in curve if row.time is not None]
    ends = [end for row in rows if row.time is not None for end in (row.time.low, row.time.high) if end is not None]
    found: list[Choice] = []
    for budget in sorted(set(ends)):
        errors = [_within(budget, curve) for curve in curves.values()]
        best = [sampler for sampler, may in zip(curves, may_be_least(errors), strict=True) if may]
        if best and not (found and found[-1].samplers == best):
            if found:
                found[-1] = replace(found[-1], until=budget)
            found.append(Choice(scene, best, budget, None))
    return found


def _within(budget: float, curve: Sequence[Row]) -> Interval:
    """Return the interval of the smallest error of a sampler within a budget; its low end is infinite without rows."""
    low, high = math.inf, math.inf
    for row in curve:
        if row.time is not None and (row.time.low is None or row.time.low <= budget):
            low = min(low, 0.0 if row.mse.low is None else row.mse.low)
            if row.time.high is not None and row.time.high <= budget and row.mse.high is not None:
                high = min(high, row.mse.high)
    return Interval(None, low, high if high < math.inf else None)


def _flips(scene: str, target: float, needs: Mapping[str, _Need]) -> list[Flip]:
    """Return the costs per sample at which two samplers change places, costs rising."""
    flips = []
    for below, above in itertools.permutations(needs, 2):
        more, fewer = needs[below], needs[above]
        shares = more.time_share, fewer.time_share
        # A higher cost per sample favours the one with fewer samples.
        if not _is_below(fewer.count, more.count) or not _is_below(more.seconds(0.0), fewer.seconds(0.0)):
            continue
        if not (_is_closed(fewer.count) and _is_closed(more.count)) or None in shares:
            continue

        inputs = [more.count, fewer.count, *(share for share in shares if share is not None)]
        cost = derived_interval(partial(_cost_of_flip, more, fewer), inputs)
        there = [need.seconds(cost.estimate or 0.0) for need in (more, fewer)]
        others = [need.seconds(cost.estimate or 0.0) for name, need in needs.items() if name not in (below, above)]
        leads = not any(_is_below(other, own) for other in others for own in there)
        flips.append(Flip(scene, target, cost, below, above, leads))
    return sorted(flips, key=lambda flip: flip.cost.estimate or 0.0)


def _cost_of_flip(more: _Need, fewer: _Need, many: float, few: float, many_share: float, few_share: float) -> float:
    """Return the cost per sample in nanoseconds at which two samplers need the same time.

    Parameters
    ----------
    more, fewer
        The sampler that needs more samples, and the other one.
    many, few
        Their samples of a pixel.
    many_share, few_share
        Factors of their measured times.
    """
    saved = fewer.seconds_at(few, few_share) - more.seconds_at(many, many_share)
    return saved / ((many - few) * more.pixels) * 1e9


def _leads(one: Sequence[Row], other: Sequence[Row]) -> list[Lead]:
    """Return where the intervals of two samplers tell which has the smaller error, at the counts that both have."""
    by_count = {row.count: row for row in other}
    found: list[Lead] = []
    joined = False
    for mine in one:
        theirs = by_count.get(mine.count)
        if theirs is None:
            continue
        better = mine if _is_below(mine.mse, theirs.mse) else theirs if _is_below(theirs.mse, mine.mse) else None
        if better is not None and joined and found[-1].sampler == better.sampler:
            found[-1] = replace(found[-1], last=mine.count)
        elif better is not None:
            found.append(Lead(better.sampler, mine.count, mine.count))
        joined = better is not None
    return found
