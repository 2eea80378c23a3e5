"""Kernels for exp(-2 pi i m x): tables for matrix products, and plain sums at arbitrary frequencies.

The phase is reduced before it is multiplied by 2 pi: the product m x is computed exactly, as the sum of two float64
numbers, so that its fraction keeps all its digits up to m = 2^40.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import fma, helper, kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TAU = 6.283185307179586


@helper
def _turns(frequency: float, x: float) -> float:
    """Return frequency * x minus its nearest integer, with an error of at most 2^-53."""
    product = frequency * x
    error = fma(frequency, x, -product)
    return float((product - np.round(product)) + error)


@kernel("void(int64, float64, float64[::1], float64[:,::1], float64[:,::1])")
def multiples(
    first: int, step: float, x: NDArray[np.float64], real: NDArray[np.float64], imaginary: NDArray[np.float64]
) -> None:
    """Write the real and the imaginary part of exp(-2 pi i (first + j) step x[k]), float64[J, K] each.

    Every sixteenth row is computed directly. The rows between are products, which lose 4 of 53 bits.
    """
    rows, count = real.shape
    once_real, once_imaginary = np.empty(count), np.empty(count)
    if rows > 1:
        for k in range(count):
            angle = _TAU * _turns(step, x[k])
            once_real[k], once_imaginary[k] = np.cos(angle), -np.sin(angle)
    for j in range(rows):
        for k in range(count):
            if j % 16 == 0:
                angle = _TAU * _turns((first + j) * step, x[k])
                real[j, k], imaginary[j, k] = np.cos(angle), -np.sin(angle)
            else:
                a, b = real[j - 1, k], imaginary[j - 1, k]
                real[j, k] = a * once_real[k] - b * once_imaginary[k]
                imaginary[j, k] = a * once_imaginary[k] + b * once_real[k]


@kernel("void(float64[:,:,::1], complex128[:,::1])")
def both_signs(products: NDArray[np.float64], out: NDArray[np.complex128]) -> None:
    """Combine real products of L and T(m), m >= 0, into L T(m) for m and L conj(T(m)) for -m.

    ``products`` float64[2, J, 2 (F + 1)] holds the products of the real and of the imaginary part of L, each with the
    real parts of T and then with its imaginary parts. ``out`` is complex128[J, 2 F + 1].
    """
    _, rows, columns = products.shape
    reach = columns // 2 - 1
    for j in range(rows):
        for m in range(reach + 1):
            rr, ri = products[0, j, m], products[0, j, reach + 1 + m]
            ir, ii = products[1, j, m], products[1, j, reach + 1 + m]
            out[j, reach + m] = complex(rr - ii, ir + ri)
            out[j, reach - m] = complex(rr + ii, ir - ri)


@kernel("void(float64[:,::1], float64[:,::1], complex128[::1])")
def add_sums(frequencies: NDArray[np.float64], points: NDArray[np.float64], out: NDArray[np.complex128]) -> None:
    """Add sum_k exp(-2 pi i frequencies[j] . points[:, k]) to ``out[j]``, for frequencies[J, D] and points[D, n]."""
    dims, count = points.shape
    for j in range(frequencies.shape[0]):
        real, imaginary = 0.0, 0.0
        for k in range(count):
            turns = 0.0
            for d in range(dims):
                turns += _turns(frequencies[j, d], points[d, k])
            angle = _TAU * (turns - np.round(turns))
            real += np.cos(angle)
            imaginary -= np.sin(angle)
        out[j] += complex(real, imaginary)


@kernel("void(complex128[::1], int64, complex128[:,::1])")
def separate(mixed: NDArray[np.complex128], start: int, out: NDArray[np.complex128]) -> None:
    """Write the spectra A and B of real strengths, complex128[2, n], from Z = A + i B on a whole cube.

    By Hermitian symmetry A = (Z(m) + conj Z(-m)) / 2 and B = (Z(m) - conj Z(-m)) / 2i. ``start`` is the first of the n
    entries of the cube's half.
    """
    dc = mixed.size // 2
    for i in range(out.shape[1]):
        z, mirrored = mixed[dc + start + i], mixed[dc - start - i]
        out[0, i] = complex(0.5 * (z.real + mirrored.real), 0.5 * (z.imag - mirrored.imag))
        out[1, i] = complex(0.5 * (z.imag + mirrored.imag), 0.5 * (mirrored.real - z.real))
