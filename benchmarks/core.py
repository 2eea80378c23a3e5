"""Rendering core: samples per second on one thread, as ratios to fused C and to whole-image NumPy in the same run.

python benchmarks/core.py [--spp 64] [--size 512] [--repeats 7]
"""

from __future__ import annotations

import argparse
import ctypes
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np

import samplekit
from samplekit._builtin.samplers.sobol import direction_numbers
from samplekit._integrate.plan import make_plan
from samplekit._integrate.rendering import render_plan

HERE = Path(__file__).parent
SCENES = ("disk", "zoneplate")
SAMPLERS = {"random": "random", "sobol+owen": "owen"}


def build() -> ctypes.CDLL | None:
    if shutil.which("gcc") is None:
        return None
    library = Path(tempfile.mkdtemp()) / "core.so"
    flags = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, str(HERE / "core.c"), "-o", str(library), "-lm"], check=True)
    return ctypes.CDLL(str(library))


def reversed_table(count: int) -> np.ndarray:
    """Sobol's first two dimensions, bits reversed: what the C core scrambles."""
    index = np.arange(count, dtype=np.uint64)
    rows = []
    for columns in direction_numbers(2):
        value = np.zeros(count, np.uint64)
        for bit in range(32):
            value ^= np.where(index >> np.uint64(bit) & np.uint64(1), np.uint64(columns[bit]), np.uint64(0))
        mirrored = np.zeros(count, np.uint64)
        for bit in range(32):
            mirrored |= (value >> np.uint64(bit) & np.uint64(1)) << np.uint64(31 - bit)
        rows.append(mirrored.astype(np.uint32))
    return np.ascontiguousarray(np.concatenate(rows))


def numpy_whole_image(scene: str, size: int, spp: int) -> np.ndarray:
    """What one would write first: all samples of the image at once."""
    rng = np.random.default_rng(0)
    points = rng.random((size, size, spp, 2))
    edge = np.arange(size) / size
    x = edge[None, :, None] + points[..., 0] / size
    y = edge[:, None, None] + points[..., 1] / size
    if scene == "disk":
        return ((x - 0.4523) ** 2 + (y - 0.5317) ** 2 < 0.09).mean(axis=2)
    return (0.5 + 0.5 * np.cos(1024.0 * (x * x + y * y))).mean(axis=2)


def cpu(run) -> float:
    began = time.thread_time()
    run()
    return time.thread_time() - began


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--repeats", type=int, default=7)
    arguments = parser.parse_args()
    size, spp = arguments.size, arguments.spp
    samples = size * size * spp
    library = build()
    table = reversed_table(spp)
    print(f"{size}x{size}, {spp} spp, one thread, float64; medians of {arguments.repeats} interleaved runs, CPU time")
    print(f"{'scene':<11}{'sampler':<12}{'Msamples/s':>11}{'of C':>8}{'x NumPy':>9}{'max |image - C|':>18}")
    for scene in SCENES:
        for sampler, c_name in SAMPLERS.items():
            plan = make_plan(
                samplekit.scene(scene), samplekit.sampler(sampler), spp, size=(size, size), full=True, reference=False
            )
            image = render_plan(plan, threads=1).image
            c_image = np.empty((size, size))

            def run_c(scene: str = scene, c_name: str = c_name, c_image: np.ndarray = c_image) -> None:
                getattr(library, f"{c_name}_{scene}")(
                    c_image.ctypes.data_as(ctypes.c_void_p),
                    *(ctypes.c_long(number) for number in (size, size, spp)),
                    ctypes.c_uint64(0),
                    table.ctypes.data_as(ctypes.c_void_p),
                )

            ours, c, whole = [], [], []
            for repeat in range(arguments.repeats):
                ours.append(cpu(lambda plan=plan: render_plan(plan, threads=1)))
                if library:
                    c.append(cpu(run_c))
                if repeat < 3:
                    whole.append(cpu(lambda scene=scene: numpy_whole_image(scene, size, spp)))
            difference = np.abs(image - c_image).max() if library else np.nan
            ratio = median(c) / median(ours) if library else np.nan
            print(
                f"{scene:<11}{sampler:<12}{samples / median(ours) / 1e6:>11.0f}{ratio:>8.2f}"
                f"{median(whole) / median(ours):>9.1f}{difference:>18.1e}"
            )


if __name__ == "__main__":
    main()
