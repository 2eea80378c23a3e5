"""Sample elimination: remove the most crowded of many random points until N well-spread points are left.

Yuksel 2015, "Sample elimination for generating Poisson disk sample sets". Of M = 5 N random points the one with the
largest weight is removed until N are left. Two points at distance d add (1 - d' / 2 r_max)^8 to each other's weight,
d' = max(d, 2 r_min). 2 r_max is the distance of the densest packing of N points, r_min is 0.65 r_max (1 - (N/M)^1.5):
pairs closer than 2 r_min all count as equally bad.

The points are then put in the paper's progressive order. Elimination goes on to the next lower power of two, with
weights for that number of points, and from there again and again to half as many. Points come in the reverse order of
their removal, so that every prefix is well spread, best at powers of two. The points of a smaller set are not those of
a larger one.

No distance is promised: it is about 0.7 of the densest packing's, but a close pair with room around it may survive, in
about one of a thousand sets of 16 points.
"""

import math

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import dimension_key, hash_index, helper, kernel, second_key, unit
from samplekit_bluenoise.torus import wrapped

Array = NDArray[np.float64]

_U64 = np.uint64
CANDIDATES = 5
"""M / N: the paper's choice."""
_PACKING = 2.0 / math.sqrt(3.0)
"""N times the square of the distance of N points in the densest packing, (2 r_max)^2 N."""
_BETA = 0.65


@helper
def _weight(square: float, span: float, least: float) -> float:
    """Return the weight that a pair gives to both points; ``span`` is 2 r_max, ``least`` is 2 r_min."""
    w = 1.0 - max(math.sqrt(square), least) / span
    w *= w
    w *= w
    return w * w


@helper
def _sift(heap: NDArray[np.int64], place: NDArray[np.int64], weights: Array, size: int, at: int) -> None:
    """Restore a binary heap, heaviest point first, after the weight of the point at ``at`` has fallen."""
    point = heap[at]
    weight = weights[point]
    child = 2 * at + 1
    while child < size:
        if child + 1 < size and weights[heap[child + 1]] > weights[heap[child]]:
            child += 1
        if weights[heap[child]] <= weight:
            break
        heap[at] = heap[child]
        place[heap[at]] = at
        at = child
        child = 2 * at + 1
    heap[at] = point
    place[point] = at


@helper
def _eliminate(
    points: Array,
    heap: NDArray[np.int64],
    size: int,
    target: int,
    place: NDArray[np.int64],
    weights: Array,
    head: NDArray[np.int64],
    following: NDArray[np.int64],
) -> None:
    """Reduce the first ``size`` points of ``heap`` to ``target``; the removed points follow, the last removed first."""
    span = math.sqrt(_PACKING / target)
    ratio = target / size
    least = span * (1.0 - ratio * math.sqrt(ratio)) * _BETA
    side = int(1.0 / span)
    side = side if side >= 3 else 1
    steps = min(side, 3)
    head[: side * side] = -1
    for k in range(size):
        p = heap[k]
        cell = int(points[p, 1] * side) * side + int(points[p, 0] * side)
        following[p] = head[cell]
        head[cell] = p
        place[p] = k
        weights[p] = 0.0
    # First every point collects its weight; then the heaviest are removed, and their neighbours become lighter.
    alive = size
    begun = 0
    while alive > target:
        filling = begun < size
        p = heap[begun] if filling else heap[0]
        if filling:
            begun += 1
        else:
            alive -= 1
            heap[0] = heap[alive]
            place[heap[0]] = 0
            heap[alive] = p
            place[p] = alive
            _sift(heap, place, weights, alive, 0)
        column = int(points[p, 0] * side)
        row = int(points[p, 1] * side)
        for v in range(steps):
            j = (row + v + side - 1) % side
            for u in range(steps):
                i = (column + u + side - 1) % side
                q = head[j * side + i]
                while q >= 0:
                    if q != p and place[q] < alive:
                        dx = wrapped(points[p, 0] - points[q, 0])
                        dy = wrapped(points[p, 1] - points[q, 1])
                        square = dx * dx + dy * dy
                        if square < span * span:
                            w = _weight(square, span, least)
                            if filling:
                                weights[p] += w
                            else:
                                weights[q] -= w
                                _sift(heap, place, weights, alive, place[q])
                    q = following[q]
        if filling and begun == size:
            for at in range(size // 2 - 1, -1, -1):
                _sift(heap, place, weights, size, at)


@kernel("void(float64[:,:,::1], uint64[::1])")
def eliminate(out: Array, keys: NDArray[np.uint64]) -> None:
    """Write sets of N points in progressive order: ``out`` float64[R, 2, N], ``keys`` uint64[R]."""
    realizations, _, count = out.shape
    size = CANDIDATES * count
    points = np.empty((size, 2))
    rows = np.floor(math.sqrt(count))
    heap = np.empty(size, np.int64)
    place = np.empty(size, np.int64)
    weights = np.empty(size)
    head = np.empty(count + 1, np.int64)
    following = np.empty(size, np.int64)
    for r in range(realizations):
        for d in range(2):
            key = dimension_key(keys[r], d)
            second = second_key(key)
            for i in range(size):
                points[i, d] = unit(hash_index(key, second, _U64(i)))
        # Sorted along rows, so that neighbours on the torus are near in memory too.
        points = points[np.argsort(np.floor(points[:, 1] * rows) + points[:, 0], kind="mergesort")]
        for i in range(size):
            heap[i] = i
        left = size
        target = count
        while left > 1:
            _eliminate(points, heap, left, target, place, weights, head, following)
            left = target
            target = 1
            while 2 * target < left:
                target *= 2
        for i in range(count):
            out[r, 0, i] = points[heap[i], 0]
            out[r, 1, i] = points[heap[i], 1]
