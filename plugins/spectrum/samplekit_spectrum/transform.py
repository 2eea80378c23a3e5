"""N S(m) = sum_k exp(-2 pi i m . x_k) of N points: by a non-uniform FFT, or by matrix products if there are few.

The non-uniform FFT is ducc0's, with a relative error of 1e-12 (Reinecke, Arras, Greengard et al.: Kaiser-Bessel-like
kernels). Two realisations share one transform: one has the strengths 1, the other i, and Hermitian symmetry separates
their spectra.

A cube that is too large for one transform is divided into slabs along its first axis, and each realisation is
transformed by itself: the strengths exp(-2 pi i c . x) move the slab's middle c to the origin.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, NamedTuple

import ducc0  # type: ignore[import-not-found]
import numpy as np

from samplekit_spectrum.exponentials import add_sums, both_signs, multiples, separate
from samplekit_spectrum.frequencies import FrequencyList

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from samplekit_spectrum.frequencies import Cube, Frequencies
    from samplekit_spectrum.point_sets import PointSets

PRECISION = 1e-12

LARGEST_WHOLE = 2**24
"""Number of frequencies of the largest cube that is transformed as a whole."""

_SLAB = 2**22
_SEPARATED = 2**13
"""Number of frequencies that are separated at once: their amplitudes stay in the processor's cache."""

_UNTHREADED = 2**18
"""Number of float64 products in one call up to which OpenBLAS uses a single thread."""

# Seconds on one core by number of dimensions, fitted to measurements (benchmarks/spectrum.py): only their ratios
# matter. The choice follows a fixed model, not a race at run time, so that the same command gives the same bytes.
_PRODUCT_TERM = {1: 5e-9, 2: 0.13e-9, 3: 0.15e-9}
_EXPONENTIAL = 4e-9
_NUFFT_CALL = {1: 20e-6, 2: 40e-6, 3: 150e-6}
_NUFFT_FREQUENCY = {1: 8e-9, 2: 8e-9, 3: 26e-9}
_NUFFT_POINT = {1: 0.05e-6, 2: 0.3e-6, 3: 2e-6}


class Slab(NamedTuple):
    """The entries start to stop of a cube's half, whose first component is ``row`` to ``row + rows - 1``."""

    row: int
    rows: int
    start: int
    stop: int


