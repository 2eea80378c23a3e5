"""Promised nets, strata and distances: every set keeps them exactly."""

from __future__ import annotations

import math
from collections.abc import Sequence

from samplekit._specs import MinimumDistance, Net, Promise, SamplerSpec, Strata
from samplekit.testing._judge import judge_promise
from samplekit.testing._result import NotApplicable, conformance_check
from samplekit.testing._subject import SamplerSubject, spread_counts

_LARGEST_NET, _LARGEST_QUICK_NET = 1 << 20, 1 << 12
_LARGEST_BLOCK = 1 << 10
_MOST_WORK = 1 << 25
_COUNTS = (1, 2, 3, 4, 5, 6, 7, 9, 12, 16, 25, 49, 64, 96, 97, 100, 121, 256, 1000, 1024, 2025, 4095, 4096)
_ALL_COUNTS, _QUICK_ALL_COUNTS = range(1, 1025), range(1, 129)
_DIMS, _MORE_DIMS, _QUICK_MORE_DIMS = (1, 2, 3, 5), (*range(1, 13), 16, 64), (4, 16)
_DIMS_COUNTS = (16, 97, 1024, 4096)
"""The counts at which more dimensions are judged."""
_LARGE_COUNTS = (*(n for k in range(10, 21) for n in (2**k, 2**k + 1)), 10**4, 10**5, 10**6)
_QUICK_COUNTS = (1, 2, 3, 4, 7, 12, 25, 64, 97, 1000, 4096, 4097, 2**13, 2**16, 2**16 + 1)
_DISTANCE_COUNTS = (2, 3, 16, 64, 97, 100, 256, 1024, 4096, 4097, 2**13)
_QUICK_DISTANCE_COUNTS = (2, 3, 16, 64, 97, 100, 256)
_MANY, _QUICK_MANY = 1024, 256
"""Sets of up to 100 points that are judged, of each seed: a fault in one of a hundred is in them."""
_SEEDS = (0, 1)
_FAR = 10**6 - 7


def promised_nets(spec: SamplerSpec) -> list[Net]:
    """Return the nets that are promised in dimensions that the sampler has."""
    most = spec.dimensions[1]
    return [net for net in spec.promised(Net) if most is None or max(net.dims) < most]


@conformance_check("elementary-intervals", 7)
def check_elementary_intervals(subject: SamplerSubject) -> None:
    """Every elementary interval of every promised net holds its share of points, also in later blocks of a sequence.

    A (t, m, s)-net has b^t points in every b-adic box of volume b^(t - m), of every shape: Niederreiter 1987, "Point
    sets and sequences with small discrepancy".
    """
    nets = promised_nets(subject.spec)
    if not nets:
        raise NotApplicable("it promises no net")
    judged = False
    for net in nets:
        dims = subject.dims(max(net.dims) + 1)
        for m in range(net.t, 64):
            count = net.base**m
            boxes = math.comb(m - net.t + len(net.dims) - 1, len(net.dims) - 1)
            largest = _LARGEST_QUICK_NET if subject.quick else _LARGEST_NET
            if count > min(largest, subject.spec.largest_index + 1) or count * boxes > _MOST_WORK:
                break
            if not subject.allows(count, dims):
                continue
            judged = True
            few = 256 if count <= 256 else 64 if count <= 1024 else 8 if count <= 8192 else 2 if count <= 2**16 else 1
            wanted = few if subject.quick or count > 100 else _MANY
            seeds = _SEEDS[: 1 if subject.quick or count > 2**16 else 2]
            _judge_sets(subject, net, count, dims, wanted, least=1, seeds=seeds)
            if net.sequence and 1 < count <= _LARGEST_BLOCK:
                _judge_later_blocks(subject, net, count, dims)
    if not judged:
        raise NotApplicable("it makes no count that is a power of a promised base")
    _judge_extremes(subject, nets)


def _judge_extremes(subject: SamplerSubject, promises: Sequence[Promise]) -> None:
    for when, values in subject.extremes:
        for promise in promises:
            judge_promise(subject, promise, values, values.shape[2], when=when)


