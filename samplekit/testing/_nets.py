"""Elementary intervals: a (t, m, s)-net has b^t points in every b-adic box of volume b^(t - m), of every shape.

Niederreiter 1987, "Point sets and sequences with small discrepancy".
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from samplekit._bases.realizations import Realizations
from samplekit._specs import Net
from samplekit.testing._elsewhere import forced_extremes
from samplekit.testing._judge import judge
from samplekit.testing._result import NotApplicable, check

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

_LARGEST, _LARGEST_QUICK = 1 << 16, 1 << 12
_LARGEST_BLOCK = 1 << 10
_MOST_WORK = 1 << 25
_SEEDS = (0, 1)


def promised_nets(spec: SamplerSpec) -> list[Net]:
    """Return the nets that are promised in dimensions that the sampler has."""
    most = spec.dimensions[1]
    return [net for net in spec.promised(Net) if most is None or max(net.dims) < most]


def _promises_nets(spec: SamplerSpec) -> str:
    return "" if promised_nets(spec) else "it promises no net"


def judge_net(
    subject: Subject,
    values: NDArray[np.float64],
    net: Net,
    count: int,
    *,
    seed: int = 0,
    start: int = 0,
    when: str = "",
) -> None:
    """Raise unless the block ``values`` float64[R, D, b^m] is a net, in every set."""
    judge(subject, net, values, count, seed=seed, start=start, when=when, if_rounded="the points are a net")


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
            if not subject.spec.counts.allows(count, dims):
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
                when = f" with random bits all {extreme.pattern}"
                judge_net(subject, extreme.values, net, extreme.count, when=when)


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
    if count > subject.spec.largest_index + 1 or not subject.spec.counts.allows(count, dims):
        return
    realizations = Realizations.of_trials(0, 4 if subject.spec.randomized else 1, 0)
    for start in range(block, count, block)[: 4 if subject.quick else 24]:
        values = subject.fill(realizations, count, dims, start, block)
        judge_net(subject, values, net, count, start=start)
