"""The exact mean over the lens at a point of the picture, as areas in the unit disk of lens points.

Seen from the point p of the picture, a layer with the circle of confusion c is drawn in the plane of lens points scaled
by 1/c about p: circles stay circles, lines stay lines. The value is constant between these curves. So its integral is a
sum over the pieces into which the curves cut each other (Green's theorem): the step of the value across a piece, times
half the integral of x dy - y dx along it. A piece that nearer layers hide makes no step. The sum is robust: where two
curves compute their crossing at places an ulp apart, it changes by an ulp.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit._builtin.scenes.depth_of_field import CIRCLES, FRONT, INNER, RING, WALL
from samplekit.kernels import helper, kernel

Array = NDArray[np.float64]

_SHARP = 1e-12  # Smaller circles of confusion are left out: they change the mean over a pixel by less than 1e-9.
_LENS = CIRCLES.shape[0]
"""The number of the lens's own outline, after those of the circles."""
_LINES = int(WALL[2]) + 1


@helper
def _wall_value(column: float, row: float) -> float:
    if column < 0.0 or row < 0.0 or column >= WALL[2] or row >= WALL[2]:
        return float(WALL[5])
    half = 0.5 * (column + row)
    return float(WALL[3] if half == np.floor(half) else WALL[4])


@helper
def _disk_in_front(u: float, v: float, x: float, y: float, confusion: Array) -> int:
    """Return the number of the disk that the lens point (u, v) sees at (x, y), -1 if it sees none."""
    for k in range(INNER):
        dx, dy = x + confusion[0] * u - FRONT[k, 0], y + confusion[0] * v - FRONT[k, 1]
        if dx * dx + dy * dy < FRONT[k, 2] * FRONT[k, 2]:
            return k
    return -1


@helper
def _is_on_ring(u: float, v: float, x: float, y: float, confusion: Array) -> bool:
    """Return whether the lens point (u, v) would see the ring at (x, y) if there were no disks."""
    dx, dy = x + confusion[1] * u - RING[0], y + confusion[1] * v - RING[1]
    return bool(RING[2] * RING[2] <= dx * dx + dy * dy < RING[3] * RING[3])


@kernel("float64(float64, float64, float64, float64, float64[::1], int64)")
def _seen(u: float, v: float, x: float, y: float, confusion: Array, nearest: int) -> float:
    """Return the value seen through a lens point without the first ``nearest`` of the layers disks, ring and wall."""
    if nearest == 0:
        disk = _disk_in_front(u, v, x, y, confusion)
        if disk >= 0:
            return float(FRONT[disk, 3])
    if nearest <= 1 and _is_on_ring(u, v, x, y, confusion):
        return float(RING[4])
    column = np.floor((x + confusion[2] * u - WALL[0]) / WALL[1])
    row = np.floor((y + confusion[2] * v - WALL[0]) / WALL[1])
    return _wall_value(column, row)


@helper
def _crosses_lens(x: float, y: float, radius: float, confusion: float) -> bool:
    """Return whether a circle about the origin is seen through a part of the lens from (x, y)."""
    distance, reach = math.sqrt(x * x + y * y), abs(confusion)
    return reach > _SHARP and abs(distance - radius) < reach


@helper
def _sort(numbers: Array, count: int) -> None:
    for i in range(1, count):
        number = numbers[i]
        j = i - 1
        while j >= 0 and numbers[j] > number:
            numbers[j + 1] = numbers[j]
            j -= 1
        numbers[j + 1] = number


@kernel("int64(float64[:,::1], int64, int64, float64[:,::1], int64[::1], float64[::1])")
def _crossings(
    circles: Array, circle: int, count: int, lines: Array, line_counts: NDArray[np.int64], out: Array
) -> int:
    """Write the angles at which a circle is crossed by the other circles and the lines, sorted; return their number."""
    ax, ay, rho = circles[circle, 0], circles[circle, 1], circles[circle, 2]
    found = 0
    for other in range(count):
        dx, dy, sigma = circles[other, 0] - ax, circles[other, 1] - ay, circles[other, 2]
        distance = math.sqrt(dx * dx + dy * dy)
        # Heron's formula in factors: the height of the triangle of both centres and a crossing.
        product = (distance + rho + sigma) * (distance + rho - sigma)
        product *= (distance - rho + sigma) * (rho + sigma - distance)
        if other == circle or distance == 0.0 or product <= 0.0:
            continue
        half = math.atan2(math.sqrt(product), distance * distance + (rho - sigma) * (rho + sigma))
        towards = math.atan2(dy, dx)
        out[found], out[found + 1] = towards - half, towards + half
        found += 2
    for axis in range(2):
        for k in range(line_counts[axis]):
            offset = lines[axis, k] - (ax if axis == 0 else ay)
            if abs(offset) >= rho:
                continue
            half = math.atan2(math.sqrt((rho - offset) * (rho + offset)), offset)
            towards = 0.0 if axis == 0 else 0.5 * math.pi
            out[found], out[found + 1] = towards - half, towards + half
            found += 2
    for i in range(found):
        out[i] -= 2.0 * math.pi * np.floor(out[i] / (2.0 * math.pi))
    _sort(out, found)
    return found


