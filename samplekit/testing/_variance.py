"""Quality floor: the variance that a declaration implies, against closed forms."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._specs import Strata
from samplekit.testing._result import CheckFailed, CounterExample, NotApplicable, check
from samplekit.testing._statistics import normal_threshold

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit.testing._subject import Subject

COUNTS = (256, 1024)
_REALIZATIONS, _QUICK_REALIZATIONS = 1 << 12, 1 << 9
_CHUNK = 1 << 8
_TESTS = 12
_SLACK = 0.3
_RADIUS, _CX, _CY = 0.3, 0.4523, 0.5317
_DISK = math.pi * _RADIUS**2
_JITTER_LAW = 0.31284
"""Variance of the disk by jittered points, times N^1.5: 0.165968 times the length of its edge."""
_CELLS_SLACK = 3.0
"""Points that are one to a cell but depend on each other across cells may do worse than jittered ones, not by more."""

Function = tuple[str, "Callable[[NDArray[np.float64]], NDArray[np.float64]]", float, float]
"""Name, function of float64[R, D, N], integral, variance of one random point."""


def _functions(dims: int) -> list[Function]:
    one = _CX * (1 - _CX)
    step: Function = ("a step", lambda x: (x[:, 0] < _CX).astype(float), _CX, one)
    if dims == 1:
        return [step, ("x0^2", lambda x: x[:, 0] ** 2, 1 / 3, 4 / 45)]
    return [
        step,
        (
            "a disk",
            lambda x: ((x[:, 0] - _CX) ** 2 + (x[:, 1] - _CY) ** 2 < _RADIUS**2).astype(float),
            _DISK,
            _DISK * (1 - _DISK),
        ),
        ("x0 + x1", lambda x: x[:, 0] + x[:, 1], 1.0, 1 / 6),
        ("x0 x1", lambda x: x[:, 0] * x[:, 1], 1 / 4, 1 / 9 - 1 / 16),
    ]


@check("variance", 12, tolerance="30 % above the closed form, family-wise 1e-3")
def check_variance(subject: Subject) -> None:
    """The variance at 256 and 1024 points is no more than random points', and no more than promised strata imply."""
    spec = subject.spec
    dims = subject.dims(2)
    functions = _functions(dims)
    variances: dict[tuple[str, int], float] = {}
    counts = subject.counts(*COUNTS, dims=dims)
    for count in counts:
        if spec.randomized:
            wanted = _QUICK_REALIZATIONS if subject.quick else _REALIZATIONS
            realizations = subject.affordable(wanted, count, dims)
            slack = max(_SLACK, normal_threshold(_TESTS) * math.sqrt(2.0 / realizations))
        else:
            # The error of one set, as if it were drawn from random ones: a bound, not a test.
            realizations, slack = 1, normal_threshold(_TESTS) ** 2 - 1.0
        squared = _mean_squares(subject, functions, count, dims, realizations)
        for (name, _, _, variance), found in zip(functions, squared, strict=True):
            variances[name, count] = found
            bound, why = variance / count, "random points"
            if spec.randomized:
                bound, why = min([(bound, why), *_implied(subject, name, count, dims)])
            if found > (1.0 + slack) * bound:
                raise CheckFailed(
                    f"the mean squared error of {name} is {found:.3g} at {count} points, {found / bound:.3g} times what"
                    f" {why} give ({realizations} sets; up to {1.0 + slack:.3g} times is allowed)",
                    CounterExample(subject.text, count, dims),
                )
    if not variances:
        raise NotApplicable("it makes no set of about 256 or 1024 points")
    if spec.randomized and len(counts) == 2 and _one_a_cell(subject, counts[1], dims):
        _judge_slope(subject, variances["a disk", counts[0]], variances["a disk", counts[1]], counts, dims)


def _mean_squares(
    subject: Subject, functions: list[Function], count: int, dims: int, realizations: int
) -> NDArray[np.float64]:
    sums = np.zeros(len(functions))
    for first in range(0, realizations, _CHUNK):
        stop = min(first + _CHUNK, realizations)
        values = subject.fill(subject.independent(first, stop), count, dims)
        for i, (_, function, integral, _) in enumerate(functions):
            sums[i] += ((function(values).mean(axis=1) - integral) ** 2).sum()
    return sums / realizations


def _implied(subject: Subject, name: str, count: int, dims: int) -> list[tuple[float, str]]:
    """Return the bounds that the promises imply for one function, and why."""
    bounds: list[tuple[float, str]] = []
    strata = [cells for promise in subject.spec.promised(Strata) for cells in promise.cells(count, dims)]
    if name == "x0 + x1" and all(((d,), (count,)) in strata for d in (0, 1)):
        # One point in each interval: a coordinate's mean is off by half an interval at most.
        bounds.append((1.0 / count**2, "Latin strata at their worst"))
    if name == "a disk" and _one_a_cell(subject, count, dims):
        bounds.append((_CELLS_SLACK * _JITTER_LAW / count**1.5, "three times jittered points"))
    return bounds


def _one_a_cell(subject: Subject, count: int, dims: int) -> bool:
    """Tell whether near-square cells of dimensions 0 and 1 are promised to hold one point each."""
    return any(
        cells.axes == (0, 1) and math.prod(cells.sides) == count and max(cells.sides) <= 2 * min(cells.sides)
        for promise in subject.spec.promises
        for cells in promise.cells(count, dims)
    )


def _judge_slope(subject: Subject, small: float, large: float, counts: list[int], dims: int) -> None:
    """The variance of the disk falls as N^-1.5 where every cell holds a point: as N^-1.2 or faster is asked for."""
    if large <= 0.0 or small <= 0.0:
        return
    slope = math.log(large / small) / math.log(counts[1] / counts[0])
    if slope > -1.2 + (0.3 if subject.quick else 0.0):
        raise CheckFailed(
            f"the variance of a disk falls as N^{slope:.3g} from {counts[0]} to {counts[1]} points: N^-1.5 is expected"
            " of points that are one to a cell",
            CounterExample(subject.text, counts[1], dims),
        )
