"""Swaps: pairs of sites exchange background points until no exchange brings points nearer to their sites.

Balzer, Schlömer, Deussen 2009, section 4: the points of two sites s and t are ordered by how much farther they are from
s than from t, and the nearer half goes to s; then every site moves to the centroid of its points. As in the paper,
pairs that cannot gain are left out: those in which neither site changed since their last turn, and those farther apart
than the sum of their radii, the distances to their farthest points.
"""

import math

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import helper, kernel
from samplekit_bluenoise.territories import select
from samplekit_bluenoise.torus import sort_into_cells, wrapped

Array = NDArray[np.float64]

_TOLERANCE = 1e-12
"""Smallest gain of a swap, in units of 1 / N: without it rounding could swap the same points for ever."""


@helper
def _move_to_centroid(s: int, sites: Array, points: Array) -> None:
    capacity = points.shape[1] // sites.shape[1]
    for d in range(2):
        x = sites[d, s]
        total = 0.0
        for k in range(s * capacity, (s + 1) * capacity):
            total += wrapped(points[d, k] - x)
        x += total / capacity
        sites[d, s] = x - np.floor(x)


@helper
def _radius(s: int, sites: Array, points: Array) -> float:
    """Return the distance of the farthest point of site s."""
    capacity = points.shape[1] // sites.shape[1]
    farthest = 0.0
    for k in range(s * capacity, (s + 1) * capacity):
        dx = wrapped(points[0, k] - sites[0, s])
        dy = wrapped(points[1, k] - sites[1, s])
        farthest = max(farthest, dx * dx + dy * dy)
    return math.sqrt(farthest)


@helper
def _swap(s: int, t: int, sites: Array, points: Array, values: Array, room: Array, place: NDArray[np.int64]) -> bool:
    """Give each point of two sites to the site where it belongs; return whether any changed hands.

    ``values`` float64[2, 2 capacity], ``room`` float64[2, 2 capacity] and ``place`` int64[2 capacity] are workspace.
    """
    capacity = points.shape[1] // sites.shape[1]
    # How much farther each point is from s than from t: first the points of s, then those of t.
    for half in range(2):
        first = (t if half else s) * capacity
        for k in range(capacity):
            x = points[0, first + k]
            y = points[1, first + k]
            from_s = wrapped(x - sites[0, s]) ** 2 + wrapped(y - sites[1, s]) ** 2
            from_t = wrapped(x - sites[0, t]) ** 2 + wrapped(y - sites[1, t]) ** 2
            values[0, half * capacity + k] = from_s - from_t
    most = values[0, 0]
    least = values[0, capacity]
    for k in range(1, capacity):
        most = max(most, values[0, k])
        least = min(least, values[0, capacity + k])
    if most - least <= _TOLERANCE / sites.shape[1]:
        return False
    # Only points beyond the other site's extreme can change hands. They are few: take them out, order, put them back.
    count = 0
    of_s = 0
    for half in range(2):
        of_s = count
        first = (t if half else s) * capacity
        for k in range(capacity):
            value = values[0, half * capacity + k]
            if value < most if half else value > least:
                values[1, count] = value
                place[count] = first + k
                room[0, count] = points[0, first + k]
                room[1, count] = points[1, first + k]
                count += 1
    select(values[1], room, 0, count, of_s)
    for k in range(count):
        points[0, place[k]] = room[0, k]
        points[1, place[k]] = room[1, k]
    return True


@kernel("int64(float64[:,::1], float64[:,::1], int64)")
def settle(sites: Array, points: Array, sweeps: int) -> int:
    """Swap points and move sites, in place, until a sweep over all pairs swaps nothing.

    Parameters
    ----------
    sites
        float64[2, N].
    points
        float64[2, N * capacity]: those of site s begin at s * capacity.
    sweeps
        Largest number of sweeps.

    Returns
    -------
    The number of sweeps.
    """
    count = sites.shape[1]
    capacity = points.shape[1] // count
    values = np.empty((2, 2 * capacity))
    room = np.empty((2, 2 * capacity))
    place = np.empty(2 * capacity, np.int64)
    radius = np.empty(count)
    changed = np.empty(count, np.bool_)
    before = np.empty(count, np.bool_)
    before[:] = True
    for s in range(count):
        _move_to_centroid(s, sites, points)
        radius[s] = _radius(s, sites, points)
    for sweep in range(sweeps):
        head, following = sort_into_cells(sites)
        side = head.shape[0]
        widest = 0.0
        for s in range(count):
            changed[s] = False
            widest = max(widest, radius[s])
        for s in range(count):
            reach = int(np.ceil((radius[s] + widest) * side))
            span = min(2 * reach + 1, side)
            column = int(sites[0, s] * side) - reach
            row = int(sites[1, s] * side) - reach
            for v in range(span):
                j = (row + v) % side
                for u in range(span):
                    i = (column + u) % side
                    t = head[j, i]
                    while t >= 0:
                        if t > s and (before[s] or before[t] or changed[s] or changed[t]):
                            dx = wrapped(sites[0, s] - sites[0, t])
                            dy = wrapped(sites[1, s] - sites[1, t])
                            near = dx * dx + dy * dy < (radius[s] + radius[t]) ** 2
                            if near and _swap(s, t, sites, points, values, room, place):
                                changed[s] = changed[t] = True
                                radius[s] = _radius(s, sites, points)
                                radius[t] = _radius(t, sites, points)
                        t = following[t]
        swapped = False
        for s in range(count):
            if changed[s]:
                swapped = True
                _move_to_centroid(s, sites, points)
                radius[s] = _radius(s, sites, points)
            before[s] = changed[s]
        if not swapped:
            return sweep
    return sweeps
