"""Large indices and pixels at the far ends: no overflow, no wrap, and nets are nets there too."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._specs import Net
from samplekit.testing._declared import dims_of
from samplekit.testing._nets import judge_net
from samplekit.testing._prefix import judge_part
from samplekit.testing._range import judge_range, outside
from samplekit.testing._result import CheckFailed, CounterExample, NotApplicable, check

if TYPE_CHECKING:
    from samplekit.testing._subject import Subject

PLACES = (2**16, 2**31 - 1, 2**32, 2**40)
_POINTS = 16
EXTREMES = (0, 1, 255, 256, 2**16 + 1, 2**31 - 1, 2**32 - 1)


def _counts(subject: Subject, dims: int) -> list[int]:
    """Return declared counts just above each place, and the largest one."""
    most = subject.spec.largest_index + 1
    wanted = [n for place in PLACES for n in (place + _POINTS, 2 * place, place)] + [2**30, 2**20, most]
    return sorted({n for n in wanted if 2**16 <= n <= most and subject.spec.counts.allows(n, dims)})


@check("large-index", 16)
def check_large_index(subject: Subject) -> None:
    """Points at indices about 2^16, 2^31, 2^32 and 2^40, as far as declared, are right and not those of small ones."""
    if not subject.sampler.streams:
        raise NotApplicable("it makes sets as a whole: large indices are large sets")
    dims = dims_of(subject.spec, 2)
    counts = _counts(subject, dims)
    if not counts:
        raise NotApplicable(f"its largest index is {subject.spec.largest_index}")
    # Sets so large that a bank or a table is made for them would take for ever: they say so by their cost.
    realizations = Realizations.of_trials(0, 2, 0)
    for count in counts:
        beginning = subject.fill(realizations, count, dims, 0, _POINTS)
        for start in sorted({count - _POINTS, *(p - _POINTS // 2 for p in PLACES if p + _POINTS // 2 <= count)}):
            values = subject.fill(realizations, count, dims, start, _POINTS)
            if outside(values) is not None:
                judge_range(subject, values, count, 0)
            for i in (0, _POINTS // 2, _POINTS - 1):
                alone = subject.fill(realizations, count, dims, start + i, 1)
                judge_part(subject, values[:, :, i : i + 1], alone, count, "when asked for alone", start + i)
            same = (values[0, :, :, None] == beginning[0, :, None, :]).all(axis=0)
            if start >= _POINTS and same.any():
                late, early = (int(i) for i in np.argwhere(same)[0])
                raise CheckFailed(
                    f"point {start + late} of {count} is point {early} again",
                    subject.example(values, count, start=start, indices=(late,)),
                )
    _judge_late_blocks(subject)


def _judge_late_blocks(subject: Subject) -> None:
    """Blocks of a promised (t, s)-sequence about the places are nets."""
    for net in subject.spec.promised(Net):
        if not net.sequence:
            continue
        dims = dims_of(subject.spec, max(net.dims) + 1)
        if max(net.dims) >= dims:
            continue
        m = next(m for m in range(64) if net.base**m >= 64 or m == net.t + 3)
        block = net.base**m
        for place in PLACES:
            # The count: the next power of the base, for samplers that make powers alone.
            count = net.base
            while count < place + block:
                count *= net.base
            if count > subject.spec.largest_index + 1 or not subject.spec.counts.allows(count, dims):
                continue
            start = place // block * block
            values = subject.fill(Realizations.of_trials(0, 2, 0), count, dims, start, block)
            judge_net(subject, values, net, count, start=start)


@check("pixel-extremes", 17)
def check_pixel_extremes(subject: Subject) -> None:
    """Pixels at 0, 2^16 + 1, 2^31 - 1 and 2^32 - 1 have sets of their own, the same alone as in company."""
    dims = subject.dims(2)
    count = subject.counts(16, dims=dims)[0]
    x, y = (np.array(each, np.int64).ravel() for each in np.meshgrid(EXTREMES, EXTREMES))
    realizations = Realizations.of_pixels(x, y, 0)
    values = subject.fill(realizations, count, dims)
    judge_range(subject, values, count, 0)
    for i in range(x.size):
        alone = subject.fill(Realizations.of_pixels(x[i : i + 1], y[i : i + 1], 0), count, dims)
        if (alone[0] != values[i]).any():
            raise CheckFailed(
                "the set of a pixel is another one when it is asked for alone",
                CounterExample(subject.text, count, dims, 0, (int(x[i]), int(y[i]))),
            )
    if not subject.spec.randomized:
        return
    seen: dict[bytes, int] = {}
    for i in range(x.size):
        j = seen.setdefault(values[i].tobytes(), i)
        if j != i and not _may_repeat(subject, (int(x[i] - x[j]), int(y[i] - y[j]))):
            raise CheckFailed(
                f"pixels ({x[j]}, {y[j]}) and ({x[i]}, {y[i]}) have the same set",
                CounterExample(subject.text, count, dims, 0, (int(x[i]), int(y[i]))),
            )


def _may_repeat(subject: Subject, offset: tuple[int, int]) -> bool:
    period = subject.spec.period
    return period is not None and all(part % period == 0 for part in offset)
