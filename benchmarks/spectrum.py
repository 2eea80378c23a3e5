"""How fast power spectra are, as ratios from one run: python benchmarks/spectrum.py [--quick].

Against the plain double loop in C, against separable exponentials by BLAS, and against the bare calls of the
non-uniform FFT. Then the cost by number of points and of frequencies, from a fit, and where matrix products are faster.
"""

import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# One core for all, so that ratios compare methods and not numbers of threads.
for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import ducc0  # noqa: E402
import numpy as np  # noqa: E402
from samplekit_spectrum.expectation import Projection, SharedState, block_moments  # noqa: E402
from samplekit_spectrum.frequencies import Cube  # noqa: E402
from samplekit_spectrum.moments import Moments  # noqa: E402
from samplekit_spectrum.point_sets import Source  # noqa: E402
from samplekit_spectrum.transform import PRECISION, few_points, nufft_pair, product_slab, slabs  # noqa: E402

import samplekit  # noqa: E402

LOOP = r"""
#include <math.h>
void power(const double *x, const double *y, long n, long first, long rows, long reach, double *out) {
    for (long j = 0; j < rows; j++)
        for (long m = -reach; m <= reach; m++) {
            double re = 0.0, im = 0.0;
            for (long k = 0; k < n; k++) {
                double a = -6.283185307179586 * (m * x[k] + (first + j) * y[k]);
                re += cos(a);
                im += sin(a);
            }
            out[j * (2 * reach + 1) + m + reach] = (re * re + im * im) / ((double)n * n);
        }
}
"""


def best(call, least=0.2, most=30):
    """The least CPU seconds of several calls."""
    times, began = [], time.perf_counter()
    while len(times) < 3 or (time.perf_counter() - began < least and len(times) < most):
        start = time.thread_time()
        call()
        times.append(time.thread_time() - start)
    return min(times)


def double_loop(points, reach, rows):
    """Seconds of the loop over the whole square, from the time of some rows; None without a compiler."""
    compiler = shutil.which("gcc")
    if compiler is None:
        return None, None
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "loop.c", Path(folder) / "loop.so"
        source.write_text(LOOP)
        options = ["-O3", "-march=native", "-shared", "-fPIC"]
        subprocess.run([compiler, *options, str(source), "-o", str(library), "-lm"], check=True)
        power = ctypes.CDLL(str(library)).power
        pointer = ctypes.POINTER(ctypes.c_double)
        x, y = (np.ascontiguousarray(row) for row in points)
        out = np.empty((rows, 2 * reach + 1))
        arguments = [x.ctypes.data_as(pointer), y.ctypes.data_as(pointer), ctypes.c_long(x.size), ctypes.c_long(3)]
        arguments += [ctypes.c_long(rows), ctypes.c_long(reach), out.ctypes.data_as(pointer)]
        seconds = best(lambda: power(*arguments), least=0.0)
        return seconds * (2 * reach + 1) / rows, out


def separable(points, reach):
    """The half plane by complex exponentials and zgemm."""
    m = np.arange(reach + 1)
    base = np.exp(-2j * np.pi * points)
    tables = []
    for row in base:
        table = np.empty((reach + 1, row.size), complex)
        table[0] = 1.0
        for j in m[1:]:
            np.multiply(table[j - 1], row, out=table[j])
        tables.append(table)
    both = np.concatenate([tables[0][:0:-1].conj(), tables[0]])
    return np.abs(tables[1] @ both.T) ** 2 / points.shape[1] ** 2


def bare(coordinates, strengths, reach):
    out = np.empty((2 * reach + 1,) * 2, complex)
    ducc0.nufft.nu2u(
        points=strengths, coord=coordinates, out=out, forward=True, epsilon=PRECISION, nthreads=1, periodicity=1.0,
        fft_order=False,
    )  # fmt: skip
    return out


def ours(count, reach, realizations):
    """CPU seconds of a realisation, in a block as threads get them: points, transform, means, rings."""
    source = Source(samplekit.sampler("random"), count, 2, 0)
    projection = Projection((0, 1), Cube(2, reach))
    rings = [projection.frequencies.rings()]
    total = Moments(rings[0])

    def block():
        total.merge(block_moments(source, [projection], rings, 0, realizations, SharedState())[0])

    return best(block, least=0.0) / realizations


def main():
    quick = "--quick" in sys.argv
    count, reach = 4096, 256
    points = samplekit.points("random", count)[0].T
    print(f"one realisation, N = {count}, {2 * reach + 1} x {2 * reach + 1} frequencies, one core")
    pair = samplekit.points("random", count, realizations=2)
    coordinates = np.ascontiguousarray(np.concatenate([pair[0], pair[1]])[:, ::-1])
    strengths = np.repeat(np.array([1.0, 1j]), count)
    # By turns: a machine that others use is slower at times.
    turns = [
        (best(lambda: bare(coordinates, strengths, reach)) / 2, ours(count, reach, 20))
        for _ in range(3 if quick else 8)
    ]
    alone, mine = (min(column) for column in zip(*turns, strict=True))
    blas = best(lambda: separable(points, reach))
    loop, rows = double_loop(points, reach, 1 if quick else 2)
    print(f"  this program                {mine * 1e3:10.2f} ms")
    print(f"  bare calls of ducc0         {alone * 1e3:10.2f} ms   this program is {mine / alone:.2f} times that")
    print(f"  exponentials and BLAS       {blas * 1e3:10.2f} ms   {blas / mine:.0f} times this program")
    if loop is not None:
        mixed = bare(np.ascontiguousarray(points.T[:, ::-1]), np.ones(count, complex), reach)[reach + 3]
        difference = np.abs(np.abs(mixed / count) ** 2 - rows[0]).max()
        print(f"  double loop in C            {loop * 1e3:10.0f} ms   {loop / mine:.0f} times this program")
        print(f"  (largest difference from the loop: {difference:.1e})")
    else:
        print("  double loop in C            no gcc")

    print("cost of a realisation")
    rows = [(2**k, f) for k in (9, 10, 12, 14, 16) for f in (64, 128, 256)]
    seconds = np.array([ours(n, f, max(2, min(16, 2**17 // n // 2 * 2))) for n, f in rows])
    design = np.array([[1.0, (2 * f + 1) ** 2, n] for n, f in rows])
    # Relative errors count: each row is divided by its time.
    fit = np.linalg.lstsq(design / seconds[:, None], np.ones(len(rows)), rcond=None)[0]
    spread = np.abs(design @ fit / seconds - 1).max()
    print(
        f"  {fit[0] * 1e6:.0f} us + {fit[1] * 1e9:.1f} ns for each of (2F + 1)^2 frequencies"
        f" + {fit[2] * 1e9:.0f} ns for each point; within {spread:.0%}"
    )

    print("matrix products over non-uniform FFT, for one realisation")
    rng = np.random.default_rng(0)
    for f in (32, 128, 256):
        cube = Cube(2, f)
        line = []
        for n in (16, 64, 128, 256, 512):
            sets = rng.random((2, 2, n))
            products = best(lambda c=cube, s=sets: [product_slab(s, c, slab) for slab in slabs(c)])
            nufft = best(lambda c=cube, s=sets: nufft_pair(s, c))
            line.append(f"N={n}: {products / nufft:.2f}{'*' if few_points(cube, n) else ''}")
        print(f"  F={f:<5}" + "  ".join(line))
    print("  (* where matrix products are chosen)")


if __name__ == "__main__":
    main()
