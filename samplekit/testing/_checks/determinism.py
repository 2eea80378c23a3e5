"""The same request gives the same points, whatever was asked before, wherever, and as a part of whatever.

Another seed gives other points, a prefix of a progressive set is a set of its own, a slice is that part of the set, and
the first dimensions stay when more are asked for, if that is declared.
"""

from __future__ import annotations

import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from samplekit._configured.sampler import sampler as configured_sampler
from samplekit.testing._elsewhere import judge_elsewhere
from samplekit.testing._judge import judge_equal, repeated
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._subject import SamplerSubject, spread_counts

_REALIZATIONS = 70
_POWERS = tuple(n for k in range(1, 17) for n in (2**k - 1, 2**k, 2**k + 1))
_BASES = tuple(b**k for b in (3, 5, 7) for k in range(1, 11) if b**k < 2**17)
_LENGTHS = (1, 3, 16, 100, 1000, *_POWERS, *_BASES)
_ALL_LENGTHS = range(1, 1025)
_SEEDS = 4096
_CALLS, _QUICK_CALLS = 4096, 512
"""A sampler that changes after so many calls is found."""
_DIMS = (1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 17, 24, 32, 33, 64)
_DIMS_COUNTS = (1, 2, 3, 16, 64, 97, 100, 256, 1000, 4096, 2**13, 2**16)


@conformance_check("determinism", 3)
def check_determinism(subject: SamplerSubject) -> None:
    """The points are the same, bit for bit, again, in another order, in chunks, in another thread and process."""
    dims = subject.dims(3)
    for count in subject.counts(1, 7, 64, 100, dims=dims):
        _judge_repeated_requests(subject, count, dims)
    _judge_many_calls(subject, dims)
    if not subject.quick:
        judge_elsewhere(subject, subject.recipe, "in another process")


def _judge_many_calls(subject: SamplerSubject, dims: int) -> None:
    """Raise if the points change after thousands of calls: a cache that fills up, a counter that runs over."""
    (count,) = subject.counts(16, dims=dims)
    asked = subject.sampler.trials(0, _REALIZATIONS, 0)
    whole = subject.fill(asked, count, dims)
    wanted = _QUICK_CALLS if subject.quick else _CALLS
    calls = subject.affordable(wanted, count, dims)
    for call in range(calls):
        subject.fill(asked[call % _REALIZATIONS :][:1], count, dims)
    judge_equal(subject, whole, subject.fill(asked, count, dims), count, f"after {calls} more calls")


def _judge_repeated_requests(subject: SamplerSubject, count: int, dims: int) -> None:
    asked = subject.sampler.trials(0, _REALIZATIONS, 0)
    whole = subject.fill(asked, count, dims)
    judge_equal(subject, whole, subject.fill(asked, count, dims), count, "when asked again")
    for other in subject.counts(count + 1, 2 * count, dims=dims):
        subject.sets(other, dims, 3, seed=9, first=5)
    subject.sets(subject.counts(count, dims=subject.dims(1))[0], subject.dims(1), 2, seed=1)
    judge_equal(subject, whole, subject.fill(asked, count, dims), count, "after other requests")
    fresh = subject.fill(asked, count, dims, sampler=configured_sampler(subject.recipe))
    judge_equal(subject, whole, fresh, count, "from a fresh sampler")
    reverse = subject.fill(asked[::-1], count, dims)[::-1]
    judge_equal(subject, whole, reverse, count, "with the realisations in reverse order")
    for chunk in (1, 7, 64):
        pieces = [subject.fill(asked[i : i + chunk], count, dims) for i in range(0, _REALIZATIONS, chunk)]
        judge_equal(subject, whole, np.concatenate(pieces), count, f"in chunks of {chunk} realisations")
    with ThreadPoolExecutor(1) as thread:
        in_a_thread = thread.submit(subject.fill, asked, count, dims).result()
    judge_equal(subject, whole, in_a_thread, count, "in another thread")
    if not (asked.keys == subject.sampler.trials(0, _REALIZATIONS, 0).keys).all():
        raise CheckFailed("changes the keys of the realisations that it was given")


@conformance_check("seed", 4)
def check_seed(subject: SamplerSubject) -> None:
    """Another seed gives other points if the sampler is declared randomised, the same points if it is not."""
    dims = subject.dims(2)
    count = subject.counts(16, dims=dims)[0]
    seeds = sorted({abs(2**k + i) for k in range(64) for i in (-1, 0, 1)} | {2**64 - 1})
    if subject.spec.period is not None or not subject.spec.randomized:
        # Sets of a bank come back by chance.
        seeds = [0, 1, 2, 2**31, 2**32, 2**32 + 1, 2**53, 2**53 + 1, 2**63, 2**64 - 1]
    elif not subject.quick and not subject.slow:
        # Seeds that are reduced to 20 bits or fewer, or modulo a million, have the same sets by chance.
        seeds += np.random.default_rng(4).integers(2**64, size=_SEEDS, dtype=np.uint64).tolist()
    made = {seed: subject.sets(count, dims, 2, seed=seed) for seed in seeds}
    if not subject.spec.randomized:
        undeclared = "though it is declared not randomised"
        for seed in seeds:
            judge_equal(subject, made[0], made[seed], count, f"with seed {seed}, {undeclared}")
        judge_equal(subject, made[0][:1], made[0][1:], count, f"in realisation 1, {undeclared}")
        return
    for one, other in repeated(sets[0] for sets in made.values()):
        first, second = seeds[one], seeds[other]
        raise CheckFailed(
            f"seeds {first} and {second} give the same points, though it is declared randomised",
            subject.example(made[first], count, seed=first, indices=(0,)),
        )


