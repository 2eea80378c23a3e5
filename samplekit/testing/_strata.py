"""Strata: one point in each of N intervals (Latin), in each cell of a grid, in each of pairs (orthogonal arrays)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._specs import Strata
from samplekit.testing._elsewhere import forced_extremes
from samplekit.testing._judge import judge
from samplekit.testing._result import NotApplicable, check

if TYPE_CHECKING:
    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

COUNTS = (1, 2, 3, 4, 5, 6, 7, 9, 12, 16, 25, 49, 64, 96, 97, 100, 121, 256, 1000, 1024, 2025, 4096)
_QUICK_COUNTS = (1, 2, 3, 4, 7, 12, 25, 64, 97, 1000)
_SEEDS = (0, 1)


def _promises_strata(spec: SamplerSpec) -> str:
    return "" if spec.promised(Strata) else "it promises no strata"


@check("strata", 8, requires=_promises_strata)
def check_strata(subject: Subject) -> None:
    """Every promised interval and cell holds exactly one point, in every set."""
    spec = subject.spec
    judged = False
    for promise in spec.promised(Strata):
        for dims in sorted({subject.dims(d) for d in (1, 2, 3, 5)}):
            counts = subject.counts(*(_QUICK_COUNTS if subject.quick else COUNTS), dims=dims)
            for count in counts:
                if next(promise.cells(count, dims), None) is None:
                    continue
                judged = True
                wanted = 1 if not spec.randomized else 64 if count <= 100 else 4
                realizations = wanted if wanted == 1 else subject.affordable(wanted, count, dims, least=4)
                for seed in _SEEDS if spec.randomized else (0,):
                    judge(subject, promise, subject.sets(count, dims, realizations, seed=seed), count, seed=seed)
    if not judged:
        raise NotApplicable("no count that it makes has the promised strata")
    if not subject.quick:
        for extreme in forced_extremes(subject):
            for promise in spec.promised(Strata):
                when = f" with random bits all {extreme.pattern}"
                judge(subject, promise, extreme.values, extreme.count, when=when)
