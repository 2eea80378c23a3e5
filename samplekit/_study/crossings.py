"""Where the curves of error against count of two samplers cross, as far as their intervals can tell."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from samplekit._study.answers import Crossing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.measured import Row


def crossings(rows: Sequence[Row]) -> list[Crossing]:
    """The crossings of all pairs of samplers on each scene, at the counts that both have."""
    found = []
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [row for row in rows if row.scene == scene]
        pairs = itertools.combinations(dict.fromkeys(row.sampler for row in own), 2)
        of_scene = [crossing for one, other in pairs for crossing in _of_pair(own, one, other)]
        found += sorted(of_scene, key=lambda crossing: crossing.count)
    return found


def _of_pair(rows: Sequence[Row], one: str, other: str) -> list[Crossing]:
    by_count = {row.count: row for row in rows if row.sampler == other}
    common = [(row, by_count[row.count]) for row in rows if row.sampler == one and row.count in by_count]
    common = [pair for pair in common if all(row.mse.estimate for row in pair)]
    found = []
    previous: tuple[int, int] | None = None
    for place, (mine, theirs) in enumerate(common):
        sign = _better(mine, theirs)
        if sign == 0:
            continue
        if previous is not None and sign != previous[1]:
            fewer, more = (one, other) if previous[1] < 0 else (other, one)
            between = common[previous[0] : place + 1]
            last, first = between[0][0].count, between[-1][0].count
            found.append(Crossing(mine.scene, fewer, more, last, first, _crossed_at(between)))
        previous = place, sign
    return found


def _better(mine: Row, theirs: Row) -> int:
    """-1 where the first has the smaller error, 1 where the second has, 0 where intervals overlap or there are none."""
    if None in (mine.mse.low, mine.mse.high, theirs.mse.low, theirs.mse.high):
        return 0
    if (mine.mse.high or 0.0) < (theirs.mse.low or 0.0):
        return -1
    return int((theirs.mse.high or 0.0) < (mine.mse.low or 0.0))


def _crossed_at(between: Sequence[tuple[Row, Row]]) -> float:
    """The count at which the ratio of the errors is 1, interpolated in logarithms: the first such place."""
    ratios = [math.log((mine.mse.estimate or 1.0) / (theirs.mse.estimate or 1.0)) for mine, theirs in between]
    for (low, high), (before, after) in zip(itertools.pairwise(between), itertools.pairwise(ratios), strict=True):
        if before * after <= 0.0 and before != after:
            share = before / (before - after)
            return float(low[0].count * (high[0].count / low[0].count) ** share)
    return float(between[-1][0].count)
