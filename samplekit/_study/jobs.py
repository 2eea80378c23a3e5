"""The jobs of a study: plain data, independent of each other.

A job makes trials ``first`` to ``last`` of a scene and sampler, at one count or at several counts that share a draw.
Each trial depends on nothing else, so results do not depend on how the trials are divided into jobs. Trials are summed
in at most 1024 batches, and no job divides a batch: merging jobs only puts batches side by side and rounds nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from samplekit._study.combinations import Combination
    from samplekit._study.request import Request

MOST_BATCHES = 1024
_SECONDS = 0.4
"""Longest job, in seconds: at most this much work is lost on an interrupt."""
_MOST_TRIALS = 2**18
"""Most trials of a job: their sums take about 20 MB."""
_ARRAYS = 6
"""Arrays of the size of an image that a job holds at once for each of its counts."""


@dataclass(frozen=True)
class Job:
    """Trials ``first`` to ``last`` (excluded) of a scene and sampler.

    Attributes
    ----------
    scene, sampler
        Texts as on the command line.
    counts
        Numbers of samples per pixel, in rising order; one draw serves all of them.
    first, last
        The range of trials.
    batch
        Number of trials that are summed together.
    size
        Width and height of the image in pixels.
    seed
        Seed of the study.
    """

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
        """Approximate memory of the job in bytes."""
        return _ARRAYS * 8 * len(self.counts) * self.size[0] * self.size[1]

    @property
    def samples(self) -> int:
        """Number of samples of all pixels, constant pixels included."""
        return self.counts[-1] * self.size[0] * self.size[1] * (self.last - self.first)


def batch_of(trials: int) -> int:
    """Return the number of trials in a batch: 1, or an even number, since trials are compared in pairs."""
    return 1 if trials <= MOST_BATCHES else 2 * -(-trials // (2 * MOST_BATCHES))


def _shared_draws(combinations: Iterable[Combination]) -> Iterator[list[Combination]]:
    """Group the combinations whose sets are prefixes of one draw; all others stand alone."""
    shared: dict[tuple[str, str], list[Combination]] = {}
    for combination in combinations:
        if combination.shared_draw:
            shared.setdefault(combination.pair, []).append(combination)
        else:
            yield [combination]
    yield from shared.values()


def split(
    request: Request,
    combinations: Sequence[Combination],
    done: Callable[[Combination], Sequence[tuple[int, int]]],
    seconds: Mapping[Combination, float],
    workers: int,
) -> list[Job]:
    """Divide the trials that are not done into jobs, ordered so that all combinations progress together.

    Parameters
    ----------
    request, combinations
        The study.
    done
        Returns the ranges of trials that are done of a combination; they begin and end where batches do.
    seconds
        Approximate seconds of a trial.
    workers
        Number of workers that share the jobs.
    """
    jobs: list[tuple[float, Job]] = []
    for group in _shared_draws(combinations):
        largest = group[-1]
        batch = batch_of(largest.trials)
        unit = max(batch, 2)
        counts = tuple(combination.count for combination in group)
        for start, stop in missing_ranges([done(combination) for combination in group], largest.trials, batch):
            length = min(_SECONDS / max(seconds.get(largest, 0.0), 1e-9), (stop - start) / workers, _MOST_TRIALS)
            length = max(1, round(length / unit)) * unit
            for first in range(start, stop, length):
                job = Job(*largest.pair, counts, first, min(first + length, stop), batch, request.size, request.seed)
                jobs.append((first / largest.trials, job))
    return [job for _, job in sorted(jobs, key=lambda item: item[0])]


def missing_ranges(done: Iterable[Iterable[tuple[int, int]]], trials: int, batch: int) -> list[tuple[int, int]]:
    """Return the ranges of trials, in rising order, that at least one count of a shared draw still needs.

    Parameters
    ----------
    done
        For each count the ranges of trials that are done; they begin and end where batches do.
    trials, batch
        The number of all trials, and of those in a batch.
    """
    missing = np.zeros(-(-trials // batch) + 2, bool)
    # The counts of one draw have the same trials, unless somebody removed rows from the store.
    for ranges in done:
        own = np.ones(missing.size - 2, bool)
        for first, last in ranges:
            own[first // batch : -(-last // batch)] = False
        missing[1:-1] |= own
    edges = np.flatnonzero(missing[1:] != missing[:-1]) * batch
    return [(int(first), min(int(last), trials)) for first, last in edges.reshape(-1, 2)]
