"""Voronoi cells on the torus, and the step of Lloyd's relaxation: every point moves to the centroid of its cell.

A Voronoi cell starts as the unit square around its point. It is cut along the bisectors with the points nearby, ring
after ring of the cells of a grid, until the next ring is farther than twice the Voronoi cell's radius. The images of
points in neighbouring copies of the torus count as points, so that any number of points has proper cells; the cell of a
single point is the unit square.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import helper, kernel
from samplekit_bluenoise.torus import on_torus, sort_into_cells

Array = NDArray[np.float64]

_MOST_CORNERS = 1024
"""Room for the corners of a cell; among random points more than 20 hardly ever occur."""


@helper
def _cut(corners: Array, kept: Array, size: int, x: float, y: float) -> tuple[int, float]:
    """Cut a convex polygon around the origin along the bisector with (x, y).

    The polygon is the first ``size`` of ``corners`` float64[K, 2]; ``kept`` is workspace (Sutherland, Hodgman 1974).
    Return its new number of corners, and the square of the distance of the farthest.
    """
    half = 0.5 * (x * x + y * y)
    count = 0
    last = size - 1
    before = corners[last, 0] * x + corners[last, 1] * y - half
    for k in range(size):
        beyond = corners[k, 0] * x + corners[k, 1] * y - half
        if (beyond > 0.0) != (before > 0.0):
            t = before / (before - beyond)
            kept[count, 0] = corners[last, 0] + t * (corners[k, 0] - corners[last, 0])
            kept[count, 1] = corners[last, 1] + t * (corners[k, 1] - corners[last, 1])
            count += 1
        if beyond <= 0.0:
            kept[count, 0] = corners[k, 0]
            kept[count, 1] = corners[k, 1]
            count += 1
        last = k
        before = beyond
    farthest = 0.0
    for k in range(count):
        corners[k, 0] = kept[k, 0]
        corners[k, 1] = kept[k, 1]
        farthest = max(farthest, corners[k, 0] ** 2 + corners[k, 1] ** 2)
    return count, farthest


@helper
def _voronoi_cell(
    p: int, points: Array, head: NDArray[np.int64], following: NDArray[np.int64], corners: Array, kept: Array
) -> int:
    """Write the corners of the cell of point ``p``, relative to the point; return their number."""
    for k in range(4):
        corners[k, 0] = 0.5 if k == 0 or k == 3 else -0.5
        corners[k, 1] = 0.5 if k < 2 else -0.5
    side = head.shape[0]
    size = 4
    square = 0.5
    x = points[0, p]
    y = points[1, p]
    column = int(x * side)
    row = int(y * side)
    u = x * side - column
    v = y * side - row
    margin = min(min(u, 1.0 - u), min(v, 1.0 - v))
    ring = 0
    while ring < 2 or (ring - 1 + margin) ** 2 < 4.0 * square * side * side:
        for dj in range(-ring, ring + 1):
            j = (row + dj) % side
            shift_y = (row + dj - j) // side - y
            step = 1 if dj in (-ring, ring) else 2 * ring
            for di in range(-ring, ring + 1, step):
                i = (column + di) % side
                shift_x = (column + di - i) // side - x
                q = head[j, i]
                while q >= 0:
                    dx = points[0, q] + shift_x
                    dy = points[1, q] + shift_y
                    distance = dx * dx + dy * dy
                    if 0.0 < distance < 4.0 * square:
                        size, square = _cut(corners, kept, size, dx, dy)
                    q = following[q]
        ring += 1
    return size


@kernel("void(float64[:,:,::1], int64)")
def relax(sets: Array, steps: int) -> None:
    """Relax the sets float64[R, 2, N] in place, ``steps`` times."""
    realizations, _, count = sets.shape
    moved = np.empty((2, count))
    corners = np.empty((_MOST_CORNERS, 2))
    kept = np.empty((_MOST_CORNERS, 2))
    for r in range(realizations):
        points = sets[r]
        for _ in range(steps):
            head, following = sort_into_cells(points)
            for p in range(count):
                size = _voronoi_cell(p, points, head, following, corners, kept)
                # Twice the area and six times the first moments, of triangles from the point to each edge.
                area = 0.0
                moment_x = 0.0
                moment_y = 0.0
                last = size - 1
                for k in range(size):
                    cross = corners[last, 0] * corners[k, 1] - corners[k, 0] * corners[last, 1]
                    area += cross
                    moment_x += cross * (corners[last, 0] + corners[k, 0])
                    moment_y += cross * (corners[last, 1] + corners[k, 1])
                    last = k
                moved[0, p] = on_torus(points[0, p] + moment_x / (3.0 * area))
                moved[1, p] = on_torus(points[1, p] + moment_y / (3.0 * area))
            # A loop: numba takes seconds to compile the assignment of an array.
            for p in range(count):
                points[0, p] = moved[0, p]
                points[1, p] = moved[1, p]
