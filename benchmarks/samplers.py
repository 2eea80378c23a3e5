"""Samplers: points per second on one thread, as ratios to scipy's, and QMCPy's where it is installed, in the same run.

python benchmarks/samplers.py [--repeats 9] [--count 65536] [--fast]

A point is one of a new random set in 2D: making the generator counts, for a set of its own is what a pixel or a trial
needs. "scipy, drawn on" is scipy's rate without it, for comparison. Wanted are three times the best of the same family,
and what C++ programs reach in ratio to scipy on one machine. Sets made as a whole follow: Poisson disks against
scipy's, Lloyd's relaxation and capacity-constrained tessellation with the exponent of their cost.
"""

from __future__ import annotations

import argparse
import math
import time
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import qmc

import samplekit
from samplekit import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable

WANTED = 3.0
SOBOL, HALTON, LATIN = "Sobol", "Halton", "Latin hypercube"
# The ratio of a C++ program to scipy's scrambled generator of the family: stochastic generation (Helmer et al.) 66, 112
# and 9.6 M/s, OpenQMC's lattice 170, pbrt's z-Sobol 3.8 and stratified 16, Samplin' Safari's multi-jitter 18 and
# orthogonal array 5.5, where scipy's Sobol makes 35 and its Halton 2.1.
SAMPLERS: dict[str, tuple[str, float | None]] = {
    "sobol+owen": (SOBOL, 66 / 35),
    "sobol+xor": (SOBOL, None),
    "owen-sobol": (SOBOL, 66 / 35),
    "niederreiter+owen": (SOBOL, 66 / 35),
    "pmj02": (SOBOL, 112 / 35),
    "z-sobol": (SOBOL, 3.8 / 35),
    "r2": (SOBOL, None),
    "rank1": (SOBOL, 170 / 35),
    "fibonacci": (SOBOL, None),
    "halton:scramble=digits": (HALTON, None),
    "halton:scramble=owen": (HALTON, 9.6 / 2.1),
    "halton+owen": (HALTON, 9.6 / 2.1),
    "halton+xor": (HALTON, None),
    "hammersley+owen": (HALTON, 9.6 / 2.1),
    "faure+owen": (HALTON, 9.6 / 2.1),
    "faure+xor": (HALTON, None),
    "latin-hypercube": (LATIN, None),
    "n-rooks": (LATIN, None),
    "jittered": (LATIN, 16 / 35),
    "uncorrelated-jitter": (LATIN, 16 / 35),
    "multi-jittered": (LATIN, None),
    "correlated-multi-jittered": (LATIN, 18 / 35),
    "orthogonal-array": (LATIN, 5.5 / 35),
    "orthogonal-array:offset=multi-jittered": (LATIN, 5.5 / 35),
}


def peers(count: int) -> dict[tuple[str, str], Callable[[], object]]:
    """A new random set of each library, by family and name."""
    found: dict[tuple[str, str], Callable[[], object]] = {
        (SOBOL, "scipy"): lambda: qmc.Sobol(2, rng=1).random(count),
        (HALTON, "scipy"): lambda: qmc.Halton(2, rng=1).random(count),
        (LATIN, "scipy"): lambda: qmc.LatinHypercube(2, rng=1).random(count),
    }
    drawn_on = {SOBOL: qmc.Sobol(2, rng=1), HALTON: qmc.Halton(2, rng=1), LATIN: qmc.LatinHypercube(2, rng=1)}
    for family, engine in drawn_on.items():
        found[family, "scipy, drawn on"] = lambda engine=engine: engine.reset().random(count)
    try:
        import qmcpy
    except ImportError:
        return found
    found[SOBOL, "QMCPy"] = lambda: qmcpy.DigitalNetB2(2, seed=1)(count)
    found[SOBOL, "QMCPy lattice"] = lambda: qmcpy.Lattice(2, seed=1)(count)
    found[HALTON, "QMCPy"] = lambda: qmcpy.Halton(2, seed=1)(count)
    return found


def cpu(run: Callable[[], object], times: int = 1) -> float:
    """Seconds of this thread, for one of as many runs."""
    began = time.thread_time()
    for _ in range(times):
        run()
    return (time.thread_time() - began) / times


def nearest_count(text: str, count: int) -> int:
    sampler = samplekit.sampler(text)
    try:
        sampler.check(count, 2)
    except UsageError:
        return sampler.spec.counts.below(count, 2) or count
    return count