@conformance_check("prefix", 5)
def check_prefix(subject: SamplerSubject) -> None:
    """The first N of M points are the set of N points, for every N at which prefixes are declared to be sets."""
    progressive = subject.spec.progressive
    if progressive is None:
        raise NotApplicable("it is not declared progressive")
    dims = subject.dims(3)
    largest = min(subject.largest_count, 2**12 if subject.quick else 2**17)
    lengths = {*_LENGTHS, *spread_counts(largest, 1), *(_ALL_LENGTHS if subject.sampler.streams else ())}
    right = [n for n in sorted(lengths) if n <= largest and subject.allows(n, dims) and progressive.allows(n, dims)]
    for length in right[:: 3 if subject.quick else 1]:
        short = subject.sets(length, dims, 2)
        for count in sorted({length + 1, 2 * length, 2 * length + 1, 1000, 4096, largest, 2**20}):
            if count > length and subject.allows(count, dims) and (count <= largest or subject.sampler.streams):
                # Of a sampler that makes parts of sets only the prefix is made.
                long = subject.fill(subject.sampler.trials(0, 2, 0), count, dims, 0, length)
                judge_equal(subject, short, long, length, f"as a prefix of {count} points")


@conformance_check("dimension-prefix", 21)
def check_dimension_prefix(subject: SamplerSubject) -> None:
    """The first dimensions of a set are the same, whatever number of dimensions is asked for."""
    least, most = subject.spec.dimensions
    if least == most:
        raise NotApplicable("its number of dimensions is fixed")
    if not subject.spec.extensible_dims:
        raise NotApplicable("it is declared with extensible_dims=False")
    dims = sorted({subject.dims(wanted) for wanted in (*_DIMS, least + 1, *([most] if most and most <= 256 else []))})
    if subject.spec.counts.depends_on_dims:
        dims = [each for each in dims if each <= subject.most_dims(each)]
    counts = {count for each in dims[:3] for count in subject.counts(*_DIMS_COUNTS, dims=each)}
    for count in sorted(counts)[:: 2 if subject.quick else 1]:
        made = [each for each in dims if (each <= 9 or count <= 1000) and subject.allows(count, each)]
        made = [each for each in made if subject.makes(count, each)]
        for fewer, more in itertools.pairwise(made):
            first = subject.sets(count, more, 2)[:, :fewer]
            when = f"with {more} dimensions in place of {fewer}, though it is declared with extensible_dims=True"
            judge_equal(subject, subject.sets(count, fewer, 2), first, count, when)


@conformance_check("slices", 6)
def check_slices(subject: SamplerSubject) -> None:
    """Points start to stop are that slice of the whole set."""
    dims = subject.dims(3)
    realizations = subject.sampler.trials(0, 3, 0)
    wanted = [7, 64, 100]
    if not subject.quick:
        wanted += [1500, 2100, *([2**13 + 1, 2**16 + 1, 2**17] if subject.sampler.streams else [])]
    for count in subject.counts(*wanted, dims=dims):
        whole = subject.fill(realizations, count, dims)
        for start, stop in _slices(count, many=subject.sampler.streams):
            part = subject.fill(realizations, count, dims, start, stop - start)
            where = f"in the slice {start}:{stop}"
            judge_equal(subject, whole[:, :, start:stop], part, count, where, start=start)


def _slices(count: int, *, many: bool) -> list[tuple[int, int]]:
    """Return slices at both ends, in the middle, of one point, and across the blocks in which images are made.

    ``many``: also slices at large powers of two, and cuts that nobody would choose, the same in every run.
    """
    middle = count // 2
    wanted = [(0, 1), (0, count - 1), (1, count), (1, 2), (middle, middle + 1), (middle, count), (count - 1, count)]
    wanted += [(3, 19), (63, 65), (1000, 1025), (1024, count)]
    if many:
        wanted += [(place, place + length) for place in (4095, 2**13 - 3, 2**16 - 5) for length in (1, 2, 7, 1024)]
        wanted += np.sort(np.random.default_rng(count).integers(0, count + 1, (16, 2)), axis=1).tolist()
    return sorted({(start, stop) for start, stop in wanted if 0 <= start < stop <= count})
