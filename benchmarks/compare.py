"""What ``samplekit compare`` adds to drawing and evaluating points, what two workers gain, and how far C is away.

python benchmarks/compare.py [--samples 1e7] [--repeats 7]

Ratios of one run, since the machine changes. Times are the processor's, medians of interleaved runs, but for the gain
of two workers, which the wall clock tells: on an idle machine alone.
"""

from __future__ import annotations

import argparse
import ctypes
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
from core import build, reversed_table

import samplekit
from samplekit._integrate.loop import integrate, unit_square
from samplekit._integrate.plan import make_plan
from samplekit._integrate.rendering import render_plan
from samplekit._study.trials import seed_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

SAMPLERS = ("random", "jittered", "sobol+owen")
SCENES = ("disk", "gaussian")
COUNTS = (16, 64, 256, 1024, 4096)
EEA = (46.0, 66.0)
"""Nanoseconds a sample of EmpiricalErrorAnalysis, measured apart, on a machine of the same kind."""
EEA_COUNTS = (64, 256, 1024, 1600, 2500)


def interleaved(runs: dict[str, Callable[[], object]], repeats: int, clock: Callable[[], float]) -> dict[str, float]:
    seconds: dict[str, list[float]] = {name: [] for name in runs}
    for repeat in range(repeats + 1):
        for name, run in runs.items():
            began = clock()
            run()
            if repeat:
                seconds[name].append(clock() - began)
    return {name: median(values) for name, values in seconds.items()}


def pure_square(scene_name: str, sampler: str, count: int, trials: int) -> float:
    scene, source = samplekit.scene(scene_name), samplekit.sampler(sampler)
    realizations = source.trials(0, trials, 0, scene.blocks)
    return float(integrate(scene, source, (count,), realizations, unit_square(trials)).mean())


def pure_images(sampler: str, count: int, trials: int, size: tuple[int, int]) -> None:
    scene, source = samplekit.scene("zoneplate"), samplekit.sampler(sampler)
    for trial in range(trials):
        render_plan(make_plan(scene, source, count, size=size, seed=seed_of(0, trial), reference=False), threads=1)


def overhead(samples: float, repeats: int) -> None:
    print(f"overhead: unit square, {samples:.0g} samples in each of 6 rows (3 samplers, disk and gaussian), one thread")
    print(f"{'count':>8}{'trials':>9}{'ns a sample':>13}{'compare':>9}{'with files':>12}   (points and scene alone: 1)")
    for count in COUNTS:
        trials = int(samples / count)
        with tempfile.TemporaryDirectory() as folder:
            number = iter(range(10**6))

            def study(count: int = count, trials: int = trials, **how: object) -> None:
                samplekit.compare(SAMPLERS, SCENES, count, trials=trials, size=(1, 1), threads=1, times=False, **how)

            def stored(folder: str = folder, number: Iterator[int] = number, study: Callable = study) -> None:
                study(output=Path(folder) / str(next(number)))

            def pure(count: int = count, trials: int = trials) -> None:
                for scene in SCENES:
                    for sampler in SAMPLERS:
                        pure_square(scene, sampler, count, trials)

            took = interleaved({"pure": pure, "compare": study, "files": stored}, repeats, time.process_time)
        nanoseconds = took["pure"] / (6 * trials * count) * 1e9
        shares = took["compare"] / took["pure"], took["files"] / took["pure"]
        print(f"{count:>8}{trials:>9}{nanoseconds:>13.2f}{shares[0]:>9.3f}{shares[1]:>12.3f}")


def image_overhead(samples: float, repeats: int) -> None:
    print(f"\noverhead: images of 128x128, zoneplate, {samples:.0g} samples in each of 3 rows, one thread")
    print(f"{'count':>8}{'trials':>9}{'ns a sample':>13}{'compare':>9}   (rendering alone: 1)")
    for count in (4, 16, 64):
        trials = max(1, int(samples / count / 128**2))

        def study(count: int = count, trials: int = trials) -> None:
            samplekit.compare(SAMPLERS, "zoneplate", count, trials=trials, size=(128, 128), threads=1, times=False)

        def pure(count: int = count, trials: int = trials) -> None:
            for sampler in SAMPLERS:
                pure_images(sampler, count, trials, (128, 128))

        took = interleaved({"pure": pure, "compare": study}, repeats, time.process_time)
        nanoseconds = took["pure"] / (3 * trials * count * 128**2) * 1e9
        print(f"{count:>8}{trials:>9}{nanoseconds:>13.2f}{took['compare'] / took['pure']:>9.3f}")


def workers(samples: float, repeats: int) -> None:
    print("\ntwo workers: wall clock of one over that of two, set-up and start of processes included and not")
    ask = {"size": (1, 1), "times": False}
    for how in ({"threads": 2}, {"processes": 2}):
        word = next(iter(how))
        took = {}
        for factor in (1, 4):
            trials = int(factor * samples / 4096)
            runs = {
                "one": lambda t=trials: samplekit.compare(SAMPLERS, SCENES, 4096, trials=t, threads=1, **ask),
                "two": lambda t=trials, h=how: samplekit.compare(SAMPLERS, SCENES, 4096, trials=t, **h, **ask),
            }
            took[factor] = interleaved(runs, repeats, time.perf_counter)
        whole = took[4]["one"] / took[4]["two"]
        rest = (took[4]["one"] - took[1]["one"]) / (took[4]["two"] - took[1]["two"])
        print(f"  {word}: {whole:.2f} in all, {rest:.2f} for what comes after the start")


def against_c(repeats: int) -> None:
    library = build()
    if library is None:
        print("\nno C compiler: no ratio to C")
        return
    trials = 1000
    tables = {count: reversed_table(count) for count in EEA_COUNTS}
    image = np.empty(trials)

    def in_c() -> None:
        for count in EEA_COUNTS:
            library.random_disk(
                image.ctypes.data_as(ctypes.c_void_p),
                *(ctypes.c_long(number) for number in (trials, 1, count)),
                ctypes.c_uint64(0),
                tables[count].ctypes.data_as(ctypes.c_void_p),
            )

    def study() -> None:
        samplekit.compare("random", "disk", EEA_COUNTS, trials=trials, size=(1, 1), threads=1, times=False)

    took = interleaved({"C": in_c, "compare": study}, 3 * repeats, time.process_time)
    samples = trials * sum(EEA_COUNTS)
    ours, c = (took[name] / samples * 1e9 for name in ("compare", "C"))
    drawn = trials * max(EEA_COUNTS)
    print(f"\nrandom on disk, {len(EEA_COUNTS)} counts x {trials} trials, {samples / 1e6:.1f} M samples, one thread")
    of_drawn = took["compare"] / drawn * 1e9
    print(f"  compare: {ours:.2f} ns a sample, {ours / c:.2f} of C's {c:.2f}; {of_drawn:.2f} for each that is drawn")
    factors = f"{EEA[0] / ours:.0f} to {EEA[1] / ours:.0f}"
    print(f"  EmpiricalErrorAnalysis: {EEA[0]:g} to {EEA[1]:g} ns a sample, {factors} times as much")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--samples", type=float, default=1e7)
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    overhead(arguments.samples, arguments.repeats)
    image_overhead(arguments.samples, arguments.repeats)
    against_c(arguments.repeats)
    workers(3 * arguments.samples, arguments.repeats)


if __name__ == "__main__":
    main()
