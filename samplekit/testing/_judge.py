"""Judge sets of points: equality bit for bit, and promises. A fault becomes a failed check with a counter-example."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from samplekit._specs import Promise
from samplekit.testing._result import CheckFailed
from samplekit.testing._subject import Array, SamplerSubject


def judge_equal(
    subject: SamplerSubject, expected: Array, found: Array, count: int, when: str, *, seed: int = 0, start: int = 0
) -> None:
    """Raise unless two arrays are equal bit for bit; -0.0 differs from 0.0, and NaN equals itself.

    Parameters
    ----------
    expected, found
        float64[R, D, n]: points ``start`` to ``start + n`` of sets of ``count`` points.
    when
        How ``found`` was asked for, as the end of a message.

    Raises
    ------
    CheckFailed
        They differ.
    """
    different = np.ascontiguousarray(expected).view(np.uint64) != np.ascontiguousarray(found).view(np.uint64)
    if not different.any():
        return
    row, dimension, point = (int(i) for i in np.argwhere(different)[0])
    raise CheckFailed(
        f"point {start + point} of {count} is at {float(expected[row, dimension, point])!r} in dimension {dimension},"
        f" but at {float(found[row, dimension, point])!r} {when};"
        f" {int(np.count_nonzero(different.any(axis=(1, 2))))} of {len(expected)} sets differ",
        subject.example(expected, count, seed=seed, row=row, start=start, indices=(point,)),
    )


def repeated(arrays: Iterable[Array]) -> Iterator[tuple[int, int]]:
    """Yield for each array that equals an earlier one bit for bit: the index of the first such array, and its own."""
    seen: dict[bytes, int] = {}
    for later, array in enumerate(arrays):
        earlier = seen.setdefault(array.tobytes(), later)
        if earlier != later:
            yield earlier, later


def judge_promise(
    subject: SamplerSubject,
    promise: Promise,
    values: Array,
    count: int,
    *,
    seed: int = 0,
    first: int = 0,
    start: int = 0,
    when: str = "",
) -> None:
    """Raise unless every set keeps the promise.

    Parameters
    ----------
    values
        float64[R, D, n]: points ``start`` to ``start + n`` of sets of ``count`` points.
    first
        Realisation of the first set.
    when
        Circumstances, as the end of the message.

    Raises
    ------
    CheckFailed
        A set breaks the promise.
    """
    found = promise.find_violation(values.transpose(0, 2, 1))
    if found is None:
        return
    block = f", block of points {start} to {start + values.shape[2]}" if start else ""
    message = f"{found}{block}{when}"
    nudged = np.minimum(values + 8 * np.spacing(values), 1.0 - 2.0**-53)
    if promise.find_violation(nudged.transpose(0, 2, 1)) is None:
        message += (
            "; it is rounding: moved up by 8 units in the last place the points keep the promise:"
            " add up digits in integers and divide once"
        )
    row, indices, axes, box = found.realization, found.points, found.axes, found.box
    where = {"seed": seed, "row": row, "first": first, "start": start}
    example = subject.example(values, count, indices=indices, axes=axes, box=box, **where)
    raise CheckFailed(message, example)
