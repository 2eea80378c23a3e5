"""An estimate of 10^9 points in constant memory, and the digits that its sum lost against double-doubles.

python benchmarks/streaming.py [--count 1e9] [--sampler random] [--scene gaussian]
"""

from __future__ import annotations

import argparse
import time

import numpy as np
import psutil

from samplekit import sampler as configured_sampler
from samplekit import scene as configured_scene
from samplekit._stability.measurement import measure


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=float, default=1e9)
    parser.add_argument("--sampler", default="random")
    parser.add_argument("--scene", default="gaussian")
    arguments = parser.parse_args()
    scene, sampler = configured_scene(arguments.scene), configured_sampler(arguments.sampler)
    edges = np.array([0.0, 1.0])
    reference = scene.reference(edges, edges)
    process = psutil.Process()
    measure(scene, sampler, 4096, realizations=1, seed=0, reference=reference)
    before, most = process.memory_info().rss, 0
    began = time.perf_counter()

    def tick(samples: int) -> None:
        nonlocal most
        most = max(most, process.memory_info().rss)

    count = int(arguments.count)
    measured = measure(scene, sampler, count, realizations=1, seed=0, reference=reference, tick=tick)
    seconds = time.perf_counter() - began
    print(
        f"{scene.text}, {sampler.text}, {count} points twice over: {seconds:.0f} s, {seconds / count * 1e9:.0f} ns each"
    )
    print(f"estimate {measured.estimate!r}, exact {measured.exact!r}, error {measured.error:.3g}")
    print(f"expected of random points {measured.deviation / count**0.5:.3g}")
    print(f"digits lost in the sum {measured.digits_lost:.2f}, rounding {measured.arithmetic_error:.3g}")
    print(f"memory {before / 2**20:.0f} MiB before, {most / 2**20:.0f} MiB at most")


if __name__ == "__main__":
    main()
