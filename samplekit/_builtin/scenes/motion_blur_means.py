"""The mean over lens and time at a point of the motion-blur scene.

Seen from the point, the lens is a disk about it, and a moving disk covers the intersection of two circles: its area is
a function a(d) of the distance d of their centres. Over time one centre moves along a straight line. The mean of a is
an integral between the places where the circles begin to touch and to contain each other; without a lens it is the
length of a chord.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit._builtin.scenes.motion_blur import BOARD, DIRECTION, DISKS
from samplekit.kernels import helper, kernel

Array = NDArray[np.float64]

# 12 nodes are within 1e-7 here; the 24 of samplekit.quadrature take twice as long.
_NODES, _WEIGHTS = (np.ascontiguousarray(part) for part in np.polynomial.legendre.leggauss(12))
_SHARP = 1e-12  # Smaller lenses and shorter ways count as none: they change the mean over a pixel by less than 1e-9.


@helper
def _segment(radius: float, half: float) -> float:
    """Return the area of a circular segment, from half its angle: r^2 (half - sin half cos half)."""
    if half > 0.15:
        return radius * radius * (half - math.sin(half) * math.cos(half))
    z = 4.0 * half * half
    series = 1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0)))
    return (radius * half) * (radius * half) * half * (2.0 / 3.0) * series


@kernel("float64(float64, float64, float64)")
def _covered(distance: float, radius: float, reach: float) -> float:
    """Return the share of a disk of the radius ``reach`` that another disk covers."""
    if distance >= radius + reach:
        return 0.0
    if distance <= abs(radius - reach):
        return min(1.0, (radius / reach) * (radius / reach))
    product = (distance + radius + reach) * (distance + radius - reach)
    product *= (distance - radius + reach) * (radius + reach - distance)
    height = math.sqrt(max(0.0, product))
    difference = (radius - reach) * (radius + reach)
    area = _segment(radius, math.atan2(height, distance * distance + difference))
    area += _segment(reach, math.atan2(height, distance * distance - difference))
    return area / (math.pi * reach * reach)


@kernel("float64(float64, float64, float64, float64, float64)")
def _ring_part(low: float, high: float, across: float, radius: float, reach: float) -> float:
    """Integrate the covered share between two places; nodes crowd at the ends, where it grows like x^1.5."""
    if high <= low:
        return 0.0
    total = 0.0
    for node in range(_NODES.size):
        s = 0.5 + 0.5 * _NODES[node]
        place = low + (high - low) * (s * s * (3.0 - 2.0 * s))
        weight = 0.5 * _WEIGHTS[node] * 6.0 * s * (1.0 - s)
        total += weight * _covered(math.sqrt(across * across + place * place), radius, reach)
    return total * (high - low)


@kernel("float64(float64, float64, float64, float64, float64)")
def _shown(along: float, across: float, radius: float, reach: float, way: float) -> float:
    """Return the share of lens and time in which a disk is seen, from a point in the frame of the disk's motion."""
    if way <= _SHARP:
        distance = math.sqrt(along * along + across * across)
        if reach <= _SHARP:
            return 1.0 if distance < radius else 0.0
        return _covered(distance, radius, reach)
    start, end = along - 0.5 * way, along + 0.5 * way
    across = abs(across)
    if reach <= _SHARP:
        if across >= radius:
            return 0.0
        half = math.sqrt((radius - across) * (radius + across))
        return max(0.0, min(end, half) - max(start, -half)) / way
    if across >= radius + reach:
        return 0.0
    outer = math.sqrt((radius + reach - across) * (radius + reach + across))
    core = abs(radius - reach)
    inner = math.sqrt((core - across) * (core + across)) if across < core else 0.0
    total = max(0.0, min(end, inner) - max(start, -inner)) * min(1.0, (radius / reach) * (radius / reach))
    total += _ring_part(max(start, inner), min(end, outer), across, radius, reach)
    total += _ring_part(max(start, -outer), min(end, -inner), across, radius, reach)
    return total / way


@kernel("void(float64[:,::1], float64, float64, float64[::1])")
def lens_and_time_means(points: Array, reach: float, shutter: float, out: Array) -> None:
    """Write the mean over lens and time at each of the points float64[2, M] of the picture."""
    for i in range(out.size):
        x, y = points[0, i], points[1, i]
        half = 0.5 * (np.floor((x - BOARD[0]) / BOARD[1]) + np.floor((y - BOARD[0]) / BOARD[1]))
        below = BOARD[2] if half == np.floor(half) else BOARD[3]
        # The disks never hide each other: their shares of lens and time add up.
        value = below
        for k in range(DISKS.shape[0]):
            dx, dy = x - DISKS[k, 0], y - DISKS[k, 1]
            along, across = dx * DIRECTION[0] + dy * DIRECTION[1], dy * DIRECTION[0] - dx * DIRECTION[1]
            share = _shown(along, across, DISKS[k, 2], reach, shutter * abs(DISKS[k, 4]))
            value += share * (DISKS[k, 3] - below)
        out[i] = value
