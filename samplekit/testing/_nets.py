"""Elementary intervals: a (t, m, s)-net has b^t points in every b-adic box of volume b^(t - m), of every shape.

Niederreiter 1987, "Point sets and sequences with small discrepancy". Which cell a float64 is in: see ``cells``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._specs import Net
from samplekit.testing._cells import cell_of
from samplekit.testing._declared import allows
from samplekit.testing._elsewhere import forced_extremes
from samplekit.testing._result import CheckFailed, NotApplicable, check

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

_LARGEST, _LARGEST_QUICK = 1 << 16, 1 << 12
_LARGEST_BLOCK = 1 << 10
_MOST_WORK = 1 << 25
_SEEDS = (0, 1)


def promised_nets(spec: SamplerSpec) -> list[Net]:
    """The nets that it promises in dimensions that it has."""
    most = spec.dimensions[1]
    nets = [promise for promise in spec.promises if isinstance(promise, Net)]
    return [net for net in nets if net.dims and (most is None or max(net.dims) < most)]


def _promises_nets(spec: SamplerSpec) -> str:
    return "" if promised_nets(spec) else "it promises no net"


def shapes(digits: int, dims: int) -> Iterator[tuple[int, ...]]:
    """All ways to share ``digits`` among ``dims`` axes."""
    if dims == 1:
        yield (digits,)
        return
    for first in range(digits + 1):
        for rest in shapes(digits - first, dims - 1):
            yield (first, *rest)


def broken_box(points: NDArray[np.float64], base: int, t: int) -> tuple[tuple[int, ...], int, NDArray[np.int64]] | None:
    """The first elementary interval that does not hold b^t points.

    Parameters
    ----------
    points
        float64[R, s, b^m]: R sets, each judged alone.

    Returns
    -------
    Digits of its shape, the set, and its cell along each axis int64[s]; None if there is none. One that holds too many
    is preferred to one that holds too few: it has points to show.
    """
    sets, dims, count = points.shape
    m = round(math.log(count, base)) if count > 1 else 0
    digits = m - t
    if digits < 0:
        return None
    finest = cell_of(points, base**digits)
    offsets = np.arange(sets)[:, None] * base**digits
    for shape in shapes(digits, dims):
        boxes = np.zeros((sets, count), np.int64)
        for axis, q in enumerate(shape):
            boxes = boxes * base**q + finest[:, axis] // base ** (digits - q)
        held = np.bincount((boxes + offsets).ravel(), minlength=sets * base**digits).reshape(sets, -1)
        if (held == base**t).all():
            continue
        row = int(np.argwhere((held != base**t).any(axis=1))[0][0])
        box = int(held[row].argmax())
        cell = np.zeros(dims, np.int64)
        for axis in range(dims - 1, -1, -1):
            box, cell[axis] = divmod(box, base ** shape[axis])
        return shape, row, cell
    return None


def judge_net(
    subject: Subject,
    values: NDArray[np.float64],
    net: Net,
    count: int,
    *,
    seed: int = 0,
    start: int = 0,
    first: int = 0,
    when: str = "",
) -> None:
    """Raise unless the block ``values`` float64[R, D, b^m] is a net, in every set."""
    axes = list(net.dims)
    found = broken_box(values[:, axes], net.base, net.t)
    if found is None:
        return
    shape, row, cell = found
    inside = np.ones(values.shape[2], bool)
    for axis, q, c in zip(axes, shape, cell, strict=True):
        inside &= cell_of(values[row, axis], net.base**q) == c
    box = " x ".join(f"[{c}/{net.base**q}, {c + 1}/{net.base**q})" for q, c in zip(shape, cell, strict=True))
    block = f", block of points {start} to {start + values.shape[2]}" if start else ""
    message = (
        f"the elementary interval {box} of dimensions {', '.join(map(str, axes))} holds {int(inside.sum())} points,"
        f" expected {net.base**net.t} of {values.shape[2]}{block}{when}"
    )
    if broken_box(_nudged(values[:, axes]), net.base, net.t) is None:
        message += (
            "; it is rounding: moved up by 8 units in the last place the points are a net:"
            " add up digits in integers and divide once"
        )
    raise CheckFailed(
        message,
        subject.example(
            values,
            count,
            seed=seed,
            row=row,
            first=first,
            start=start,
            axes=tuple(axes),
            box=tuple((c / net.base**q, (c + 1) / net.base**q) for q, c in zip(shape, map(int, cell), strict=True)),
            indices=tuple(int(i) for i in np.flatnonzero(inside)),
        ),
    )


def _nudged(values: NDArray[np.float64]) -> NDArray[np.float64]:
    nudged: NDArray[np.float64] = np.minimum(values + 8 * np.spacing(values), 1.0 - 2.0**-53)
    return nudged


@check("elementary-intervals", 7, requires=_promises_nets)
def check_elementary_intervals(subject: Subject) -> None:
    """Every elementary interval of every promised net holds its points: first block, later ones of a sequence."""
    judged = 0
    for net in promised_nets(subject.spec):
        dims = subject.dims(max(net.dims) + 1)
        for m in range(net.t, 64):
            count = net.base**m
            boxes = math.comb(m - net.t + len(net.dims) - 1, len(net.dims) - 1)
            largest = _LARGEST_QUICK if subject.quick else _LARGEST
            if count > min(largest, subject.spec.largest_index + 1) or count * boxes > _MOST_WORK:
                break
            if not allows(subject.spec.counts, count, dims):
                continue
            judged += 1
            _judge_first_blocks(subject, net, count, dims)
            if net.sequence and 1 < count <= _LARGEST_BLOCK:
                _judge_later_blocks(subject, net, count, dims)
    if not judged:
        raise NotApplicable("it makes no count that is a power of a promised base")
    if not subject.quick:
        for extreme in forced_extremes(subject):
            for net in promised_nets(subject.spec):
                held = max(net.dims) < extreme.values.shape[1] and _is_power(extreme.count, net.base)
                if held and extreme.count >= net.base**net.t:
                    when = f" with random bits all {extreme.pattern}"
                    judge_net(subject, extreme.values, net, extreme.count, when=when)


def _is_power(n: int, base: int) -> bool:
    while n % base == 0:
        n //= base
    return n == 1


def _judge_first_blocks(subject: Subject, net: Net, count: int, dims: int) -> None:
    if not subject.spec.randomized:
        judge_net(subject, subject.sets(count, dims, 1), net, count)
        return
    wanted = 256 if count <= 256 else 64 if count <= 1024 else 8 if count <= 8192 else 2
    realizations = subject.affordable(wanted, count, dims, least=2)
    for seed in _SEEDS[:1] if subject.quick else _SEEDS:
        judge_net(subject, subject.sets(count, dims, realizations, seed=seed), net, count, seed=seed)


def _judge_later_blocks(subject: Subject, net: Net, block: int, dims: int) -> None:
    count = block * net.base**2
    if count > subject.spec.largest_index + 1 or not allows(subject.spec.counts, count, dims):
        return
    realizations = Realizations.of_trials(0, 4 if subject.spec.randomized else 1, 0)
    for start in range(block, count, block)[: 4 if subject.quick else 24]:
        values = subject.fill(realizations, count, dims, start, block)
        judge_net(subject, values, net, count, start=start)
