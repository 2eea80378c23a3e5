"""Rank the samplers: the time to a target error, the best choice for a budget, and where the order changes."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, NamedTuple

from samplekit._study.results import Choice, Crossing, Flip, ToTarget

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from samplekit._study.results import Row


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
        The target error for all scenes; None: for each scene the smallest error that all samplers reach.
    cost
        Extra cost per sample in nanoseconds that the times of the rows already include.
    """
    found = Ranking({}, [], [], [], [])
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [row for row in rows if row.scene == scene]
        curves: dict[str, list[Row]] = {}
        for row in own:
            curves.setdefault(row.sampler, []).append(row)
        error = target if target is not None else _common_error(curves.values())
        if error is not None:
            found.target[scene] = error
            needs = [_to_target(curve, error) for curve in curves.values()]
            found.to_target.extend(needs)
            found.flips.extend(_flips(needs, own[0].samples / own[0].count, cost))
        found.front.extend(_front(own))
        pairs = itertools.combinations(curves.values(), 2)
        crossings = [crossing for one, other in pairs for crossing in _crossings(one, other)]
        found.crossings.extend(sorted(crossings, key=lambda crossing: crossing.count))
    return found


def _common_error(curves: Iterable[Sequence[Row]]) -> float | None:
    """Return the smallest error that all samplers reach; None if it is 0 or there is none."""
    errors = [[row.mse.estimate for row in curve if row.mse.estimate is not None] for curve in curves]
    return max((min(each) for each in errors if each), default=0.0) or None


def _to_target(rows: Sequence[Row], target: float) -> ToTarget:
    """Find the target between two of the rows of a sampler, whose counts rise."""
    pair = rows[0].scene, rows[0].sampler
    previous: Row | None = None
    for row in rows:
        mse = row.mse.estimate
        if mse is not None and mse <= target * (1.0 + 1e-12):
            if previous is None:
                note = "its smallest count is already below the target" if mse < target else ""
                return ToTarget(*pair, target, float(row.count), row.time, note)
            share = _share(previous.mse.estimate or 0.0, mse, target)
            count = _between(previous.count, row.count, share)
            seconds = None if previous.time is None or row.time is None else _between(previous.time, row.time, share)
            return ToTarget(*pair, target, count, seconds, "")
        if mse is not None:
            previous = row
    return ToTarget(*pair, target, None, None, f"does not reach the target with {rows[-1].count} samples")


def _share(above: float, below: float, target: float) -> float:
    """Return how far the target lies from ``above`` to ``below``, in logarithms: 0 to 1."""
    if below <= 0.0:
        return 1.0
    return math.log(above / target) / math.log(above / below)


def _between(first: float, second: float, share: float) -> float:
    """Return the number that lies this far from ``first`` to ``second``, in logarithms."""
    if first <= 0.0 or second <= 0.0:
        return first + share * (second - first)
    return first * math.pow(second / first, share)


def _front(rows: Sequence[Row]) -> list[Choice]:
    """Return the best choices for rising budgets of time: the rows that no other beats in both time and error.

    A slower row becomes the choice if its error is smaller by more than the intervals leave open. It replaces the
    choice before it if the quartiles of their times overlap. So noise alone does not make samplers alternate.
    """
    timed = [row for row in rows if row.time is not None and row.mse.estimate is not None]
    best: list[Row] = []
    for row in sorted(timed, key=lambda row: (row.time or 0.0, row.mse.estimate or 0.0)):
        if best and not _is_clearly_better(row, best[-1]):
            continue
        while best and _is_as_fast(row, best[-1]):
            best.pop()
        best.append(row)
    ends = [*(row.time for row in best[1:]), None]
    return [
        Choice(row.scene, row.sampler, row.count, row.mse.estimate or 0.0, row.time or 0.0, until)
        for row, until in zip(best, ends, strict=False)
    ]


def _is_clearly_better(row: Row, other: Row) -> bool:
    estimate, bar = row.mse.estimate or 0.0, other.mse.estimate or 0.0
    high = row.mse.high if row.mse.high is not None else estimate
    low = other.mse.low if other.mse.low is not None else bar
    return estimate < bar and high < low


