"""How far run times of ``samplekit compare`` change when two other processes keep the machine busy.

python benchmarks/run_times.py [--runs 5] [--busy 2]

The same study runs alone and beside busy processes, in turn. What is compared are ratios of two rows of one study,
over all pairs of rows, since ratios decide which sampler is faster. The goal is that none changes by 10 % or more.
Exit status 3 if one does.
Two scenes differ in the last digit of a radius alone: rows of equal cost, whose intervals should overlap.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import math
import subprocess
import sys
import time
from statistics import median
from typing import TYPE_CHECKING

import samplekit

if TYPE_CHECKING:
    from collections.abc import Iterator

STUDIES = {
    "depth of field, 64x64": (("random", "uncorrelated-jitter", "r2"), ("depth-of-field",), (1, 4), (64, 64), 8),
    "unit square": (
        ("random", "jittered", "sobol+owen", "halton"),
        ("disk:radius=0.3", "disk:radius=0.30000001"),
        (16, 256),
        (1, 1),
        1000,
    ),
}
BUSY = "while True: sum(range(10000))"


@contextlib.contextmanager
def busy(processes: int) -> Iterator[None]:
    running = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(processes)]
    time.sleep(0.5)
    try:
        yield
    finally:
        for process in running:
            process.kill()
            process.wait()


def times_of(name: str) -> dict[tuple[str, str, int], tuple[float, float, float]]:
    samplers, scenes, counts, size, trials = STUDIES[name]
    found = samplekit.compare(samplers, scenes, counts, trials=trials, size=size)
    seconds = {(row.scene, row.sampler, row.count): row.times.seconds for row in found.rows}
    return {key: (own.estimate, own.low, own.high) for key, own in seconds.items()}


def largest_change(before: list[float], after: list[float]) -> float:
    """Return the largest change of a ratio of two rows, as a fraction."""
    changes = [math.log(new / old) for old, new in zip(before, after, strict=True)]
    return math.exp(max(changes) - min(changes)) - 1.0


def main() -> int:
    worst = 0.0
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--busy", type=int, default=2)
    arguments = parser.parse_args()
    for name in STUDIES:
        times_of(name)
        idle, loaded = [], []
        for _ in range(arguments.runs):
            idle.append(times_of(name))
            with busy(arguments.busy):
                loaded.append(times_of(name))
        rows = list(idle[0])
        print(f"{name}: {len(rows)} rows, {arguments.runs} runs alone and beside {arguments.busy} busy processes")
        for word, runs in (("alone", idle), ("busy", loaded)):
            spread = max(max(run[row][0] for run in runs) / min(run[row][0] for run in runs) for row in rows)
            width = median(run[row][2] / run[row][1] - 1.0 for run in runs for row in rows)
            print(f"  {word}: longest over shortest time of a row {spread:.3f}; intervals {width:.1%} wide, typically")
        changes = [
            largest_change([one[row][0] for row in rows], [two[row][0] for row in rows])
            for one, two in zip(idle, loaded, strict=True)
        ]
        worst = max(worst, *changes)
        medians = [[median(run[row][0] for run in runs) for row in rows] for runs in (idle, loaded)]
        print(f"  largest change of a ratio of two rows: {largest_change(*medians):.1%} between medians over the runs,")
        print(f"  {median(changes):.1%} in the median run and {max(changes):.1%} in the worst")
        equal = [
            (run[one], run[two])
            for run in (*idle, *loaded)
            for one, two in itertools.combinations(rows, 2)
            if one[0] != two[0] and one[1:] == two[1:]
        ]
        if equal:
            overlap = sum(one[1] <= two[2] and two[1] <= one[2] for one, two in equal)
            print(f"  rows of equal cost: the intervals overlap in {overlap} of {len(equal)} comparisons")
    return 3 if worst >= 0.10 else 0


if __name__ == "__main__":
    sys.exit(main())
