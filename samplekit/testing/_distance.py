"""Minimum distance: no two points of a set are closer on the torus than the promised part of the densest packing's."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._specs import MinimumDistance
from samplekit.testing._result import CheckFailed, NotApplicable, check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

_ROUNDING = 2.0**-51
"""Coordinates are rounded to 2^-53, and moved and wrapped with another rounding: a distance is known to this."""


def _promises_distance(spec: SamplerSpec) -> str:
    distances = any(isinstance(promise, MinimumDistance) for promise in spec.promises)
    return "" if distances else "it promises no minimum distance"


def densest_distance(count: int, dims: int) -> float | None:
    """The least distance of ``count`` points packed most densely on the unit torus; None where it is not known.

    Densest lattices, of centre density delta: (d / 2)^D N / delta = 1. Conway and Sloane 1999, "Sphere packings,
    lattices and groups", table 1.2.
    """
    density = {1: 1 / 2, 2: 1 / (2 * math.sqrt(3)), 3: 1 / (4 * math.sqrt(2)), 4: 1 / 8, 5: 1 / (8 * math.sqrt(2))}
    if dims not in density:
        return None
    return 2.0 * float((density[dims] / count) ** (1 / dims))


def closest_pair(points: NDArray[np.float64]) -> tuple[float, int, int]:
    """The least toroidal distance of ``points`` float64[D, N], N >= 2, and the pair that has it: all pairs, in rows."""
    least, pair = math.inf, (0, 1)
    count = points.shape[1]
    for i in range(count - 1):
        apart = np.abs(points[:, i + 1 :] - points[:, i : i + 1])
        apart = np.minimum(apart, 1.0 - apart)
        squared = (apart * apart).sum(axis=0)
        j = int(squared.argmin())
        if squared[j] < least:
            least, pair = float(squared[j]), (i, i + 1 + j)
    return math.sqrt(least), *pair


@check("minimum-distance", 9, tolerance="2^-51, the rounding of the coordinates", requires=_promises_distance)
def check_minimum_distance(subject: Subject) -> None:
    """No two points are closer than the promised part of the densest packing's distance, on the torus."""
    judged = 0
    for promise in subject.spec.promises:
        if not isinstance(promise, MinimumDistance):
            continue
        for dims in sorted({subject.dims(d) for d in (1, 2, 3)}):
            for count in subject.counts(2, 3, 16, 64, 97, 100, 256, *(() if subject.quick else (1024,)), dims=dims):
                densest = densest_distance(count, dims)
                if count < 2 or densest is None:
                    continue
                judged += 1
                realizations = subject.affordable(16 if count <= 256 else 2, count, dims, least=1)
                _judge(subject, subject.sets(count, dims, realizations), count, promise.fraction * densest)
    if not judged:
        raise NotApplicable("the densest packing is known in 1 to 5 dimensions, of 2 points and more")


def _judge(subject: Subject, values: NDArray[np.float64], count: int, promised: float) -> None:
    for row in range(len(values)):
        distance, i, j = closest_pair(values[row])
        if distance < promised - _ROUNDING:
            raise CheckFailed(
                f"two points are {distance:.6g} apart, expected at least {promised:.6g}",
                subject.example(values, count, row=row, indices=(i, j)),
            )
