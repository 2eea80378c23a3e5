"""The variance is not above what random points, and the strata that are declared, give in closed form."""

from __future__ import annotations

import math

import numpy as np

from samplekit._specs import Strata
from samplekit.testing._checks.uniformity import Integrand
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import normal_threshold
from samplekit.testing._subject import Array, SamplerSubject

_COUNTS = (256, 1024)
_REALIZATIONS, _QUICK_REALIZATIONS = 1 << 12, 1 << 9
_BATCH = 1 << 8
_TESTS = 12
_SLACK = 0.3
_RADIUS, _CX, _CY = 0.3, 0.4523, 0.5317
_DISK = math.pi * _RADIUS**2
_JITTER_LAW = 0.31284
"""Variance of the disk by jittered points, times N^1.5: 0.165968 times the length of its edge."""
_CELLS_SLACK = 3.0
"""Points that are one to a cell, but depend on each other across cells, may be worse than jittered ones by this."""


def _functions(dims: int) -> list[Integrand]:
    step = Integrand("a step", lambda x: (x[:, 0] < _CX).astype(float), _CX, _CX * (1 - _CX))
    if dims == 1:
        return [step, Integrand("x0^2", lambda x: x[:, 0] ** 2, 1 / 3, 4 / 45)]
    return [
        step,
        Integrand("a disk", _disk, _DISK, _DISK * (1 - _DISK)),
        Integrand("x0 + x1", lambda x: x[:, 0] + x[:, 1], 1.0, 1 / 6),
        Integrand("x0 x1", lambda x: x[:, 0] * x[:, 1], 1 / 4, 1 / 9 - 1 / 16),
    ]


def _disk(x: Array) -> Array:
    return ((x[:, 0] - _CX) ** 2 + (x[:, 1] - _CY) ** 2 < _RADIUS**2).astype(float)


@conformance_check("variance", 12)
def check_variance(subject: SamplerSubject) -> None:
    """The variance at 256 and 1024 points is no more than random points', and no more than promised strata imply.

    It may be 30 % above the closed form.
    """
    spec = subject.spec
    dims = subject.dims(2)
    functions = _functions(dims)
    counts = subject.counts(*_COUNTS, dims=dims)
    if not counts:
        raise NotApplicable("it makes no set of about 256 or 1024 points")
    disks: list[float] = []
    for count in counts:
        if spec.randomized:
            wanted = _QUICK_REALIZATIONS if subject.quick else _REALIZATIONS
            realizations = subject.affordable(wanted, count, dims)
            slack = max(_SLACK, normal_threshold(_TESTS) * math.sqrt(2.0 / realizations))
        else:
            # The error of the one set may be that of an unlucky random set: this is a bound, not a test.
            realizations, slack = 1, normal_threshold(_TESTS) ** 2 - 1.0
        squared = _mean_squares(subject, functions, count, dims, realizations)
        for (name, _, _, variance), found in zip(functions, squared, strict=True):
            if name == "a disk":
                disks.append(found)
            bound, why = variance / count, "random points"
            if spec.randomized:
                bound, why = min([(bound, why), *_implied(subject, name, count, dims)])
            if found > (1.0 + slack) * bound:
                raise CheckFailed(
                    f"the mean squared error of {name} is {found:.3g} at {count} points, {found / bound:.3g} times what"
                    f" {why} give ({realizations} sets; up to {1.0 + slack:.3g} times is allowed)",
                    subject.request(count, dims),
                )
    if spec.randomized and len(counts) == 2 and min(disks, default=0.0) > 0.0 and _one_a_cell(subject, counts[1], dims):
        # Where every cell holds a point, the variance of the disk falls as N^-1.5. The check accepts N^-1.2 and faster.
        slope = math.log(disks[1] / disks[0]) / math.log(counts[1] / counts[0])
        if slope > -1.2 + (0.3 if subject.quick else 0.0):
            raise CheckFailed(
                f"the variance of a disk falls as N^{slope:.3g} from {counts[0]} to {counts[1]} points: N^-1.5 is"
                " expected of points that are one to a cell",
                subject.request(counts[1], dims),
            )


def _mean_squares(
    subject: SamplerSubject, functions: list[Integrand], count: int, dims: int, realizations: int
) -> Array:
    """Return the mean squared error of each function's estimate, over realisations."""
    sums = np.zeros(len(functions))
    for sets in subject.independent_sets(realizations, count, dims, _BATCH):
        sums += [((function(sets).mean(axis=1) - integral) ** 2).sum() for _, function, integral, _ in functions]
    return sums / realizations


def _implied(subject: SamplerSubject, name: str, count: int, dims: int) -> list[tuple[float, str]]:
    """Return the bounds that the promises imply for one function, and why."""
    bounds: list[tuple[float, str]] = []
    strata = [cells for promise in subject.spec.promised(Strata) for cells in promise.cells(count, dims)]
    if name == "x0 + x1" and all(((d,), (count,)) in strata for d in (0, 1)):
        # One point in each interval: a coordinate's mean is off by half an interval at most.
        bounds.append((1.0 / count**2, "Latin strata at their worst"))
    if name == "a disk" and _one_a_cell(subject, count, dims):
        bounds.append((_CELLS_SLACK * _JITTER_LAW / count**1.5, "three times jittered points"))
    return bounds


def _one_a_cell(subject: SamplerSubject, count: int, dims: int) -> bool:
    """Tell whether near-square cells of dimensions 0 and 1 are promised to hold one point each."""
    return any(
        cells.axes == (0, 1) and math.prod(cells.sides) == count and max(cells.sides) <= 2 * min(cells.sides)
        for promise in subject.spec.promises
        for cells in promise.cells(count, dims)
    )
