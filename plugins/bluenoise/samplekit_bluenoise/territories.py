"""Territories: the first assignment of background points to sites, equally many to each.

The torus is cut open along two wavy lines, then cut in two by a straight line in a random direction, with half of the
sites on either side; each half is cut again in the same way. Straight cuts leave traces, since sites settle in rows
along them: division along the axes ended on a square lattice, and a torus cut open along the sides of the square gave
the two axes of the spectrum a third more power than the rest of its ring.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import hash_index, helper, kernel, second_key, unit

Array = NDArray[np.float64]

_U64 = np.uint64
_DEEPEST = 64


@helper
def select(values: Array, points: Array, low: int, high: int, place: int) -> None:
    """Reorder ``values`` and ``points`` from ``low`` to ``high`` - 1, the smallest before ``place`` (Hoare 1961)."""
    while high - low > 1:
        pivot = values[(low + high) // 2]
        i = low
        j = high - 1
        while i <= j:
            while values[i] < pivot:
                i += 1
            while values[j] > pivot:
                j -= 1
            if i <= j:
                values[i], values[j] = values[j], values[i]
                points[0, i], points[0, j] = points[0, j], points[0, i]
                points[1, i], points[1, j] = points[1, j], points[1, i]
                i += 1
                j -= 1
        if place <= j:
            high = j + 1
        elif place >= i:
            low = i
        else:
            return


@helper
def _wave(t: float) -> float:
    """Return nearly a sine of period 1, made of parabolas, since the sine may differ between machines."""
    t -= np.floor(t)
    return 16.0 * t * (0.5 - t) if t < 0.5 else 16.0 * (t - 0.5) * (t - 1.0)


@kernel("void(float64[:,::1], uint64)")
def cut_open(points: Array, key: np.uint64) -> None:
    """Cut the torus open along two wavy lines: points beyond a line move by 1, to the other side of the square."""
    second = second_key(key)
    phase = np.empty(4)
    for k in range(4):
        phase[k] = unit(hash_index(key, second, _U64(k)))
    for k in range(points.shape[1]):
        x = points[0, k]
        y = points[1, k]
        points[0, k] = x - np.floor(x + 0.16 * _wave(y + phase[0]) + 0.08 * _wave(2.0 * y + phase[1]))
        points[1, k] = y - np.floor(y + 0.16 * _wave(x + phase[2]) + 0.08 * _wave(2.0 * x + phase[3]))


@kernel("void(float64[:,::1], int64, uint64)")
def divide(points: Array, sites: int, key: np.uint64) -> None:
    """Reorder the background points float64[2, sites * capacity]: those of site s begin at s * capacity."""
    capacity = points.shape[1] // sites
    values = np.empty(points.shape[1])
    # Parts of the square that wait to be cut: their first site and number of sites.
    firsts = np.empty(_DEEPEST, np.int64)
    sizes = np.empty(_DEEPEST, np.int64)
    firsts[0] = 0
    sizes[0] = sites
    waiting = 1
    second = second_key(key)
    drawn = 0
    while waiting > 0:
        waiting -= 1
        first = firsts[waiting]
        size = sizes[waiting]
        if size == 1:
            continue
        bits = hash_index(key, second, _U64(drawn))
        drawn += 1
        angle = unit(bits)
        a = _wave(angle + 0.25)
        b = _wave(angle)
        low = first * capacity
        high = (first + size) * capacity
        for k in range(low, high):
            values[k] = a * points[0, k] + b * points[1, k]
        # If the number is odd, a random side gets one more.
        half = (size + np.int64(bits & _U64(1))) // 2
        select(values, points, low, high, low + half * capacity)
        firsts[waiting] = first
        sizes[waiting] = half
        firsts[waiting + 1] = first + half
        sizes[waiting + 1] = size - half
        waiting += 2
