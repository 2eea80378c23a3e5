"""Joint uniformity: intervals of one dimension, and cells of two to four, hold their shares of all points.

All points of many sets are counted in cells. Points of one set depend on each other, so sets are put together in
groups, which are independent, and means over groups are judged. Every quantity is a linear function of the counts whose
mean is zero for uniform points: counts of intervals from one half to 1/1024, counts of cells, and Fourier and Walsh
coefficients of the counts, which see a bias of three dimensions that no pair of them has.

Cells of many dimensions together would be too many. There, one point is taken of each of many sets, and the means of
waves of sums and differences of coordinates are judged.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from samplekit.testing._checks.uniformity import one_point_a_set
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import CHECK_RATE, normal_threshold, student_threshold
from samplekit.testing._subject import Array, SamplerSubject

SIDES = {1: 1024, 2: 32, 3: 8, 4: 4}
"""Cells along each axis, by the number of dimensions that are judged together."""
_DIMS, _MIXED_DIMS = 4, 6
_COUNTS, _QUICK_COUNTS = (1, 4, 16, 64, 100, 256, 1000, 1024, 4096, 1 << 14), (16, 256)
_MOST_MIXED, _MOST_WHOLE = 1 << 12, 256
_POINTS, _QUICK_POINTS = 1 << 23, 1 << 19
_GROUPS, _QUICK_GROUPS = 512, 128
_TESTS = 1_000_000
"""More than the number of tests in all.