def filler(text: str, count: int) -> Callable[[], object]:
    """Make a new set; the kernels are loaded, and tables that all sets share are made."""
    sampler = samplekit.sampler(text).fresh()
    sampler.prepare(count, 2)
    out = np.empty((1, 2, count))
    trial = iter(range(10**9))

    def fill() -> None:
        first = next(trial)
        sampler.fill(out, sampler.trials(first, first + 1, 0), count, 0)

    fill()
    return fill


def rates(count: int, repeats: int) -> None:
    counts = {text: nearest_count(text, count) for text in SAMPLERS}
    ours = {text: filler(text, counts[text]) for text in SAMPLERS}
    theirs = peers(count)
    seconds: dict[object, list[float]] = {key: [] for key in (*ours, *theirs)}
    for _ in range(repeats):
        for text, run in ours.items():
            seconds[text].append(cpu(run, 5))
        for key, run in theirs.items():
            seconds[key].append(cpu(run))
    speed = {text: counts[text] / median(seconds[text]) for text in ours}
    theirs_speed = {key: count / median(seconds[key]) for key in theirs}
    print(f"New random sets of {count} points in 2D, one thread, CPU time, medians of {repeats} interleaved runs")
    for (family, name), rate in theirs_speed.items():
        print(f"  {family + ': ' + name:<40}{rate / 1e6:>10.1f} M/s")
    print(f"{'':<42}{'M/s':>8}{'x best':>9}{'wanted':>9}{'x scipy':>9}{'C++':>7}{'drawn on':>10}")
    for text, (family, wanted) in SAMPLERS.items():
        rate = speed[text]
        new = {name: r for (f, name), r in theirs_speed.items() if f == family and name != "scipy, drawn on"}
        best = rate / max(new.values())
        of_scipy = rate / new["scipy"]
        drawn_on = rate / theirs_speed[family, "scipy, drawn on"]
        met = best >= WANTED and of_scipy >= (wanted or 0)
        print(
            f"{text:<42}{rate / 1e6:>8.0f}{best:>9.1f}{WANTED:>9.1f}{of_scipy:>9.1f}"
            f"{f'{wanted:.1f}' if wanted else '':>7}{drawn_on:>10.1f}{'' if met else '  MISSED'}"
        )
    print(f"pmj02, {counts['pmj02']} points: {median(seconds['pmj02']) * 1e3:.3f} ms")


def poisson_disks(repeats: int) -> None:
    small, large = 4096, 65536
    run_small, run_large = filler("poisson-disk", small), filler("poisson-disk", large)
    eliminate = filler("poisson-disk:method=elimination", small)
    small_seconds = median(cpu(run_small, 4) for _ in range(repeats))
    large_seconds = median(cpu(run_large) for _ in range(repeats))
    distance = 0.75 / math.sqrt(small)
    theirs = cpu(lambda: qmc.PoissonDisk(2, radius=distance, rng=1).random(small))
    print(
        f"Poisson disk, {small} points: {small_seconds * 1e3:.2f} ms, {theirs / small_seconds:.0f} times scipy's (50)"
    )
    print(f"  by elimination: {cpu(eliminate, 3) * 1e3:.1f} ms")
    print(f"  {large} points: {large_seconds * 1e3:.1f} ms, {large_seconds / small_seconds:.1f} times as long (20)")


def relaxations(repeats: int) -> None:
    for text in ("lloyd", "ccvt"):
        counts = (256, 512, 1024, 2048)
        seconds = []
        for count in counts:
            run = filler(text, count)
            seconds.append(median(cpu(run) for _ in range(max(3, repeats // 3))))
        exponent = np.polyfit(np.log(counts), np.log(seconds), 1)[0]
        listed = ", ".join(f"{count}: {each:.3g} s" for count, each in zip(counts, seconds, strict=True))
        print(f"{text}: {listed}; cost as N^{exponent:.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--count", type=int, default=65536)
    parser.add_argument("--fast", action="store_true", help="leave out what takes seconds: sets made as a whole")
    arguments = parser.parse_args()
    rates(arguments.count, arguments.repeats)
    if not arguments.fast:
        poisson_disks(arguments.repeats)
        relaxations(arguments.repeats)


if __name__ == "__main__":
    main()
