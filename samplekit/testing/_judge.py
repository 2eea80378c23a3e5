"""Judge sets of points by a promise: a violation becomes a failed check with its counter-example."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.testing._result import CheckFailed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._specs import Promise
    from samplekit.testing._subject import Subject


def judge(
    subject: Subject,
    promise: Promise,
    values: NDArray[np.float64],
    count: int,
    *,
    seed: int = 0,
    start: int = 0,
    when: str = "",
    if_rounded: str = "",
) -> None:
    """Raise unless every set keeps the promise.

    Parameters
    ----------
    values
        float64[R, D, n]: points ``start`` to ``start + n`` of sets of ``count`` points.
    when
        Circumstances, as the end of the message.
    if_rounded
        What holds of the points once they are moved up by a few units in the last place, if it is worth a try: what
        breaks the promise is then rounding, and the message says so.

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
    if if_rounded:
        nudged = np.minimum(values + 8 * np.spacing(values), 1.0 - 2.0**-53)
        if promise.find_violation(nudged.transpose(0, 2, 1)) is None:
            message += (
                f"; it is rounding: moved up by 8 units in the last place {if_rounded}:"
                " add up digits in integers and divide once"
            )
    raise CheckFailed(
        message,
        subject.example(
            values,
            count,
            seed=seed,
            row=found.realization,
            start=start,
            axes=found.axes,
            box=found.box,
            indices=found.points,
        ),
    )