def _is_as_fast(row: Row, other: Row) -> bool:
    """Return whether the quartiles of the times overlap; ``row`` is the slower one."""
    if row.times is None or other.times is None:
        return False
    spread, earlier = row.times.total.cpu, other.times.total.cpu
    added = (row.time or 0.0) - spread.median, (other.time or 0.0) - earlier.median
    return spread.lower + added[0] <= earlier.upper + added[1]


class _Need(NamedTuple):
    """The samples of all pixels, and the seconds without the extra cost, that a sampler needs for the target."""

    sampler: str
    samples: float
    seconds: float

    def at(self, cost: float) -> float:
        """Return the seconds at an extra cost per sample in nanoseconds."""
        return self.seconds + cost * 1e-9 * self.samples


def _flips(to_target: Sequence[ToTarget], pixels: float, cost: float) -> list[Flip]:
    """Return the costs per sample at which two samplers change places, costs rising.

    Parameters
    ----------
    to_target
        What each sampler needs on the scene.
    pixels
        Number of pixels of the scene that are sampled.
    cost
        Extra cost per sample in nanoseconds that the seconds already include.
    """
    needs = [
        _Need(need.sampler, need.count * pixels, need.seconds - cost * 1e-9 * need.count * pixels)
        for need in to_target
        if need.count and need.seconds
    ]
    flips = []
    for pair in itertools.combinations(needs, 2):
        # A higher cost per sample favours the one with fewer samples.
        fewer, more = sorted(pair, key=lambda need: need.samples)
        if fewer.samples == more.samples:
            continue
        at = (fewer.seconds - more.seconds) / (more.samples - fewer.samples) * 1e9
        if at > 0.0:
            leads = fewer.at(at) <= min(need.at(at) for need in needs) * (1.0 + 1e-9)
            flips.append(Flip(to_target[0].scene, to_target[0].target, at, more.sampler, fewer.sampler, leads))
    return sorted(flips, key=lambda flip: flip.cost)


def _crossings(one: Sequence[Row], other: Sequence[Row]) -> list[Crossing]:
    """Return where the error curves of two samplers cross, as far as their intervals can tell, counts rising.

    They are compared at the counts that both have.
    """
    by_count = {row.count: row for row in other}
    common = [(row, by_count[row.count]) for row in one if row.count in by_count]
    common = [pair for pair in common if all(row.mse.estimate for row in pair)]
    found = []
    previous: tuple[int, int] | None = None
    for place, (mine, theirs) in enumerate(common):
        sign = _compare(mine, theirs)
        if sign == 0:
            continue
        if previous is not None and sign != previous[1]:
            fewer, more = (mine, theirs) if previous[1] < 0 else (theirs, mine)
            between = common[previous[0] : place + 1]
            last, first = between[0][0].count, between[-1][0].count
            found.append(Crossing(mine.scene, fewer.sampler, more.sampler, last, first, _crossing_count(between)))
        previous = place, sign
    return found


def _compare(mine: Row, theirs: Row) -> int:
    """Return -1 if the first has the smaller error, 1 if the second has, 0 if their intervals cannot tell."""
    if None in (mine.mse.low, mine.mse.high, theirs.mse.low, theirs.mse.high):
        return 0
    if (mine.mse.high or 0.0) < (theirs.mse.low or 0.0):
        return -1
    return int((theirs.mse.high or 0.0) < (mine.mse.low or 0.0))


def _crossing_count(between: Sequence[tuple[Row, Row]]) -> float:
    """Return the first count at which the ratio of the errors is 1, interpolated in logarithms."""
    ratios = [math.log((mine.mse.estimate or 1.0) / (theirs.mse.estimate or 1.0)) for mine, theirs in between]
    for (low, high), (before, after) in zip(itertools.pairwise(between), itertools.pairwise(ratios), strict=True):
        if before * after <= 0.0 and before != after:
            share = before / (before - after)
            return float(low[0].count * (high[0].count / low[0].count) ** share)
    return float(between[-1][0].count)