def slabs(cube: Cube) -> list[Slab]:
    """Divide the half of a cube into slabs of about 4 million frequencies."""
    most = max(1, _SLAB // cube.row)
    parts = []
    for row in range(0, cube.reach + 1, most):
        rows = min(most, cube.reach + 1 - row)
        # The half begins in the middle of row 0.
        start, stop = (end * cube.row - cube.row // 2 for end in (row, row + rows))
        parts.append(Slab(row, rows, max(0, start), stop))
    return parts


def seconds(cube: Cube, count: int) -> tuple[float, float]:
    """Estimate how long matrix products and the non-uniform FFT take for a set of ``count`` points."""
    dims = cube.dims
    products = cube.half * count * _PRODUCT_TERM[dims] + (cube.reach + 1) * dims * count * _EXPONENTIAL
    return products, _NUFFT_CALL[dims] + cube.size * _NUFFT_FREQUENCY[dims] + count * _NUFFT_POINT[dims]


def few_points(cube: Cube, count: int) -> bool:
    """Return whether matrix products are faster than the non-uniform FFT for sets of ``count`` points."""
    products, nufft = seconds(cube, count)
    return products < nufft


def amplitudes(
    sets: PointSets, axes: tuple[int, ...], frequencies: Frequencies
) -> Iterator[tuple[int, NDArray[np.complex128]]]:
    """Yield N S of the sets projected on ``axes``, in parts: the first entry, and complex128[sets, entries]."""

    def total(transform: Callable[..., NDArray[np.complex128]], *slab: Slab) -> NDArray[np.complex128]:
        return reduce(np.add, (transform(points, frequencies, *slab) for points in sets.chunks(axes)))

    if isinstance(frequencies, FrequencyList):
        yield 0, total(listed_sums)
        return
    half = frequencies.half
    few = few_points(frequencies, sets.source.count)
    if few or frequencies.size > LARGEST_WHOLE:
        for slab in slabs(frequencies):
            rows = total(product_slab if few else nufft_slab, slab)
            yield slab.start, rows[:, slab.start - slab.stop :]
    elif sets.members == 1:
        yield 0, total(nufft_pair)[None, half - 1 :]
    else:
        mixed = total(nufft_pair)
        for start in range(0, half, _SEPARATED):
            pair = np.empty((2, min(_SEPARATED, half - start)), np.complex128)
            separate(mixed, start, pair)
            yield start, pair


def listed_sums(points: NDArray[np.float64], frequencies: FrequencyList) -> NDArray[np.complex128]:
    """Return N S of points float64[k, D, n] at listed frequencies, complex128[k, K]."""
    sums = np.zeros((points.shape[0], frequencies.half), np.complex128)
    for member, coordinates in enumerate(points):
        # x is the last coordinate, and the first component of a listed frequency.
        add_sums(frequencies.vectors, np.ascontiguousarray(coordinates[::-1]), sums[member])
    return sums


def nufft_pair(points: NDArray[np.float64], cube: Cube) -> NDArray[np.complex128]:
    """Return Z = A + i B on the whole cube, complex128[size], for the spectra A and B of two sets; A for one set."""
    members, dims, count = points.shape
    strengths = np.ones(members * count, np.complex128)
    strengths[count:] = 1j
    coordinates = points.transpose(0, 2, 1).reshape(-1, dims)
    return _nufft(coordinates, strengths, (cube.side,) * dims, cube.step)


def nufft_slab(points: NDArray[np.float64], cube: Cube, slab: Slab) -> NDArray[np.complex128]:
    """Return N S of each set on the rows of a slab, complex128[k, rows * row]."""
    # The transform is symmetric about its middle, so it has an odd number of rows.
    height = slab.rows + 1 - slab.rows % 2
    middle = (slab.row + height // 2) * cube.step
    sums = np.empty((points.shape[0], slab.rows * cube.row), np.complex128)
    real, imaginary = np.empty((2, 1, points.shape[2]))
    for member, coordinates in enumerate(points):
        multiples(1, middle, np.ascontiguousarray(coordinates[0]), real, imaginary)
        strengths = (real + 1j * imaginary)[0]
        shape = (height,) + (cube.side,) * (cube.dims - 1)
        sums[member] = _nufft(np.ascontiguousarray(coordinates.T), strengths, shape, cube.step)[: sums.shape[1]]
    return sums


def product_slab(points: NDArray[np.float64], cube: Cube, slab: Slab) -> NDArray[np.complex128]:
    """Return N S of each set on the rows of a slab, complex128[k, rows * row].

    A sum of products L(my) T(mx) over the points is a matrix product. Real products serve both T(mx) and T(-mx).
    """
    sets, dims, count = points.shape
    sums = np.empty((sets, slab.rows * cube.row), np.complex128)
    for member, coordinates in enumerate(points):
        left = _table(slab.row, slab.rows, cube.step, coordinates[0])
        if dims == 1:
            sums[member] = left[0].sum(axis=1) + 1j * left[1].sum(axis=1)
            continue
        for axis in range(1, dims - 1):
            left = _outer(left, _table(0, cube.reach + 1, cube.step, coordinates[axis]))
        right = _table(0, cube.reach + 1, cube.step, coordinates[dims - 1])
        products = _product(left.reshape(-1, count), right.reshape(-1, count))
        both_signs(products.reshape(2, left.shape[1], -1), sums[member].reshape(left.shape[1], cube.side))
    return sums


def _table(first: int, rows: int, step: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return exp(-2 pi i m step x) for m from ``first`` on, float64[2, rows, n]: real parts, imaginary parts."""
    table = np.empty((2, rows, x.size))
    multiples(first, step, np.ascontiguousarray(x), table[0], table[1])
    return table


def _outer(left: NDArray[np.float64], table: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return all products of the rows of one table and of both signs of the other, float64[2, rows * side, n]."""
    real = np.concatenate([table[0, :0:-1], table[0]])
    imaginary = np.concatenate([-table[1, :0:-1], table[1]])
    a, b = left[0][:, None], left[1][:, None]
    count = real.shape[1]
    return np.stack([(a * real - b * imaginary).reshape(-1, count), (a * imaginary + b * real).reshape(-1, count)])


def _product(left: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return left @ right.T, in parts so small that BLAS uses one thread: the realisations use all threads already."""
    out = np.empty((left.shape[0], right.shape[0]))
    rows = max(1, _UNTHREADED // right.size)
    for start in range(0, left.shape[0], rows):
        np.matmul(left[start : start + rows], right.T, out=out[start : start + rows])
    return out


def _nufft(
    coordinates: NDArray[np.float64], strengths: NDArray[np.complex128], shape: tuple[int, ...], step: float
) -> NDArray[np.complex128]:
    out = np.empty(shape, np.complex128)
    ducc0.nufft.nu2u(
        points=strengths,
        # Frequencies step * m of the points x are frequencies m of the points step * x.
        coord=coordinates * step,
        out=out,
        forward=True,
        epsilon=PRECISION,
        nthreads=1,
        periodicity=1.0,
        fft_order=False,
    )
    return out.reshape(-1)
