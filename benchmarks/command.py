"""Whole commands: CPU time against bare imports, threads against one, memory against samples, pixels left out.

python benchmarks/command.py [--repeats 5]
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from statistics import median

MEASURE = """
import json, resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps([used.ru_utime + used.ru_stime, used.ru_maxrss / 1024]))
"""
RENDER = [sys.executable, "-m", "samplekit", "render"]


def measure(command: list[str], folder: str) -> tuple[float, float]:
    """CPU seconds and peak memory in MiB of one run."""
    run = [sys.executable, "-c", MEASURE, *command]
    seconds, memory = json.loads(subprocess.run(run, check=True, capture_output=True, text=True, cwd=folder).stdout)
    return seconds, memory


def ratio(name: str, a: list[str], b: list[str], repeats: int, folder: str) -> None:
    measure(a, folder), measure(b, folder)
    pairs = [(measure(a, folder)[0], measure(b, folder)[0]) for _ in range(repeats)]
    ratios = [x / y for x, y in pairs]
    a_seconds, b_seconds = (median(times) for times in zip(*pairs, strict=True))
    print(f"{name}: {median(ratios):.2f} (CPU {a_seconds:.2f} s / {b_seconds:.2f} s)")


def report(words: list[str], folder: str) -> dict[str, float]:
    done = subprocess.run([*RENDER, *words, "--json"], check=True, capture_output=True, text=True, cwd=folder)
    return json.loads(done.stdout)


def threads(spp: int, repeats: int, folder: str) -> None:
    times: dict[str, list[float]] = {"1": [], "2": []}
    for _ in range(repeats):
        for count, seconds in times.items():
            words = ["--sampler", "sobol+owen", "--spp", str(spp), "--threads", count, "--no-error"]
            seconds.append(report(words, folder)["seconds"]["total"])
    print(f"two threads against one, zone plate, {spp} spp: {min(times['1']) / min(times['2']):.2f} times as fast")


def memory(folder: str) -> None:
    peaks = {}
    for spp in (256, 65536):
        words = ["--sampler", "sobol+owen", "--spp", str(spp), "--size", "64", "--threads", "1"]
        peaks[spp] = measure([*RENDER, *words], folder)[1]
    growth = 100 * (peaks[65536] / peaks[256] - 1)
    print(f"peak memory, 64x64: {peaks[256]:.0f} MiB at 256 spp, {peaks[65536]:.0f} MiB at 65536 spp: {growth:+.1f} %")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeats", type=int, default=5)
    repeats = parser.parse_args().repeats
    python = [sys.executable, "-c"]
    with tempfile.TemporaryDirectory() as folder:
        image = [*RENDER, "--sampler", "hammersley", "--spp", "16"]
        ratio("render / imports", image, [*python, "import numpy, numba, OpenImageIO"], repeats, folder)
        version = [sys.executable, "-m", "samplekit", "--version"]
        ratio("--version / import typer", version, [*python, "import typer"], repeats, folder)
        threads(1024, repeats, folder)
        disk = report(["--scene", "disk", "--sampler", "sobol+owen", "--spp", "256"], folder)
        print(f"disk: {100 * disk['pixels_sampled'] / 512**2:.2f} % of the pixels sampled")
        memory(folder)


if __name__ == "__main__":
    main()
