"""Under-declaring: properties that a sampler has and does not declare, so that nobody can rely on them. Hints only."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._specs import GridStrata, LatinStrata, Net
from samplekit.testing._declared import allows
from samplekit.testing._nets import broken_box
from samplekit.testing._result import check
from samplekit.testing._strata import broken_cell, promised_grids

if TYPE_CHECKING:
    from samplekit.testing._subject import Subject

_REALIZATIONS = 8


@check("under-declaring", 20, tolerance="hints, never a failure")
def check_under_declaring(subject: Subject) -> None:
    """Properties that hold in all sets that were looked at, and are not declared, are named in hints."""
    spec = subject.spec
    dims = subject.dims(2)
    kinds = {type(promise) for promise in spec.promises}
    if spec.progressive == "no" and _has_prefixes(subject, dims):
        subject.hint("prefixes of its sets are its sets: progressive could be declared")
    if LatinStrata not in kinds and _holds(subject, LatinStrata(), dims):
        subject.hint("every dimension has one point in each of N intervals: LatinStrata() could be promised")
    if GridStrata not in kinds and spec.counts != "any" and dims == 2 and _holds(subject, GridStrata(), dims):
        subject.hint("every cell of the grid holds one point: GridStrata() could be promised")
    if Net not in kinds and dims >= 2 and _is_net(subject):
        subject.hint("dimensions 0 and 1 are (0, m, 2)-nets in base 2: Net(dims=(0, 1)) could be promised")
    if spec.randomized and _one_set(subject, dims):
        subject.hint("all realisations have one set: randomized=False could be declared")


def _has_prefixes(subject: Subject, dims: int) -> bool:
    counts = subject.counts(1, 2, 4, 16, 64, 256, dims=dims)
    if len(counts) < 3:
        return False
    whole = subject.sets(counts[-1], dims, 2)
    return all((subject.sets(count, dims, 2) == whole[:, :, :count]).all() for count in counts[:-1])


def _holds(subject: Subject, promise: LatinStrata | GridStrata, dims: int) -> bool:
    """Whether strata hold at several counts, the largest ones first: they fail at once where they do not hold."""
    counts = [count for count in subject.counts(16, 64, 97, 100, dims=dims) if count >= 8]
    return bool(counts) and all(
        broken_cell(values, grid) is None
        for count in reversed(counts)
        for values in (subject.sets(count, dims, _REALIZATIONS),)
        for ties in promised_grids(promise, count, dims)
        for grid in ties
    )


def _is_net(subject: Subject) -> bool:
    counts = [count for count in (16, 64, 256) if allows(subject.spec.counts, count, subject.dims(2))]
    return len(counts) >= 2 and all(
        broken_box(subject.sets(count, subject.dims(2), _REALIZATIONS)[:, :2], 2, 0) is None for count in counts
    )


def _one_set(subject: Subject, dims: int) -> bool:
    count = subject.counts(16, dims=dims)[0]
    values = subject.sets(count, dims, _REALIZATIONS)
    return bool((values == values[:1]).all())
