"""Prefixes of a progressive sampler are sets of their own; a slice of a set is that part of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit.testing._declared import progressive_counts
from samplekit.testing._result import CheckFailed, check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

POWERS = tuple(n for k in range(1, 13) for n in (2**k - 1, 2**k, 2**k + 1))
_BASES = tuple(b**k for b in (3, 5, 7) for k in range(1, 8) if b**k < 5000)
LENGTHS = (1, 3, 16, 100, 1000, *POWERS, *_BASES)


def _declared_progressive(spec: SamplerSpec) -> str:
    return "it is not declared progressive" if spec.progressive is None else ""


def larger_counts(spec: SamplerSpec, length: int, dims: int) -> list[int]:
    """Return some declared counts above ``length``, odd ones among them."""
    wanted = (length + 1, 2 * length, 2 * length + 1, 1000, 4096)
    most = spec.largest_index + 1
    return sorted({count for count in wanted if length < count <= most and spec.counts.allows(count, dims)})


@check("prefix", 5, tolerance="bit for bit", requires=_declared_progressive)
def check_prefix(subject: Subject) -> None:
    """The first N of M points are the set of N points, for every N at which prefixes are declared good."""
    spec = subject.spec
    dims = subject.dims(3)
    lengths = progressive_counts(spec, LENGTHS, dims)
    for length in lengths[:: 3 if subject.quick else 1]:
        short = subject.sets(length, dims, 2)
        for count in larger_counts(spec, length, dims):
            long = subject.sets(count, dims, 2)
            judge_part(subject, short, long[:, :, :length], length, f"as a prefix of {count} points")


@check("slices", 6, tolerance="bit for bit")
def check_slices(subject: Subject) -> None:
    """Points start to stop are that slice of the whole set."""
    dims = subject.dims(3)
    realizations = Realizations.of_trials(0, 3, 0)
    for wanted in (7, 64, 100) if subject.quick else (7, 64, 100, 1500, 2100):
        count = subject.counts(wanted, dims=dims)[0]
        whole = subject.fill(realizations, count, dims)
        for start, stop in slices_of(count):
            part = subject.fill(realizations, count, dims, start, stop - start)
            judge_part(subject, whole[:, :, start:stop], part, count, f"in the slice {start}:{stop}", start)


def slices_of(count: int) -> list[tuple[int, int]]:
    """Slices at both ends, in the middle, of one point, and across the blocks in which images are made."""
    middle = count // 2
    wanted = [(0, 1), (0, count - 1), (1, count), (1, 2), (middle, middle + 1), (middle, count), (count - 1, count)]
    wanted += [(3, 19), (63, 65), (1000, 1025), (1024, count)]
    return sorted({(start, stop) for start, stop in wanted if 0 <= start < stop <= count})


def judge_part(
    subject: Subject,
    expected: NDArray[np.float64],
    found: NDArray[np.float64],
    count: int,
    where: str,
    start: int = 0,
) -> None:
    """Raise unless both float64[R, D, n] are equal bit for bit."""
    different = np.ascontiguousarray(expected).view(np.uint64) != np.ascontiguousarray(found).view(np.uint64)
    if not different.any():
        return
    row, dimension, point = (int(i) for i in np.argwhere(different)[0])
    raise CheckFailed(
        f"point {start + point} of {count} is at {float(expected[row, dimension, point])!r} in dimension {dimension},"
        f" but at {float(found[row, dimension, point])!r} {where}",
        subject.example(expected, count, row=row, start=start, indices=(point,)),
    )
