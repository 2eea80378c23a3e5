"""A sampler refuses what it cannot make, and names the nearest that it can; what it accepts, it makes in full."""

from __future__ import annotations

import re

import numpy as np

from samplekit._errors import CountError, UsageError
from samplekit.testing._judge import repeated
from samplekit.testing._result import CheckFailed, conformance_check
from samplekit.testing._subject import SamplerSubject

_COUNTS = (2, 3, 5, 6, 7, 11, 12, 13, 15, 17, 31, 48, 63, 64, 65, 97, 100, 127, 129, 1000, 1009)


@conformance_check("limits", 15)
def check_limits(subject: SamplerSubject) -> None:
    """Wrong counts and dimensions are refused with the nearest that are right; right ones are made, never changed."""
    least, most = subject.spec.dimensions
    dims, largest = subject.dims(2), subject.spec.largest_index
    if least > 1:
        _judge_refusal(subject, subject.counts(4, dims=dims)[0], least - 1, least)
    if most is not None:
        _judge_refusal(subject, subject.counts(4, dims=dims)[0], most + 1, most)
    for count in _COUNTS:
        if subject.allows(count, dims):
            _judge_made_in_full(subject, count, dims)
        else:
            _judge_refused_count(subject, count, dims)
    if largest < 2**63:
        _judge_refusal(subject, largest + 2, dims, largest + 1)
    _judge_dimensions_differ(subject)


def _judge_refusal(subject: SamplerSubject, count: int, dims: int, *nearest: int, what: str = "") -> UsageError:
    """Return the error that a wrong request gives; raise unless there is one and it names the nearest right numbers."""
    example = subject.request(count, dims)
    try:
        subject.sampler.points(count, dims)
    except UsageError as error:
        for number in nearest:
            if str(number) not in re.findall(r"\d+", str(error)):
                raise CheckFailed(f"the error does not name {number}{what}: {str(error)!r}", example) from None
        return error
    except Exception as error:
        raise CheckFailed(f"raises {type(error).__name__} in place of a UsageError: {error}", example) from None
    raise CheckFailed("makes what it declares that it cannot: expected an error", example)


def _judge_refused_count(subject: SamplerSubject, count: int, dims: int) -> None:
    """Raise unless the error carries the nearest allowed counts below and above, and its message names them."""
    counts, most = subject.spec.counts, subject.spec.largest_index + 1
    below, above = counts.below(min(count, most + 1), dims), counts.above(count, dims)
    nearest = {side: near for side, near in (("below", below), ("above", above)) if near is not None and near <= most}
    what = ", the nearest count that it makes"
    error = _judge_refusal(subject, count, dims, *nearest.values(), what=what)
    for side, number in nearest.items():
        if not isinstance(error, CountError) or getattr(error, side) != number:
            raise CheckFailed(f"the error does not carry {number}{what}: {str(error)!r}", subject.request(count, dims))


def _judge_made_in_full(subject: SamplerSubject, count: int, dims: int) -> None:
    """Raise unless the sampler makes as many different points as were asked for: a rounded count repeats points."""
    try:
        subject.sampler.check(count, dims)
    except UsageError as error:
        raise CheckFailed(f"refuses what it declares: {error}", subject.request(count, dims)) from None
    values = subject.sets(count, dims, 2)
    for row in range(len(values)):
        points = np.ascontiguousarray(values[row].T)
        _, first, copies = np.unique(points, axis=0, return_index=True, return_counts=True)
        if first.size == count:
            continue
        repeated = points[first[copies.argmax()]]
        indices = tuple(int(i) for i in np.flatnonzero((points == repeated).all(axis=1)))
        raise CheckFailed(
            f"{first.size} different points, expected {count}", subject.example(values, count, row=row, indices=indices)
        )


def _judge_dimensions_differ(subject: SamplerSubject) -> None:
    """Raise if two dimensions are equal, as they are if a sampler wraps the number of a dimension without a word."""
    spec = subject.spec
    dims = subject.most_dims((spec.dimensions[1] or 256) if not subject.quick else 256)
    # A grid in so many dimensions has two cells along each.
    count = subject.counts(2**dims if spec.counts.depends_on_dims else 1024, dims=dims)[-1]
    if dims < 2 or count < 16:
        return
    values = subject.sets(count, dims, 1)
    pair = next(repeated(values[0]), None)
    if pair is not None:
        raise CheckFailed(
            f"dimensions {pair[0]} and {pair[1]} are the same numbers in all {count} points",
            subject.example(values, count, indices=(0, count - 1), axes=pair),
        )
