"""Limits: what a sampler cannot make it refuses, naming the nearest that it can; what it accepts it makes in full."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import CountError, UsageError
from samplekit.testing._result import CheckFailed, CounterExample, check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.testing._subject import Subject

COUNTS = (2, 3, 5, 6, 7, 11, 12, 13, 15, 17, 31, 48, 63, 64, 65, 97, 100, 127, 129, 1000, 1009)


@check("limits", 15)
def check_limits(subject: Subject) -> None:
    """Wrong counts and dimensions are refused with the nearest that are right; right ones are made, never changed."""
    least, most = subject.spec.dimensions
    dims = subject.dims(2)
    if least > 1:
        _refused(subject, subject.counts(4, dims=dims)[0], least - 1, least)
    if most is not None:
        _refused(subject, subject.counts(4, dims=dims)[0], most + 1, most)
    for count in COUNTS:
        if subject.spec.counts.allows(count, dims) and count <= subject.spec.largest_index + 1:
            _accepted(subject, count, dims)
            _made_in_full(subject, count, dims)
        else:
            _refused_count(subject, count, dims)
    largest = subject.spec.largest_index
    if largest < 2**63:
        _refused(subject, largest + 2, dims, largest + 1)
    _all_dimensions_differ(subject)


def _refused(subject: Subject, count: int, dims: int, names: int) -> None:
    refusal = str(_refusal(subject, count, dims))
    if not _names(refusal, names):
        raise CheckFailed(f"the error does not name {names}: {refusal!r}", CounterExample(subject.text, count, dims))


def _names(text: str, number: int) -> bool:
    return str(number) in re.findall(r"\d+", text)


def _refused_count(subject: Subject, count: int, dims: int) -> None:
    """Raise unless the error carries the nearest allowed counts below and above, and its message names them."""
    refusal = _refusal(subject, count, dims)
    carried = (refusal.below, refusal.above) if isinstance(refusal, CountError) else (None, None)
    most = subject.spec.largest_index + 1
    below = subject.spec.counts.below(min(count, most + 1), dims)
    above = subject.spec.counts.above(count, dims)
    for nearest, found in zip((below, above), carried, strict=True):
        if nearest is not None and nearest <= most and not (nearest == found and _names(str(refusal), nearest)):
            raise CheckFailed(
                f"the error does not name {nearest}, the nearest count that it makes: {str(refusal)!r}",
                CounterExample(subject.text, count, dims),
            )


def _refusal(subject: Subject, count: int, dims: int) -> UsageError:
    """Return the error that a wrong request gives."""
    example = CounterExample(subject.text, count, dims)
    try:
        subject.sampler.points(count, dims)
    except UsageError as error:
        return error
    except Exception as error:
        raise CheckFailed(f"raises {type(error).__name__} in place of a UsageError: {error}", example) from None
    raise CheckFailed("makes what it declares that it cannot: expected an error", example)


def _accepted(subject: Subject, count: int, dims: int) -> None:
    """What is declared is not refused, in so few dimensions."""
    try:
        subject.sampler.check(count, dims)
    except UsageError as error:
        raise CheckFailed(f"refuses what it declares: {error}", CounterExample(subject.text, count, dims)) from None


def _made_in_full(subject: Subject, count: int, dims: int) -> None:
    """As many different points as were asked for: a count rounded in silence shows as points that repeat."""
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


def _all_dimensions_differ(subject: Subject) -> None:
    """No two dimensions are the same numbers: dimensions wrapped in silence are."""
    spec = subject.spec
    dims = subject.most_dims((spec.dimensions[1] or 256) if not subject.quick else 256)
    if dims < 2:
        return
    # A grid in so many dimensions has two cells along each.
    count = subject.counts(2**dims if spec.counts.depends_on_dims else 1024, dims=dims)[-1]
    if count < 16:
        return
    values = subject.sets(count, dims, 1)
    same = same_dimensions(values[0])
    if same is not None:
        raise CheckFailed(
            f"dimensions {same[0]} and {same[1]} are the same numbers in all {count} points",
            subject.example(values, count, indices=(0, count - 1), axes=same),
        )


def same_dimensions(points: NDArray[np.float64]) -> tuple[int, int] | None:
    """Two dimensions of ``points`` float64[D, N] that are equal."""
    seen: dict[bytes, int] = {}
    for dimension, row in enumerate(points):
        earlier = seen.setdefault(row.tobytes(), dimension)
        if earlier != dimension:
            return earlier, dimension
    return None
