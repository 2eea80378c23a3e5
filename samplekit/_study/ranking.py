"""Rank the samplers: the time to a target error, the best choice for a budget, and where the order changes."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._study.results import Choice, Crossing, Flip, ToTarget

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from samplekit._study.results import Row


def _scenes(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(row.scene for row in rows))


def _by_sampler(rows: Sequence[Row], scene: str) -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for row in rows:
        if row.scene == scene:
            found.setdefault(row.sampler, []).append(row)
    return found


def targets(rows: Sequence[Row], asked: float | None) -> dict[str, float]:
    """Return the target error of each scene.

    Parameters
    ----------
    rows
        The rows of a study.
    asked
        The target for all scenes; None: for each scene the smallest error that all samplers reach.
    """
    found: dict[str, float] = {}
    for scene in _scenes(rows):
        least = [
            min(row.mse.estimate for row in own if row.mse.estimate is not None)
            for own in _by_sampler(rows, scene).values()
            if any(row.mse.estimate is not None for row in own)
        ]
        if asked is not None:
            found[scene] = asked
        elif least and max(least) > 0.0:
            found[scene] = max(least)
    return found


def times_to_target(rows: Sequence[Row], target: Mapping[str, float]) -> list[ToTarget]:
    """Return what each sampler needs to reach the target error of each scene."""
    return [_to_target(own, target[scene]) for scene in target for own in _by_sampler(rows, scene).values()]


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
    return ToTarget(*pair, target, None, None, f"does not get there with {rows[-1].count} samples")


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


def front(rows: Sequence[Row]) -> list[Choice]:
    """Return the best choices for rising budgets of time: the rows that no other beats in both time and error.

    A slower row becomes the choice if its error is smaller by more than the intervals leave open. It replaces the
    choice before it if the quartiles of their times overlap. So noise alone does not make samplers alternate.
    """
    choices: list[Choice] = []
    for scene in _scenes(rows):
        timed = [row for row in rows if row.scene == scene and row.time is not None and row.mse.estimate is not None]
        best: list[Row] = []
        for row in sorted(timed, key=lambda row: (row.time or 0.0, row.mse.estimate or 0.0)):
            if best and not _is_clearly_better(row, best[-1]):
                continue
            while best and _is_as_fast(row, best[-1]):
                best.pop()
            best.append(row)
        for index, row in enumerate(best):
            until = best[index + 1].time if index + 1 < len(best) else None
            choices.append(Choice(scene, row.sampler, row.count, row.mse.estimate or 0.0, row.time or 0.0, until))
    return choices


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


@dataclass(frozen=True)
class _Need:
    """The samples of all pixels, and the seconds without the extra cost, that a sampler needs for the target."""

    sampler: str
    samples: float
    seconds: float

    def at(self, cost: float) -> float:
        """Return the seconds at an extra cost per sample in nanoseconds."""
        return self.seconds + cost * 1e-9 * self.samples


def flips(rows: Sequence[Row], to_target: Sequence[ToTarget], cost: float) -> list[Flip]:
    """Return the costs per sample at which two samplers change places, scene by scene, costs rising.

    Parameters
    ----------
    rows, to_target
        The rows of a study, and what the samplers need for the target error.
    cost
        Extra cost per sample in nanoseconds that their times already include.
    """
    found: list[Flip] = []
    for scene in _scenes(rows):
        per_count = next(row.samples / row.count for row in rows if row.scene == scene)
        reached = [need for need in to_target if need.scene == scene and need.count and need.seconds]
        needs = []
        for each in reached:
            count, seconds = each.count or 0.0, each.seconds or 0.0
            needs.append(_Need(each.sampler, count * per_count, seconds - cost * 1e-9 * count * per_count))
        own = []
        for one, other in itertools.combinations(needs, 2):
            if one.samples == other.samples:
                continue
            # A higher cost per sample favours the one with fewer samples.
            fewer, more = sorted((one, other), key=lambda need: need.samples)
            at = (fewer.seconds - more.seconds) / (more.samples - fewer.samples) * 1e9
            if at > 0.0:
                fastest = min(need.at(at) for need in needs)
                leads = fewer.at(at) <= fastest * (1.0 + 1e-9)
                own.append(Flip(scene, reached[0].target, at, more.sampler, fewer.sampler, leads))
        found += sorted(own, key=lambda flip: flip.cost)
    return found


def crossings(rows: Sequence[Row]) -> list[Crossing]:
    """Return where the error curves of two samplers cross, as far as their intervals can tell.

    All pairs of samplers on each scene are compared at the counts that both have; scene by scene, counts rising.
    """
    found = []
    for scene in _scenes(rows):
        pairs = itertools.combinations(_by_sampler(rows, scene).values(), 2)
        own = [crossing for one, other in pairs for crossing in _crossings_of_pair(one, other)]
        found += sorted(own, key=lambda crossing: crossing.count)
    return found


def _crossings_of_pair(one: Sequence[Row], other: Sequence[Row]) -> list[Crossing]:
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
