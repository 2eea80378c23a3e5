"""Minimum distance: no two points of a set are closer on the torus than the promised part of the densest packing's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._specs import MinimumDistance
from samplekit.testing._judge import judge
from samplekit.testing._result import NotApplicable, check

if TYPE_CHECKING:
    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject


def _promises_distance(spec: SamplerSpec) -> str:
    return "" if spec.promised(MinimumDistance) else "it promises no minimum distance"


@check("minimum-distance", 9, tolerance="2^-51, the rounding of the coordinates", requires=_promises_distance)
def check_minimum_distance(subject: Subject) -> None:
    """No two points are closer than the promised part of the densest packing's distance, on the torus."""
    judged = False
    for promise in subject.spec.promised(MinimumDistance):
        for dims in sorted({subject.dims(d) for d in (1, 2, 3)}):
            for count in subject.counts(2, 3, 16, 64, 97, 100, 256, *(() if subject.quick else (1024,)), dims=dims):
                if promise.distance(count, dims) is None:
                    continue
                judged = True
                realizations = subject.affordable(16 if count <= 256 else 2, count, dims, least=1)
                judge(subject, promise, subject.sets(count, dims, realizations), count)
    if not judged:
        raise NotApplicable("the densest packing is known in 1 to 5 dimensions, of 2 points and more")
