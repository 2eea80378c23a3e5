"""exp(-2 pi i m x) by itself: tables for matrix products, and plain sums at any frequency.

The phase is reduced before it is multiplied by 2 pi: m x is taken exactly, as the sum of two float64 numbers, so that
its fraction keeps all its digits up to m = 2^40.
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
    """Return frequency * x less its nearest integer, within 2^-53."""
    product = frequency * x
    error = fma(frequency, x, -product)
    return float((product - np.round(product)) + error)


@kernel("void(float64[::1], float64[::1], complex128[:,::1])")
def exponentials(frequencies: NDArray[np.float64], x: NDArray[np.float64], out: NDArray[np.complex128]) -> None:
    """Write exp(-2 pi i frequencies[j] x[k]) into ``out`` complex128[J, K]."""
    for j in range(frequencies.size):
        for k in range(x.size):
            angle = _TAU * _turns(frequencies[j], x[k])
            out[j, k] = complex(np.cos(angle), -np.sin(angle))


@kernel("void(int64, float64, float64[::1], float64[:,::1], float64[:,::1])")
def multiples(
    first: int, step: float, x: NDArray[np.float64], real: NDArray[np.float64], imaginary: NDArray[np.float64]
) -> None:
    """Write exp(-2 pi i (first + j) step x[k]), both parts float64[J, K].

    Every sixteenth row is taken directly and those between are products, which loses 4 of 53 bits.
    """
    rows, count = real.shape
    for j in range(rows):
        for k in range(count):
            if j % 16 == 0:
                angle = _TAU * _turns((first + j) * step, x[k])
                real[j, k], imaginary[j, k] = np.cos(angle), -np.sin(angle)
    once_real, once_imaginary = np.empty(count), np.empty(count)
    if rows > 1:
        for k in range(count):
            angle = _TAU * _turns(step, x[k])
            once_real[k], once_imaginary[k] = np.cos(angle), -np.sin(angle)
    for j in range(rows):
        if j % 16 != 0:
            for k in range(count):
                a, b = real[j - 1, k], imaginary[j - 1, k]
                real[j, k] = a * once_real[k] - b * once_imaginary[k]
                imaginary[j, k] = a * once_imaginary[k] + b * once_real[k]


@kernel("void(float64[:,:,::1], complex128[:,::1])")
def both_signs(products: NDArray[np.float64], out: NDArray[np.complex128]) -> None:
    """Combine the real products of L and T(m), m >= 0, to L T(m) and L conj(T(m)) for -m.

    ``products`` float64[2, J, 2 (F + 1)]: of the real and of the imaginary part of L with the real parts of T, then
    with its imaginary parts; ``out`` complex128[J, 2 F + 1].
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
