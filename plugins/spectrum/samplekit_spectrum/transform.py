"""Points to S(m) = sum_k exp(-2 pi i m . x_k): non-uniform FFT, or exponentials by matrix products for few points.

The non-uniform FFT is ducc0's, at a relative error of 1e-12 (Reinecke, Arras, Greengard et al.: Kaiser-Bessel-like
kernels). Two realisations share one transform: with strengths 1 and i its result Z unmixes by Hermitian symmetry,
A = (Z(m) + conj Z(-m)) / 2 and B = (Z(m) - conj Z(-m)) / 2i.

A cube too large for that is taken in slabs of its first axis, one realisation at a time: strengths
exp(-2 pi i c . x) move the slab's middle c to the origin.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import ducc0  # type: ignore[import-not-found]
import numpy as np

from samplekit_spectrum.exponentials import both_signs, exponentials, multiples

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit_spectrum.frequencies import Cube

Chunks = Callable[[], Iterable["NDArray[np.float64]"]]
"""Gives the points of some sets in parts: float64[k, D, n] each, the axes in the order of the cube's (..., y, x)."""

PRECISION = 1e-12

LARGEST_WHOLE = 2**24
"""Frequencies of the largest cube that is transformed as a whole."""

_SLAB = 2**22

_UNTHREADED = 2**18
"""Products of float64 in one call up to which OpenBLAS keeps to one thread."""

# Seconds on one core by number of dimensions, fitted to measurements (benchmarks/spectrum.py): only their ratios
# matter. A fixed model and not a race at run time, so that the same command gives the same bytes.
_PRODUCT_TERM = {1: 5e-9, 2: 0.13e-9, 3: 0.15e-9}
_EXPONENTIAL = 4e-9
_NUFFT_CALL = {1: 20e-6, 2: 40e-6, 3: 150e-6}
_NUFFT_FREQUENCY = {1: 8e-9, 2: 8e-9, 3: 26e-9}
_NUFFT_POINT = {1: 0.05e-6, 2: 0.3e-6, 3: 2e-6}


@dataclass(frozen=True)
class Slab:
    """Frequencies of the half whose first component is ``row`` to ``row + rows - 1``: entries start to stop."""

    row: int
    rows: int
    start: int
    stop: int


