"""Answers: the time to a target error, the best choice for a budget, and where the cost of a sample turns the order."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._study.results import Choice, Flip, ToTarget

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from samplekit._study.results import Row


def targets(rows: Sequence[Row], asked: float | None) -> dict[str, float]:
    """The target error of each scene: the one asked for, or one that all samplers reach at their largest count."""
    found: dict[str, float] = {}
    for scene in dict.fromkeys(row.scene for row in rows):
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
    """What each sampler needs for the target of each scene."""
    return [_to_target(own, target[scene]) for scene in target for own in _by_sampler(rows, scene).values() if own]


def _to_target(rows: Sequence[Row], target: float) -> ToTarget:
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
    """How far from ``above`` to ``below`` the target lies, in logarithms."""
    if below <= 0.0:
        return 1.0
    return math.log(above / target) / math.log(above / below)


def _between(first: float, second: float, share: float) -> float:
    if first <= 0.0 or second <= 0.0:
        return first + share * (second - first)
    return first * math.pow(second / first, share)


def front(rows: Sequence[Row]) -> list[Choice]:
    """The rows that no other beats in both time and error, as the choices for rising budgets.

    A slower row takes over where its error is smaller by more than the intervals leave open; it takes the place of the
    last choice where the quartiles of their times overlap. So noise alone does not make samplers take turns.
    """
    choices: list[Choice] = []
    for scene in dict.fromkeys(row.scene for row in rows):
        timed = [row for row in rows if row.scene == scene and row.time is not None and row.mse.estimate is not None]
        best: list[Row] = []
        for row in sorted(timed, key=lambda row: (row.time or 0.0, row.mse.estimate or 0.0)):
            if best and not _clearly_better(row, best[-1]):
                continue
            while best and _as_fast(row, best[-1]):
                best.pop()
            best.append(row)
        for index, row in enumerate(best):
            until = best[index + 1].time if index + 1 < len(best) else None
            choices.append(Choice(scene, row.sampler, row.count, row.mse.estimate or 0.0, row.time or 0.0, until))
    return choices


def _clearly_better(row: Row, other: Row) -> bool:
    estimate, bar = row.mse.estimate or 0.0, other.mse.estimate or 0.0
    high = row.mse.high if row.mse.high is not None else estimate
    low = other.mse.low if other.mse.low is not None else bar
    return estimate < bar and high < low


def _as_fast(row: Row, other: Row) -> bool:
    """Whether the quartiles of the times overlap, ``row`` being the slower one."""
    if row.times is None or other.times is None:
        return False
    spread, earlier = row.times.total.cpu, other.times.total.cpu
    added = (row.time or 0.0) - spread.median, (other.time or 0.0) - earlier.median
    return spread.lower + added[0] <= earlier.upper + added[1]


@dataclass(frozen=True)
class _Need:
    sampler: str
    samples: float
    seconds: float

    def at(self, cost: float) -> float:
        """Seconds where each sample costs so many nanoseconds more."""
        return self.seconds + cost * 1e-9 * self.samples


def flips(rows: Sequence[Row], to_target: Sequence[ToTarget], cost: float) -> list[Flip]:
    """The costs at which two samplers change places; ``cost`` is in their times already."""
    found: list[Flip] = []
    for scene in dict.fromkeys(row.scene for row in rows):
        per_count = next((row.samples / row.count for row in rows if row.scene == scene), 1.0)
        reached = [need for need in to_target if need.scene == scene and need.count and need.seconds]
        needs = [
            _Need(
                need.sampler,
                (need.count or 0.0) * per_count,
                (need.seconds or 0.0) - cost * 1e-9 * (need.count or 0.0) * per_count,
            )
            for need in reached
        ]
        own = []
        for one, other in itertools.combinations(needs, 2):
            if one.samples == other.samples:
                continue
            # The one with fewer samples gains by a cost of them.
            fewer, more = sorted((one, other), key=lambda need: need.samples)
            at = (fewer.seconds - more.seconds) / (more.samples - fewer.samples) * 1e9
            if at > 0.0:
                fastest = min(need.at(at) for need in needs)
                leads = fewer.at(at) <= fastest * (1.0 + 1e-9)
                own.append(Flip(scene, reached[0].target, at, more.sampler, fewer.sampler, leads))
        found += sorted(own, key=lambda flip: flip.cost)
    return found


def _by_sampler(rows: Sequence[Row], scene: str) -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for row in rows:
        if row.scene == scene:
            found.setdefault(row.sampler, []).append(row)
    return found
