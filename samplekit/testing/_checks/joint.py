"""Joint uniformity: intervals of one dimension, and cells of two to four, hold their shares of all points.

All points of many sets are counted in cells. Points of one set depend on each other, so sets are put together in groups,
and what is judged are means over groups, which are independent. Every quantity is a linear function of the counts whose
mean is zero for uniform points: counts of intervals from one half to 1/1024, counts of cells, and Fourier and Walsh
coefficients of the counts, which see a bias of three dimensions that no pair of them has.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import student_threshold
from samplekit.testing._subject import Array, SamplerSubject

SIDES = {1: 1024, 2: 32, 3: 8, 4: 4}
"""Cells along each axis, by the number of dimensions that are judged together."""
_DIMS, _MIXED_DIMS = 4, 6
_COUNTS, _QUICK_COUNTS = (1, 4, 16, 64, 100, 256, 1024, 4096, 1 << 14), (16, 256)
_MOST_MIXED = 1 << 12
_POINTS, _QUICK_POINTS = 1 << 23, 1 << 19
_GROUPS, _QUICK_GROUPS = 512, 128
_TESTS = 500_000
"""More than the number of tests in all: 34 000 for each of nine counts in four dimensions, 116 000 in six."""
_ROUNDING = 1e-9


@conformance_check("joint-uniformity", 23)
def check_joint_uniformity(subject: SamplerSubject) -> None:
    """Intervals, and cells of two, three and four dimensions, hold their shares at many counts, by t-tests."""
    if not (subject.spec.randomized and subject.spec.unbiased):
        raise NotApplicable("it is not declared random and unbiased")
    groups = _QUICK_GROUPS if subject.quick else _GROUPS
    dims = subject.most_dims(_DIMS)
    for count in subject.counts(*(_QUICK_COUNTS if subject.quick else _COUNTS), dims=dims):
        _judge(subject, dims, [count] * groups, f"sets of {count} points")
    if subject.sampler.streams:
        dims = subject.most_dims(_DIMS if subject.quick else _MIXED_DIMS)
        exponents = np.random.default_rng(12).random(groups)
        counts = [subject.counts(int(_MOST_MIXED**exponent), dims=dims)[0] for exponent in exponents]
        _judge(subject, dims, counts, f"sets of {min(counts)} to {max(counts)} points")


def _judge(subject: SamplerSubject, dims: int, counts: list[int], what: str) -> None:
    """Judge groups of sets, one of each of the counts."""
    wanted = (_QUICK_POINTS if subject.quick else _POINTS) // len(counts)
    largest = max(counts)
    most = subject.affordable(max(len(counts), len(counts) * wanted // largest), largest, dims, share=4.0)
    counts = counts[:most]
    each = max(1, most // len(counts)) * largest
    totals: dict[tuple[int, ...], list[NDArray[np.int64]]] = {}
    first = 0
    sizes = []
    for count in counts:
        sets = max(1, min(wanted, each) // count)
        points = subject.fill(subject.independent(first, first + sets), count, dims)
        first, size = first + sets, sets * count
        sizes.append(size)
        for axes, held in held_in_cells(points.transpose(1, 0, 2).reshape(dims, size)):
            totals.setdefault(axes, []).append(held)
    threshold = student_threshold(_TESTS, len(counts) - 1)
    for axes, held in totals.items():
        cells = SIDES[len(axes)] ** len(axes)
        excess = (np.array(held) / np.array(sizes)[:, None] * cells - 1.0).reshape(-1, *[SIDES[len(axes)]] * len(axes))
        for name, values in _functionals(excess):
            mean = values.mean(axis=0)
            error = values.std(axis=0, ddof=1) / np.sqrt(len(values))
            # A quantity that is the same in every group is exact, up to rounding.
            wrong = np.abs(mean) > np.maximum(threshold * error, _ROUNDING)
            if wrong.any():
                worst = int(np.argmax(np.where(wrong, np.abs(mean) / np.maximum(error, _ROUNDING), 0.0)))
                raise CheckFailed(
                    f"{name(worst)} of {_dimensions(axes)} is {mean[worst]:.3g} relative to a uniform density, expected 0"
                    f" within {threshold * error[worst]:.2g} ({sum(sizes)} points in {what})",
                    subject.request(counts[0], dims, axes=axes),
                )


def held_in_cells(points: Array) -> Iterator[tuple[tuple[int, ...], NDArray[np.int64]]]:
    """Yield the axes, and the numbers of the points float64[D, M] in the cells, of up to four dimensions together."""
    finest = SIDES[1]
    cells = np.clip((points * finest).astype(np.int64), 0, finest - 1)
    for number, side in list(SIDES.items())[: len(points)]:
        coarse = cells // (finest // side)
        for axes in itertools.combinations(range(len(points)), number):
            place = coarse[axes[0]]
            for axis in axes[1:]:
                place = place * side + coarse[axis]
            yield axes, np.bincount(place, minlength=side**number)


def _functionals(excess: Array) -> Iterator[tuple[Callable[[int], str], Array]]:
    """Yield for each kind of quantity how to name the i-th one, and its values float64[G, number]."""
    groups, *sides = excess.shape
    side = sides[0]
    if len(sides) == 1:
        for level in range(1, side.bit_length()):
            cells = 2**level
            yield lambda i, n=cells: f"the density of [{i}/{n}, {i + 1}/{n})", excess.reshape(groups, cells, -1).mean(2)
    else:
        flat = excess.reshape(groups, -1)
        yield lambda i: f"the density of cell {_place(i, sides)} of {' x '.join(map(str, sides))}", flat
    coefficients = np.fft.rfftn(excess, axes=tuple(range(1, excess.ndim))) / np.prod(sides)
    shape = coefficients.shape[1:]
    for part, values in (("cosine", coefficients.real), ("sine", coefficients.imag)):
        yield lambda i, p=part: f"the {p} coefficient of frequency {_place(i, shape)}", values.reshape(groups, -1)
    if len(sides) > 1:
        yield lambda i: f"the Walsh coefficient {_place(i, sides)}", walsh(excess).reshape(groups, -1) / np.prod(sides)


def walsh(held: Array) -> Array:
    """Return the Walsh transform, in Hadamard's order, along all axes but the first."""
    matrix = np.ones((1, 1))
    while len(matrix) < held.shape[1]:
        matrix = np.block([[matrix, matrix], [matrix, -matrix]])
    for axis in range(1, held.ndim):
        held = np.moveaxis(np.tensordot(held, matrix, (axis, 0)), -1, axis)
    return held


def _place(i: int, shape: list[int] | tuple[int, ...]) -> str:
    return str(tuple(int(each) for each in np.unravel_index(i, tuple(shape))))


def _dimensions(axes: tuple[int, ...]) -> str:
    return f"dimension{'s' if len(axes) > 1 else ''} {', '.join(map(str, axes))}"