39 000 for each of ten counts in four dimensions, 9000 in two and 20 000 in three for each of five, 112 000 in six for
each of three kinds of blocks, at most 1400 of places in intervals for each of thirty, and 100 000 waves.
"""
_FINE_SIDES = {1: 8, 2: 8}
_FINE = 2.0**20
_VIEWED = (1, 16, 100, 256, 4096)
"""Counts at which the places within small parts of an axis are judged, too."""
_BLOCKS = ((2, 2, 2), (2, 1, 2, 1))
"""Blocks of dimensions, cut to fit: scenes have such."""
_WAVE_SETS, _QUICK_WAVE_SETS, _WAVE_COUNT, _MOST_WAVE_COUNT = 1 << 15, 1 << 12, 16, 512
_LARGE_WAVE_SETS, _LARGE_WAVE_COUNTS = 1 << 14, (1 << 17, 10**6)
_WAVE_DIMS = {1: 64, 2: 16, 3: 16, 4: 8, 5: 8}
"""Most dimensions of which so many are taken together."""
_PER_CELL, _SAMPLES = 512, 16
"""Sets that have a point in a cell, at least: counts of so many are nearly normal. It is found from a few sets."""
_LEAST = 0.25
"""The same in each group: points of few large sets that share a coordinate would make a mean of groups uncertain."""


@conformance_check("joint-uniformity", 23)
def check_joint_uniformity(subject: SamplerSubject) -> None:
    """Intervals, and cells of two, three and four dimensions, hold their shares at many counts, by t-tests."""
    if not (subject.spec.randomized and subject.spec.unbiased):
        raise NotApplicable("it is not declared random and unbiased")
    groups = _QUICK_GROUPS if subject.quick else _GROUPS
    if subject.sampler.streams:
        dims = subject.most_dims(_DIMS if subject.quick else _MIXED_DIMS)
        exponents = np.random.default_rng(12).random(groups)
        mixed = [subject.counts(int(_MOST_MIXED**exponent), dims=dims)[0] for exponent in exponents]
        what = f"sets of {min(mixed)} to {max(mixed)} points"
        _judge(subject, dims, mixed, what)
        for blocks in (_cut(each, dims) for each in _BLOCKS):
            if _differs(subject, mixed, dims, blocks):
                _judge(subject, dims, mixed, f"{what} with blocks of {', '.join(map(str, blocks))} dimensions", blocks)
    dims = subject.most_dims(_DIMS)
    # A sampler that makes sets as a whole may prepare each count for long.
    wanted = [count for count in _COUNTS if count <= _MOST_WHOLE or (subject.sampler.streams and not subject.slow)]
    # In another number of dimensions there may be another set.
    for fewer in sorted({dims} | (set() if subject.spec.extensible_dims else {subject.dims(2), subject.dims(3)})):
        chosen = _QUICK_COUNTS if subject.quick else wanted if fewer == dims else [n for n in wanted if n in _VIEWED]
        for count in subject.counts(*chosen, dims=fewer):
            _judge(subject, fewer, [count] * groups, f"sets of {count} points")
    least, most = subject.dims(1), _wave_dims(subject)
    numbers = (
        {most} if subject.spec.extensible_dims else {d for d in range(least, most + 1) if d <= 9 or d in (16, most)}
    )
    for dims in sorted(numbers):
        (count,) = subject.counts(_WAVE_COUNT, dims=dims)
        sets = subject.affordable(_QUICK_WAVE_SETS if subject.quick else _WAVE_SETS, count, dims, least=1 << 10)
        _judge_waves(subject, one_point_a_set(subject, sets, count, dims), count)
    if subject.sampler.streams and not subject.slow:
        for count in subject.counts(*_LARGE_WAVE_COUNTS[: 1 if subject.quick else None], dims=most):
            sets = _QUICK_WAVE_SETS if subject.quick else _LARGE_WAVE_SETS
            starts = np.random.default_rng(count).integers(count, size=sets).tolist()
            points = [
                subject.fill(subject.sampler.trials(i, i + 1, 0), count, most, start, 1)
                for i, start in enumerate(starts)
            ]
            _judge_waves(subject, np.concatenate(points)[:, :, 0].T, count)


def _wave_dims(subject: SamplerSubject) -> int:
    """Return the most dimensions, up to 64, that it makes of few points: a grid in many dimensions is large."""
    tried = [subject.most_dims(2**k) for k in range(6, -1, -1)]
    return next((d for d in tried if subject.counts(_WAVE_COUNT, dims=d)[0] <= _MOST_WAVE_COUNT), tried[-1])


def _judge_waves(subject: SamplerSubject, points: Array, count: int) -> None:
    """Judge sums and differences of up to five of many dimensions, modulo 1, and products of their halves' signs.

    The points float64[D, R] are one of each of R sets. These are independent, so the square of a mean of R waves is
    1 / R on average, and exceeds t / R with probability exp(-t).
    """
    dims, sets = points.shape
    waves, signs = np.exp(2j * math.pi * points), np.where(points < 0.5, 1.0, -1.0)
    limits = -math.log(CHECK_RATE / _TESTS), normal_threshold(_TESTS) ** 2
    for number, most in _WAVE_DIMS.items():
        for axes in itertools.combinations(range(min(dims, most)), number):
            of_waves = waves[axes[0]][None]
            for axis in axes[1:]:
                of_waves = np.concatenate([of_waves * waves[axis], of_waves * waves[axis].conj()])
            of_signs = np.prod(signs[list(axes)], axis=0)[None]
            for values, limit, what in zip((of_waves, of_signs), limits, ("wave", "product of signs"), strict=True):
                square = float((np.abs(values.mean(axis=1)) ** 2).max())
                if square * sets > limit:
                    raise CheckFailed(
                        f"a {what} of {_dimensions(axes)} has a mean of {math.sqrt(square):.3g} over one point of each"
                        f" of {sets} sets of {count} points: at most {math.sqrt(limit / sets):.2g} expected",
                        subject.request(count, dims, axes=axes),
                    )


def _judge(subject: SamplerSubject, dims: int, counts: list[int], what: str, blocks: tuple[int, ...] = ()) -> None:
    """Judge groups of sets, one of each of the counts."""
    wanted = (_QUICK_POINTS if subject.quick else _POINTS) // len(counts)
    largest = max(counts)
    most = subject.affordable(max(len(counts), len(counts) * wanted // largest), largest, dims, share=2.0)
    counts = counts[:most]
    each = max(1, most // len(counts)) * largest
    totals: dict[tuple[str, tuple[int, ...]], list[NDArray[np.int64]]] = {}
    sets = [max(1, min(wanted, each) // count) for count in counts]
    sizes = np.multiply(sets, counts)
    total = int(sizes.sum())
    sides = _judged_sides(subject, counts, sets, dims)
    first = 0
    for count, number in zip(counts, sets, strict=True):
        points = subject.fill(subject.sampler.trials(first, first + number, 0, blocks), count, dims)
        first += number
        for view, seen in _views(points.transpose(1, 0, 2).reshape(dims, -1), count):
            if view not in sides:
                continue
            for axes, held in held_in_cells(seen, sides[view]):
                totals.setdefault((view, axes), []).append(held)
    threshold = student_threshold(_TESTS, len(counts) - 1)
    for (view, axes), counted in totals.items():
        side, number = sides[view][len(axes)], len(axes)
        excess = (np.array(counted) / sizes[:, None] * side**number - 1.0).reshape(-1, *[side] * number)
        for name, shape, values in _functionals(excess):
            flat = values.reshape(len(values), -1)
            mean, error = flat.mean(axis=0), flat.std(axis=0, ddof=1) / math.sqrt(len(values))
            # Where strata meet the edge of a cell, the number of its points may differ by one, and so rarely that no
            # group shows it: so many points may be missing in all, from a Poisson law.
            rare = -math.log(CHECK_RATE / _TESTS) / total * (math.prod(shape) if name.startswith("density") else 1)
            most = np.maximum(threshold * error, rare)
            wrong = np.abs(mean) > most
            if wrong.any():
                worst = int(np.argmax(wrong * np.abs(mean) / np.maximum(error, rare)))
                place = ", ".join(str(int(each)) for each in np.unravel_index(worst, shape))
                grid = " x ".join(map(str, shape))
                raise CheckFailed(
                    f"{name} ({place}) of {grid} of {view}{_dimensions(axes)} is off by {mean[worst]:.3g}, relative to"
                    f" a uniform density: at most {most[worst]:.2g} expected of {total} points in {what}",
                    subject.request(counts[0], dims, axes=axes),
                )


def _viewed(subject: SamplerSubject, dims: int) -> list[int]:
    return subject.counts(*_VIEWED, dims=dims)


def _differs(subject: SamplerSubject, counts: list[int], dims: int, blocks: tuple[int, ...]) -> bool:
    """Tell whether sets are made of these counts, and others than without blocks; most samplers ignore blocks."""
    if not all(subject.makes(count, dims, blocks) for count in counts):
        return False
    with_blocks, without = (
        subject.fill(subject.sampler.trials(0, 4, 0, each), max(counts), dims) for each in (blocks, ())
    )
    return not np.array_equal(with_blocks, without)


def _cut(blocks: tuple[int, ...], dims: int) -> tuple[int, ...]:
    """Return blocks that have as many dimensions together as there are."""
    ends = [min(end, dims) for end in itertools.accumulate(blocks)]
    return tuple(size for size in np.diff(ends, prepend=0).tolist() if size)


def _views(points: Array, count: int) -> Iterator[tuple[str, Array]]:
    """Yield the points float64[D, M], and their places in the 1 / count, and in 2^-20, of an axis that they lie in.

    A point that is uniform in the unit cube has uniform and independent places, too. The first are those in strata, and
    the second show how many binary digits are random.
    """
    yield "", points
    yield "places in 1 / count of ", points * count % 1.0
    yield "places in 2^-20 of ", points * _FINE % 1.0


def _judged_sides(subject: SamplerSubject, counts: list[int], sets: list[int], dims: int) -> dict[str, dict[int, int]]:
    """Return for each view the cells along each axis by the number of dimensions: as many as leave enough sets a cell.

    Many points of a set may share a coordinate, or lie in few cells, so points are no measure of what is known.
    """
    chosen = range(0, len(counts), -(-len(counts) // _SAMPLES))
    samples: dict[str, list[tuple[Array, int]]] = {}
    for i in chosen:
        points = subject.fill(subject.sampler.trials(i, i + 1, 0), counts[i], dims)[0]
        for view, seen in _views(points, counts[i]):
            samples.setdefault(view, []).append((seen, sets[i]))
    sides: dict[str, dict[int, int]] = {}
    for view, sample in samples.items():
        if view and (len(set(counts)) > 1 or counts[0] not in _viewed(subject, dims)):
            # Points of a set may share their place: groups of fewer and larger sets would be far less certain.
            continue
        sides[view] = {}
        for number, most in list((_FINE_SIDES if view else SIDES).items())[:dims]:
            side = most
            while side > 1:
                average, least = _sets_in_a_cell(sample, number, side)
                if average * len(counts) >= _PER_CELL and least >= _LEAST:
                    break
                side //= 2
            if side > 1:
                sides[view][number] = side
    return sides


def _sets_in_a_cell(sample: list[tuple[Array, int]], number: int, side: int) -> tuple[float, float]:
    """Return how many sets of a group have a point in a cell: on average over the groups of the sample, and at least.

    The least over all choices of ``number`` dimensions. Each set of the sample stands for as many others.
    """
    found: dict[tuple[int, ...], list[float]] = {}
    for points, sets in sample:
        for axes, held in held_in_cells(points, {number: side}):
            found.setdefault(axes, []).append(sets * float((held > 0).mean()))
    return min(sum(each) for each in found.values()) / len(sample), min(min(each) for each in found.values())


def held_in_cells(points: Array, sides: Mapping[int, int]) -> Iterator[tuple[tuple[int, ...], NDArray[np.int64]]]:
    """Yield the axes, and the numbers of the points float64[D, M] in the cells, of one to four dimensions together."""
    finest = max(sides.values(), default=1)
    cells = np.clip((points * finest).astype(np.int64), 0, finest - 1)
    for number, side in sides.items():
        coarse = cells // (finest // side)
        for axes in itertools.combinations(range(len(points)), number):
            place = coarse[axes[0]]
            for axis in axes[1:]:
                place = place * side + coarse[axis]
            yield axes, np.bincount(place, minlength=side**number)


def _functionals(excess: Array) -> Iterator[tuple[str, tuple[int, ...], Array]]:
    """Yield each kind of quantity: its name, the shape of its numbers, and its values float64[G, ...]."""
    groups, *sides = excess.shape
    cells = int(np.prod(sides))
    if len(sides) == 1:
        for level in range(1, cells.bit_length()):
            yield "density of interval", (2**level,), excess.reshape(groups, 2**level, -1).mean(axis=2)
    else:
        yield "density of cell", tuple(sides), excess
        yield "Walsh coefficient", tuple(sides), walsh(excess) / cells
    coefficients = np.fft.rfftn(excess, axes=tuple(range(1, excess.ndim))) / cells
    yield "cosine coefficient", coefficients.shape[1:], coefficients.real
    yield "sine coefficient", coefficients.shape[1:], coefficients.imag


def walsh(held: Array) -> Array:
    """Return the Walsh transform, in Hadamard's order, along all axes but the first."""
    matrix = np.ones((1, 1))
    while len(matrix) < held.shape[1]:
        matrix = np.block([[matrix, matrix], [matrix, -matrix]])
    for axis in range(1, held.ndim):
        held = np.moveaxis(np.tensordot(held, matrix, (axis, 0)), -1, axis)
    return held


def _dimensions(axes: tuple[int, ...]) -> str:
    return f"dimension{'s' if len(axes) > 1 else ''} {', '.join(map(str, axes))}"