@helper
def _arc_area(rho: float, angle: float) -> float:
    """Return the area between an arc and its chord: rho^2 (angle - sin angle) / 2."""
    if angle > 0.3:
        return 0.5 * rho * rho * (angle - math.sin(angle))
    z = angle * angle
    series = 1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0)))
    return (rho * angle) * (rho * angle) * angle / 12.0 * series


@kernel("float64(float64, float64, float64[::1], float64[:,::1], float64[:,::1], int64[::1], float64[::1])")
def _mean(
    x: float, y: float, confusion: Array, circles: Array, lines: Array, line_counts: NDArray[np.int64], cuts: Array
) -> float:
    """Return the mean over the lens at (x, y); the arrays after ``confusion`` are workspace."""
    count = 0
    for k in range(CIRCLES.shape[0]):
        cx, cy, radius, c = CIRCLES[k, 0] - x, CIRCLES[k, 1] - y, CIRCLES[k, 2], confusion[0 if k < INNER else 1]
        if _crosses_lens(cx, cy, radius, c):
            circles[count, 0], circles[count, 1] = cx / c, cy / c
            circles[count, 2], circles[count, 3] = radius / abs(c), k
            count += 1
    c = confusion[2]
    for axis in range(2):
        line_counts[axis] = 0
        place = x if axis == 0 else y
        for j in range(_LINES):
            offset = WALL[0] + j * WALL[1] - place
            if abs(offset) < abs(c) and abs(c) > _SHARP:
                lines[axis, line_counts[axis]] = offset / c
                lines[axis + 2, line_counts[axis]] = j
                line_counts[axis] += 1
    if count + line_counts[0] + line_counts[1] == 0:
        return _seen(0.0, 0.0, x, y, confusion, 0)
    circles[count, 0], circles[count, 1], circles[count, 2], circles[count, 3] = 0.0, 0.0, 1.0, _LENS
    count += 1
    total = 0.0
    for circle in range(count):
        ax, ay, rho, kind = circles[circle, 0], circles[circle, 1], circles[circle, 2], circles[circle, 3]
        found = _crossings(circles, circle, count, lines, line_counts, cuts)
        if found == 0:
            cuts[0], found = 0.0, 1
        for i in range(found):
            start, end = cuts[i], cuts[i + 1] if i + 1 < found else cuts[0] + 2.0 * math.pi
            middle = 0.5 * (start + end)
            u, v = ax + rho * math.cos(middle), ay + rho * math.sin(middle)
            if end <= start or (kind != _LENS and u * u + v * v > 1.0):
                continue
            if kind == _LENS:
                step = _seen(u, v, x, y, confusion, 0)
            elif kind < INNER:
                step = FRONT[int(kind), 3] - _seen(u, v, x, y, confusion, 1)
            elif _disk_in_front(u, v, x, y, confusion) >= 0:
                continue
            else:
                step = RING[4] - _seen(u, v, x, y, confusion, 2)
                if kind == INNER:
                    step = -step
            u0, v0 = ax + rho * math.cos(start), ay + rho * math.sin(start)
            u1, v1 = ax + rho * math.cos(end), ay + rho * math.sin(end)
            total += step * (0.5 * (u0 * v1 - u1 * v0) + _arc_area(rho, end - start))
    for axis in range(2):
        for k in range(line_counts[axis]):
            place, j = lines[axis, k], lines[axis + 2, k]
            found = 0
            for circle in range(count):
                offset = place - circles[circle, axis]
                rho = circles[circle, 2]
                if abs(offset) < rho:
                    half = math.sqrt((rho - offset) * (rho + offset))
                    cuts[found], cuts[found + 1] = circles[circle, 1 - axis] - half, circles[circle, 1 - axis] + half
                    found += 2
            for other in range(line_counts[1 - axis]):
                cuts[found] = lines[1 - axis, other]
                found += 1
            _sort(cuts, found)
            for i in range(found - 1):
                along = 0.5 * (cuts[i] + cuts[i + 1])
                u, v = (place, along) if axis == 0 else (along, place)
                if u * u + v * v > 1.0 or _disk_in_front(u, v, x, y, confusion) >= 0:
                    continue
                if _is_on_ring(u, v, x, y, confusion):
                    continue
                across = np.floor(((y if axis == 0 else x) + c * along - WALL[0]) / WALL[1])
                # At the line the cell j - 1 ends and the cell j begins; a negative c turns the picture around.
                before = _wall_value(j - 1.0, across)
                step = before - _wall_value(j, across)
                total += (step if c > 0.0 else -step) * 0.5 * place * (cuts[i + 1] - cuts[i])
    return total / math.pi


@kernel("void(float64[:,::1], float64[::1], float64[::1])")
def lens_means(points: Array, confusion: Array, out: Array) -> None:
    """Write the mean over the lens at each of the points float64[2, M] of the picture, within 1e-12."""
    circles, lines = np.empty((_LENS + 1, 4)), np.empty((4, _LINES))
    line_counts, cuts = np.zeros(2, np.int64), np.empty(2 * (_LENS + 1) + 4 * _LINES)
    for i in range(out.size):
        out[i] = _mean(points[0, i], points[1, i], confusion, circles, lines, line_counts, cuts)
