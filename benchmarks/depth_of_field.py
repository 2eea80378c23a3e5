"""Depth of field with Owen-scrambled Sobol points on one thread: against fused C, and what constant pixels are worth.

python benchmarks/depth_of_field.py [--spp 64] [--size 512] [--repeats 7]
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
from samplekit._builtin.scenes.depth_of_field import FRONT, RING, WALL, DepthOfField
from samplekit._integrate.plan import make_plan
from samplekit._integrate.rendering import render_plan

HERE = Path(__file__).parent


def build() -> ctypes.CDLL | None:
    if shutil.which("gcc") is None:
        return None
    library = Path(tempfile.mkdtemp()) / "depth_of_field.so"
    flags = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, str(HERE / "depth_of_field.c"), "-o", str(library), "-lm"], check=True)
    return ctypes.CDLL(str(library))


def reversed_table(count: int) -> np.ndarray:
    """Sobol's first four dimensions, bits reversed: what the C core scrambles."""
    index = np.arange(count, dtype=np.uint64)
    table = np.zeros((4, count), np.uint32)
    for row, columns in zip(table, direction_numbers(4), strict=True):
        for bit in range(32):
            mirrored = int(f"{int(columns[bit]):032b}"[::-1], 2)
            row ^= np.where(index >> np.uint64(bit) & np.uint64(1), np.uint32(mirrored), np.uint32(0))
    return table


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

    def plan(full: bool):
        scene, sampler = samplekit.scene("depth-of-field"), samplekit.sampler("sobol+owen")
        return make_plan(scene, sampler, spp, size=(size, size), full=full, reference=False)

    library, table = build(), reversed_table(spp)
    c_image, confusion = np.empty((size, size)), DepthOfField().confusion

    def run_c() -> None:
        library.depth_of_field(
            c_image.ctypes.data_as(ctypes.c_void_p),
            *(ctypes.c_long(number) for number in (size, size, spp)),
            ctypes.c_uint64(0),
            *(array.ctypes.data_as(ctypes.c_void_p) for array in (table, FRONT, RING, WALL, confusion)),
        )

    full_image = render_plan(plan(True), threads=1).image
    some = render_plan(plan(False), threads=1)
    print(f"{size}x{size}, {spp} spp, one thread, float64; medians of {arguments.repeats} interleaved runs, CPU time")
    c, full, left_out = [], [], []
    for _ in range(arguments.repeats):
        if library:
            c.append(cpu(run_c))
        full.append(cpu(lambda: render_plan(plan(True), threads=1)))
        # A plan of its own each time: finding the constant pixels is part of the price.
        left_out.append(cpu(lambda: render_plan(plan(False), threads=1)))
    print(f"all pixels: {size * size * spp / median(full) / 1e6:.0f} Msamples/s", end="")
    if library:
        pixels = np.count_nonzero(np.abs(c_image - full_image) > 1e-12)
        print(f", {median(c) / median(full):.2f} of C ({pixels} of {size * size} pixels differ by more than 1e-12)")
    print(
        f"constant pixels left out ({100 * some.metrics['pixels_left_out'] / size**2:.0f} %):"
        f" {median(full) / median(left_out):.2f} times as fast; equal bit for bit:"
        f" {np.array_equal(some.image, full_image)}"
    )


if __name__ == "__main__":
    main()
