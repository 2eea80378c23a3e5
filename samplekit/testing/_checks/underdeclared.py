"""Hints about properties that a sampler has but does not declare, so that no user can rely on them."""

from __future__ import annotations

from samplekit._specs import AnyCount, GridStrata, LatinStrata, Net, Promise
from samplekit.testing._result import conformance_check
from samplekit.testing._subject import SamplerSubject

_REALIZATIONS = 8


@conformance_check("under-declaring", 20)
def check_under_declaring(subject: SamplerSubject) -> None:
    """Properties that hold in all sets that were looked at, and are not declared, are named in hints."""
    spec = subject.spec
    dims = subject.dims(2)
    strata_counts = [count for count in subject.counts(16, 64, 97, 100, dims=dims) if count >= 8]
    net_counts = [count for count in (16, 64, 256) if spec.counts.allows(count, dims)]
    if spec.progressive is None and _has_prefixes(subject, dims):
        subject.hints.append("prefixes of its sets are its sets: progressive could be declared")
    if not spec.promised(LatinStrata) and _holds(subject, LatinStrata(), strata_counts, dims):
        subject.hints.append("every dimension has one point in each of N intervals: LatinStrata() could be promised")
    may_be_grid = dims == 2 and spec.counts != AnyCount() and not spec.promised(GridStrata)
    if may_be_grid and _holds(subject, GridStrata(), strata_counts, dims):
        subject.hints.append("every cell of the grid holds one point: GridStrata() could be promised")
    if dims >= 2 and not spec.promised(Net) and len(net_counts) >= 2 and _holds(subject, Net(), net_counts, dims):
        subject.hints.append("dimensions 0 and 1 are (0, m, 2)-nets in base 2: Net(dims=(0, 1)) could be promised")
    if not spec.extensible_dims and _has_first_dimensions(subject):
        subject.hints.append("the first dimensions stay when there are more: extensible_dims=True could be declared")
    if spec.randomized:
        values = subject.sets(subject.counts(16, dims=dims)[0], dims, _REALIZATIONS)
        if (values == values[:1]).all():
            subject.hints.append("all realisations have one set: randomized=False could be declared")


def _has_prefixes(subject: SamplerSubject, dims: int) -> bool:
    counts = subject.counts(1, 2, 4, 16, 64, 256, dims=dims)
    if len(counts) < 3:
        return False
    whole = subject.sets(counts[-1], dims, 2)
    return all((subject.sets(count, dims, 2) == whole[:, :, :count]).all() for count in counts[:-1])


def _has_first_dimensions(subject: SamplerSubject) -> bool:
    """Tell whether fewer dimensions are the first ones of more, in at least two sets of different counts."""
    low, high = subject.dims(1), subject.dims(4)
    judged = [count for count in subject.counts(1, 4, 16, 64, 256, dims=high) if subject.allows(count, low)]
    return len(judged) > 1 and all(
        (subject.sets(count, dims, 2) == subject.sets(count, high, 2)[:, :dims]).all()
        for count in judged
        for dims in range(low, high)
        if subject.allows(count, dims)
    )


def _holds(subject: SamplerSubject, promise: Promise, counts: list[int], dims: int) -> bool:
    """Tell whether a promise holds at all counts, the largest ones first: they fail at once where it does not."""
    return bool(counts) and all(
        promise.find_violation(subject.sets(count, dims, _REALIZATIONS).transpose(0, 2, 1)) is None
        for count in reversed(counts)
    )
