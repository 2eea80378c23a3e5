"""Counts that a declaration allows, nearest to those that a check would like to judge."""

from __future__ import annotations

import heapq
from itertools import takewhile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from samplekit._specs import Counts, SamplerSpec

_LARGEST = 1 << 17


def allowed_near(
    counts: Counts, wanted: int, dims: int, makes: Callable[[int], bool] = lambda _: True, largest: int = _LARGEST
) -> int | None:
    """Return the allowed count nearest to ``wanted``, the smaller of two; None if there is none up to ``largest``.

    ``makes``: whether the sampler itself accepts a count, for what its declaration cannot say.
    """
    rising = takewhile(lambda count: count <= largest, counts.rising(wanted, dims))
    falling = _falling(counts, min(wanted, largest) + 1, dims)
    nearest_first = heapq.merge(falling, rising, key=lambda count: abs(count - wanted))
    return next(filter(makes, nearest_first), None)


def _falling(counts: Counts, count: int, dims: int) -> Iterator[int]:
    below = counts.below(count, dims)
    while below is not None:
        yield below
        below = counts.below(below, dims)


def progressive_counts(spec: SamplerSpec, wanted: tuple[int, ...], dims: int) -> list[int]:
    """Return those of the wanted counts at which a prefix is declared to be a set of its own."""
    if spec.progressive is None:
        return []
    return [
        count
        for count in sorted(set(wanted))
        if count <= spec.largest_index + 1 and spec.counts.allows(count, dims) and spec.progressive.allows(count, dims)
    ]