def _judge_sets(
    subject: SamplerSubject,
    promise: Promise,
    count: int,
    dims: int,
    wanted: int,
    least: int,
    seeds: tuple[int, ...] = _SEEDS,
) -> None:
    """Judge whole sets of several seeds, as many as the time allows; one set if nothing is random."""
    if not subject.spec.randomized:
        wanted, seeds = 1, (0,)
    realizations = wanted if wanted == 1 else subject.affordable(wanted, count, dims, least)
    for seed in seeds:
        # Seed 0: the first pixels; another one: pixels far from these, with blocks of dimensions.
        blocks = (2,) * (dims // 2) + (1,) * (dims % 2) if seed else ()
        blocks = blocks if subject.makes(count, dims, blocks) else ()
        # One set at a time: of each count another one, so that a fault of some sets meets one of them.
        first = seed * _FAR + (count if realizations == 1 and subject.spec.randomized else 0)
        asked = subject.sampler.trials(first, first + realizations, seed, blocks)
        judge_promise(subject, promise, subject.fill(asked, count, dims), count, seed=seed, first=first)


def _judge_later_blocks(subject: SamplerSubject, net: Net, block: int, dims: int) -> None:
    count = block * net.base**2
    if not subject.allows(count, dims):
        return
    realizations = subject.sampler.trials(0, 4 if subject.spec.randomized else 1, 0)
    for start in range(block, count, block)[: 4 if subject.quick else 24]:
        values = subject.fill(realizations, count, dims, start, block)
        judge_promise(subject, net, values, count, start=start)


@conformance_check("strata", 8)
def check_strata(subject: SamplerSubject) -> None:
    """Every promised interval and cell holds exactly one point, in every set."""
    promises = subject.spec.promised(Strata)
    if not promises:
        raise NotApplicable("it promises no strata")
    judged = False
    many = _QUICK_MANY if subject.quick else _MANY
    large = () if subject.quick else (*_LARGE_COUNTS, *spread_counts(_LARGE_COUNTS[-1], 2))
    for promise in promises:
        main = {subject.dims(d) for d in _DIMS}
        for dims in sorted(main | {subject.most_dims(d) for d in (_QUICK_MORE_DIMS if subject.quick else _MORE_DIMS)}):
            wanted_counts = _DIMS_COUNTS if dims not in main else _QUICK_COUNTS if subject.quick else _COUNTS
            # The largest sets are judged in two dimensions, or in as many as there are at least.
            more = large if dims == subject.dims(2) else ()
            for count in subject.counts(*wanted_counts, *more, dims=dims):
                if next(promise.cells(count, dims), None) is not None:
                    judged = True
                    wanted = 4 if dims not in main else many if count <= 100 else 4 if count <= 2**15 else 1
                    seeds = _SEEDS if count <= 4096 else _SEEDS[:1]
                    _judge_sets(subject, promise, count, dims, wanted, least=min(wanted, 4), seeds=seeds)
        _judge_all_counts(subject, promise)
    if not judged:
        raise NotApplicable("no count that it makes has the promised strata")
    _judge_extremes(subject, promises)


def _judge_all_counts(subject: SamplerSubject, promise: Promise) -> None:
    """Judge one set of every count up to 1024, in two dimensions: nobody can tell which counts are special."""
    dims = subject.dims(2)
    if not subject.sampler.streams:
        return
    for count in _QUICK_ALL_COUNTS if subject.quick else _ALL_COUNTS:
        if subject.allows(count, dims) and subject.makes(count, dims):
            judge_promise(subject, promise, subject.sets(count, dims, first=count), count, first=count)


@conformance_check("minimum-distance", 9)
def check_minimum_distance(subject: SamplerSubject) -> None:
    """No two points are closer than the promised part of the densest packing's distance, on the torus."""
    promises = subject.spec.promised(MinimumDistance)
    if not promises:
        raise NotApplicable("it promises no minimum distance")
    judged = False
    for promise in promises:
        for dims in sorted({subject.dims(d) for d in (1, 2, 3)}):
            for count in subject.counts(*(_QUICK_DISTANCE_COUNTS if subject.quick else _DISTANCE_COUNTS), dims=dims):
                if promise.distance(count, dims) is not None:
                    judged = True
                    wanted = 128 if count <= 100 and not subject.quick else 16 if count <= 256 else 2
                    realizations = subject.affordable(wanted, count, dims, least=1)
                    judge_promise(subject, promise, subject.sets(count, dims, realizations), count)
    if not judged:
        raise NotApplicable("the densest packing is known in 1 to 5 dimensions, of 2 points and more")
