"""Large indices and pixels at the far ends: nothing overflows, nothing wraps, and nets are nets there too."""

from __future__ import annotations

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._specs import Net, PowersOf
from samplekit.testing._checks.promises import promised_nets
from samplekit.testing._checks.range import judge_range
from samplekit.testing._judge import judge_equal, judge_promise, repeated
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._subject import SamplerSubject

_PLACES = (2**31 - 1, *(2**k for k in range(11, 41)), *(3 * 2**k + 17 for k in range(10, 38, 3)), 10**5, 10**6, 10**9)
_POINTS = 16
_LATE_BLOCKS = (64, 4096)
"""Points of the blocks of sequences that are judged at large indices, at least."""
_COORDINATES = (0, 1, 255, 256, 2**16 + 1, 2**31 - 1, 2**32 - 1)


@conformance_check("large-index", 16)
def check_large_index(subject: SamplerSubject) -> None:
    """Points about the indices 2^11, 2^12, ... 2^40, as far as declared, are right and repeat no small ones."""
    if not subject.sampler.streams:
        raise NotApplicable("it makes sets as a whole: large indices are large sets")
    dims, most = subject.dims(2), subject.spec.largest_index + 1
    # Declared counts just above each place, and the largest one.
    wanted = [n for place in _PLACES for n in (place + _POINTS, 2 * place, place)] + [2**30, 2**20, most]
    counts = sorted({n for n in wanted if n >= 2**16 and subject.allows(n, dims)})
    if not counts:
        raise NotApplicable(f"its largest index is {subject.spec.largest_index}")
    realizations = subject.sampler.trials(0, 2, 0)
    for count in counts:
        beginning = subject.fill(realizations, count, dims, 0, _POINTS)
        for start in sorted({count - _POINTS, *(p - _POINTS // 2 for p in _PLACES if p + _POINTS // 2 <= count)}):
            values = subject.fill(realizations, count, dims, start, _POINTS)
            judge_range(subject, values, count, 0)
            for i in (0, _POINTS // 2, _POINTS - 1):
                alone = subject.fill(realizations, count, dims, start + i, 1)
                judge_equal(subject, values[:, :, i : i + 1], alone, count, "when asked for alone", start=start + i)
            same = (values[0, :, :, None] == beginning[0, :, None, :]).all(axis=0)
            if same.any():
                late, early = (int(i) for i in np.argwhere(same)[0])
                raise CheckFailed(
                    f"point {start + late} of {count} is point {early} again",
                    subject.example(values, count, start=start, indices=(late,)),
                )
    _judge_late_prefixes(subject, dims)
    for net in promised_nets(subject.spec):
        for least in _LATE_BLOCKS if net.sequence else ():
            _judge_late_blocks(subject, net, least)


def _judge_late_prefixes(subject: SamplerSubject, dims: int) -> None:
    """Raise unless a late part of a progressive sequence is the same in longer ones."""
    progressive = subject.spec.progressive
    if progressive is None:
        return
    for place in _PLACES:
        short = progressive.above(place, dims)
        long = None if short is None else progressive.above(2 * short - 1, dims)
        if short and long and subject.allows(short, dims) and subject.allows(long, dims):
            part, same = (
                subject.fill(subject.sampler.trials(0, 2, 0), count, dims, short - _POINTS, _POINTS)
                for count in (short, long)
            )
            judge_equal(subject, part, same, short, f"as a prefix of {long} points", start=short - _POINTS)


def _judge_late_blocks(subject: SamplerSubject, net: Net, least: int) -> None:
    """Raise unless the blocks about large indices of a promised (t, s)-sequence are nets."""
    dims = subject.dims(max(net.dims) + 1)
    block = next(net.base**m for m in range(64) if net.base**m >= least or m == net.t + 3)
    for place in _PLACES:
        if place < block:
            continue
        # Some samplers make powers of the base only.
        count = PowersOf(net.base).above(place + block - 1, dims)
        if subject.allows(count, dims):
            start = place // block * block
            values = subject.fill(subject.sampler.trials(0, 2, 0), count, dims, start, block)
            judge_promise(subject, net, values, count, start=start)


@conformance_check("pixel-extremes", 17)
def check_pixel_extremes(subject: SamplerSubject) -> None:
    """Pixels at 0, 2^16 + 1, 2^31 - 1 and 2^32 - 1 have sets of their own, the same alone as with the others."""
    dims = subject.dims(2)
    count = subject.counts(16, dims=dims)[0]
    pixels = [(x, y) for y in _COORDINATES for x in _COORDINATES]
    x, y = np.array(pixels, np.int64).T
    asked = Realizations.of_pixels(x, y, 0)
    values = subject.fill(asked, count, dims)
    judge_range(subject, values, count, 0)
    for i, pixel in enumerate(pixels):
        if (subject.fill(asked[i : i + 1], count, dims)[0] != values[i]).any():
            raise CheckFailed(
                "the set of a pixel is another one when it is asked for alone",
                subject.request(count, dims, realization=pixel),
            )
    period = subject.spec.period
    for first, second in repeated(values) if subject.spec.randomized else ():
        if period is None or (x[second] - x[first]) % period != 0 or (y[second] - y[first]) % period != 0:
            raise CheckFailed(
                f"pixels {pixels[first]} and {pixels[second]} have the same set",
                subject.request(count, dims, realization=pixels[second]),
            )
