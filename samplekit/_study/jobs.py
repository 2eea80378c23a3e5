"""The jobs of a study: plain data, independent of each other, and the sums that they give.

A job makes trials ``first`` to ``last`` of a scene and sampler, at one count or, where one draw has them all, at
several. What a trial gives depends on nothing else, so that results do not depend on how trials are shared out. Trials
are summed in batches, at most 1024 of them, which no job divides: batches are put side by side, and nothing is rounded.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from samplekit._study.cells import Cell
    from samplekit._study.request import Request

MOST_BATCHES = 1024
_SECONDS = 0.4
"""Of a job: what an interrupt throws away at most."""
_MOST_TRIALS = 2**18
"""Of a job: some 20 MB."""
_ARRAYS = 6
"""Of the size of an image, for each count that a job has at once."""


@dataclass(frozen=True)
class Job:
    """Trials ``first`` to ``last`` of a scene and sampler, all of ``counts`` from one draw, in batches of ``batch``."""

    scene: str
    sampler: str
    counts: tuple[int, ...]
    first: int
    last: int
    batch: int
    size: tuple[int, int]
    seed: int

    @property
    def memory(self) -> int:
        """Bytes that the job takes, roughly."""
        return _ARRAYS * 8 * len(self.counts) * self.size[0] * self.size[1]

    @property
    def samples(self) -> int:
        """Samples that are drawn, constant pixels counted as well."""
        return self.counts[-1] * self.size[0] * self.size[1] * (self.last - self.first)


def batch_of(trials: int) -> int:
    """Trials in a batch: 1, or an even number, since trials are compared in pairs."""
    return 1 if trials <= MOST_BATCHES else 2 * -(-trials // (2 * MOST_BATCHES))


def groups(cells: Iterable[Cell]) -> Iterator[list[Cell]]:
    """Cells whose sets are drawn together: the prefixes of a progressive sampler, and every other one by itself."""
    shared: dict[tuple[str, str], list[Cell]] = {}
    for cell in cells:
        if cell.shared_draw:
            shared.setdefault(cell.pair, []).append(cell)
        else:
            yield [cell]
    yield from shared.values()


def split(
    request: Request,
    cells: Sequence[Cell],
    missing: Callable[[Cell], Sequence[tuple[int, int]]],
    seconds: Mapping[Cell, float],
    workers: int,
) -> list[Job]:
    """The jobs that are left to do, so ordered that all cells grow together.

    Parameters
    ----------
    request, cells
        The study.
    missing
        Ranges of trials that a cell has not; their ends are those of batches.
    seconds
        Time that a trial takes, roughly; a job is to take less than a second.
    workers
        That share the work.
    """
    jobs: list[tuple[float, Job]] = []
    for group in groups(cells):
        largest = group[-1]
        batch = batch_of(largest.trials)
        unit = max(batch, 2)
        counts = tuple(cell.count for cell in group)
        # Of one draw all have the same trials, unless somebody took rows out of the file.
        for start, stop in _union(each for cell in group for each in missing(cell)):
            length = min(_SECONDS / max(seconds.get(largest, 0.0), 1e-9), (stop - start) / workers, _MOST_TRIALS)
            length = max(1, round(length / unit)) * unit
            for first in range(start, stop, length):
                job = Job(*largest.pair, counts, first, min(first + length, stop), batch, request.size, request.seed)
                jobs.append((first / largest.trials, job))
    return [job for _, job in sorted(jobs, key=lambda item: item[0])]


def _union(ranges: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The ranges, those that overlap or touch as one."""
    joined: list[tuple[int, int]] = []
    for first, last in sorted(ranges):
        if joined and first <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(joined[-1][1], last)
        else:
            joined.append((first, last))
    return joined


def gaps(ranges: Sequence[tuple[int, int]], trials: int) -> list[tuple[int, int]]:
    """What of 0 to ``trials`` lies between the ranges."""
    found, end = [], 0
    for first, last in [*sorted(ranges), (trials, trials)]:
        if first > end:
            found.append((end, first))
        end = max(end, last)
    return found