def slabs(cube: Cube) -> list[Slab]:
    """The half of a cube in parts of about 4 million frequencies."""
    rows = max(1, _SLAB // cube.row)
    parts = []
    for row in range(0, cube.reach + 1, rows):
        height = min(rows, cube.reach + 1 - row)
        start = max(0, row * cube.row - cube.first)
        parts.append(Slab(row, height, start, (row + height) * cube.row - cube.first))
    return parts


def few_points(cube: Cube, count: int) -> bool:
    """Return whether matrix products are faster than the non-uniform FFT, for each set of ``count`` points."""
    return _by_products_seconds(cube, count) < _nufft_seconds(cube, count)


def seconds(cube: Cube, count: int) -> float:
    """About how long a transform takes; only ratios matter."""
    return min(_by_products_seconds(cube, count), _nufft_seconds(cube, count))


def _by_products_seconds(cube: Cube, count: int) -> float:
    dims = cube.dims
    return cube.half * count * _PRODUCT_TERM[dims] + (cube.reach + 1) * dims * count * _EXPONENTIAL


def _nufft_seconds(cube: Cube, count: int) -> float:
    dims = cube.dims
    return _NUFFT_CALL[dims] + cube.side * cube.row * _NUFFT_FREQUENCY[dims] + count * _NUFFT_POINT[dims]


def of_pair(chunks: Chunks, cube: Cube) -> NDArray[np.complex128]:
    """Z of two realisations on the whole cube, complex128[side^dims]; of one, if the chunks hold one."""
    shape = (cube.side,) * cube.dims
    total: NDArray[np.complex128] | None = None
    for points in chunks():
        pair, dims, count = points.shape
        coordinates = np.empty((pair * count, dims))
        strengths = np.ones(pair * count, np.complex128)
        for member in range(pair):
            coordinates[member * count : (member + 1) * count] = points[member].T
        strengths[count:] = 1j
        out = _nufft(coordinates, strengths, shape, cube.step)
        total = out if total is None else total + out
    assert total is not None
    return total.reshape(-1)


def of_slab(chunks: Chunks, cube: Cube, slab: Slab) -> NDArray[np.complex128]:
    """S of one realisation at a slab's frequencies, complex128[1, stop - start]."""
    height = slab.rows + 1 - slab.rows % 2
    middle = slab.row + height // 2
    total: NDArray[np.complex128] | None = None
    for points in chunks():
        coordinates = np.ascontiguousarray(points[0].T)
        strengths = np.empty((1, coordinates.shape[0]), np.complex128)
        exponentials(np.array([middle * cube.step]), np.ascontiguousarray(points[0, 0]), strengths)
        out = _nufft(coordinates, strengths[0], (height,) + (cube.side,) * (cube.dims - 1), cube.step)
        total = out if total is None else total + out
    assert total is not None
    flat = total.reshape(-1)[: slab.rows * cube.row]
    return flat[flat.size - (slab.stop - slab.start) :][None]


def by_products(chunks: Chunks, cube: Cube, slab: Slab) -> NDArray[np.complex128]:
    """S of all realisations at a slab's frequencies, complex128[k, stop - start].

    A sum of products L(my) T(mx) over the points is a matrix product. In real numbers, T(mx) and T(-mx) share theirs.
    """
    total: NDArray[np.complex128] | None = None
    for points in chunks():
        sets, dims, count = points.shape
        out = np.empty((sets, slab.rows * cube.row), np.complex128)
        for member, coordinates in enumerate(points):
            rows = np.ascontiguousarray(coordinates)
            left = np.empty((2, slab.rows, count))
            multiples(slab.row, cube.step, rows[0], left[0], left[1])
            if dims == 1:
                out[member] = left[0].sum(axis=1) + 1j * left[1].sum(axis=1)
                continue
            for axis in range(1, dims - 1):
                left = _outer(left, _table(cube, rows[axis]))
            products = _product(left.reshape(-1, count), _table(cube, rows[dims - 1]).reshape(-1, count))
            both_signs(products.reshape(2, left.shape[1], -1), out[member].reshape(left.shape[1], cube.side))
        total = out if total is None else total + out
    assert total is not None
    return total[:, total.shape[1] - (slab.stop - slab.start) :]


def _table(cube: Cube, x: NDArray[np.float64]) -> NDArray[np.float64]:
    """exp(-2 pi i m x) for m from 0 on, float64[2, F + 1, K]: real parts, imaginary parts."""
    table = np.empty((2, cube.reach + 1, x.size))
    multiples(0, cube.step, x, table[0], table[1])
    return table


def _outer(left: NDArray[np.float64], table: NDArray[np.float64]) -> NDArray[np.float64]:
    """All products of rows of the one and of both signs of the other, float64[2, rows * side, K]."""
    real = np.concatenate([table[0, :0:-1], table[0]])
    imaginary = np.concatenate([-table[1, :0:-1], table[1]])
    a, b = left[0][:, None], left[1][:, None]
    count = real.shape[1]
    return np.stack([(a * real - b * imaginary).reshape(-1, count), (a * imaginary + b * real).reshape(-1, count)])


def _product(left: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return left @ right.T, in parts so small that BLAS takes no threads: the realisations have them already."""
    out = np.empty((left.shape[0], right.shape[0]))
    rows = max(1, _UNTHREADED // right.size)
    for start in range(0, left.shape[0], rows):
        np.matmul(left[start : start + rows], right.T, out=out[start : start + rows])
    return out


def _nufft(
    coordinates: NDArray[np.float64], strengths: NDArray[np.complex128], shape: tuple[int, ...], step: float
) -> NDArray[np.complex128]:
    # Frequencies step * m of the points x are frequencies m of the points step * x.
    scaled = coordinates if step == 1.0 else coordinates * step
    out = np.empty(shape, np.complex128)
    ducc0.nufft.nu2u(
        points=strengths,
        coord=scaled,
        out=out,
        forward=True,
        epsilon=PRECISION,
        nthreads=1,
        periodicity=1.0,
        fft_order=False,
    )
    return out
