"""Prefixes of a progressive sampler are sets of their own; a slice of a set is that part of it."""

from __future__ import annotations

from samplekit._bases.realizations import Realizations
from samplekit.testing._judge import judge_equal
from samplekit.testing._result import NotApplicable, conformance_check
from samplekit.testing._subject import SamplerSubject

_POWERS = tuple(n for k in range(1, 13) for n in (2**k - 1, 2**k, 2**k + 1))
_BASES = tuple(b**k for b in (3, 5, 7) for k in range(1, 8) if b**k < 5000)
_LENGTHS = (1, 3, 16, 100, 1000, *_POWERS, *_BASES)


@conformance_check("prefix", 5)
def check_prefix(subject: SamplerSubject) -> None:
    """The first N of M points are the set of N points, for every N at which prefixes are declared to be sets."""
    good = subject.spec.progressive
    if good is None:
        raise NotApplicable("it is not declared progressive")
    dims = subject.dims(3)
    lengths = [count for count in sorted(set(_LENGTHS)) if subject.allows(count, dims) and good.allows(count, dims)]
    for length in lengths[:: 3 if subject.quick else 1]:
        short = subject.sets(length, dims, 2)
        for count in sorted({length + 1, 2 * length, 2 * length + 1, 1000, 4096}):
            if count > length and subject.allows(count, dims):
                long = subject.sets(count, dims, 2)
                judge_equal(subject, short, long[:, :, :length], length, f"as a prefix of {count} points")


@conformance_check("slices", 6)
def check_slices(subject: SamplerSubject) -> None:
    """Points start to stop are that slice of the whole set."""
    dims = subject.dims(3)
    realizations = Realizations.of_trials(0, 3, 0)
    for wanted in (7, 64, 100) if subject.quick else (7, 64, 100, 1500, 2100):
        count = subject.counts(wanted, dims=dims)[0]
        whole = subject.fill(realizations, count, dims)
        for start, stop in _slices(count):
            part = subject.fill(realizations, count, dims, start, stop - start)
            where = f"in the slice {start}:{stop}"
            judge_equal(subject, whole[:, :, start:stop], part, count, where, start=start)


def _slices(count: int) -> list[tuple[int, int]]:
    """Return slices at both ends, in the middle, of one point, and across the blocks in which images are made."""
    middle = count // 2
    wanted = [(0, 1), (0, count - 1), (1, count), (1, 2), (middle, middle + 1), (middle, count), (count - 1, count)]
    wanted += [(3, 19), (63, 65), (1000, 1025), (1024, count)]
    return sorted({(start, stop) for start, stop in wanted if 0 <= start < stop <= count})
