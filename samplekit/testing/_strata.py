"""Strata: one point in each of N intervals (Latin), in each cell of a grid, in each of pairs (orthogonal arrays)."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from samplekit._specs import GridStrata, LatinStrata, OrthogonalArray
from samplekit.testing._cells import cell_of
from samplekit.testing._declared import grids
from samplekit.testing._elsewhere import forced_extremes
from samplekit.testing._result import CheckFailed, NotApplicable, check

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit._specs import Promise, SamplerSpec
    from samplekit.testing._subject import Subject

COUNTS = (1, 2, 3, 4, 5, 6, 7, 9, 12, 16, 25, 49, 64, 96, 97, 100, 121, 256, 1000, 1024, 2025, 4096)
_QUICK_COUNTS = (1, 2, 3, 4, 7, 12, 25, 64, 97, 1000)
_SEEDS = (0, 1)
_MOST_TUPLES = 120

Grid = tuple[tuple[int, ...], tuple[int, ...]]
"""Axes, and the number of cells along each."""


def _promises_strata(spec: SamplerSpec) -> str:
    kinds = (LatinStrata, GridStrata, OrthogonalArray)
    return "" if any(isinstance(promise, kinds) for promise in spec.promises) else "it promises no strata"


def promised_grids(promise: Promise, count: int, dims: int) -> Iterator[list[Grid]]:
    """Grids of which each cell is promised to hold one point: lists of which one grid suffices, as they tie."""
    if isinstance(promise, LatinStrata):
        for axis in range(dims) if promise.dims is None else promise.dims:
            if axis < dims:
                yield [((axis,), (count,))]
    elif isinstance(promise, GridStrata):
        block = promise.block or dims
        for first in range(0, dims - block + 1, block):
            axes = tuple(range(first, first + block))
            yield [(axes, sides) for sides in grids(count, block)]
    elif isinstance(promise, OrthogonalArray):
        strength = promise.strength
        side = round(count ** (1 / strength))
        if side**strength == count and dims >= strength:
            for axes in itertools.islice(itertools.combinations(range(dims), strength), _MOST_TUPLES):
                yield [(axes, (side,) * strength)]


def broken_cell(points: NDArray[np.float64], grid: Grid) -> tuple[int, tuple[int, ...], NDArray[np.bool_]] | None:
    """The first set of ``points`` float64[R, D, N] with a cell that does not hold one point.

    Returns
    -------
    The set, the cell along each axis, and which points are in it, bool[N]; the fullest cell of the set.
    """
    axes, sides = grid
    sets, _, count = points.shape
    boxes = np.zeros((sets, count), np.int64)
    total = 1
    for axis, side in zip(axes, sides, strict=True):
        boxes = boxes * side + cell_of(points[:, axis], side)
        total *= side
    held = np.bincount((boxes + np.arange(sets)[:, None] * total).ravel(), minlength=sets * total).reshape(sets, total)
    wrong = (held != 1).any(axis=1)
    if not wrong.any():
        return None
    row = int(wrong.argmax())
    box = int(held[row].argmax())
    cell = tuple(int(c) for c in np.unravel_index(box, sides))
    return row, cell, boxes[row] == box


def judge_strata(
    subject: Subject, promise: Promise, values: NDArray[np.float64], count: int, seed: int = 0, when: str = ""
) -> int:
    """Raise unless every promised cell of ``values`` float64[R, D, N] holds one point; gives the number of grids."""
    judged = 0
    for ties in promised_grids(promise, count, values.shape[1]):
        found = [broken_cell(values, grid) for grid in ties]
        judged += 1
        if not found or any(each is None for each in found):
            continue
        assert found[0] is not None
        (axes, sides), (row, cell, inside) = ties[0], found[0]
        box = " x ".join(f"[{c}/{side}, {c + 1}/{side})" for c, side in zip(cell, sides, strict=True))
        raise CheckFailed(
            f"the cell {box} of dimensions {', '.join(map(str, axes))} holds {int(inside.sum())} points, expected 1;"
            f" {_empty(values[row], ties[0])} of {count} cells are empty ({promise.keyword} strata){when}",
            subject.example(
                values,
                count,
                seed=seed,
                row=row,
                axes=axes,
                box=tuple((c / side, (c + 1) / side) for c, side in zip(cell, sides, strict=True)),
                indices=tuple(int(i) for i in np.flatnonzero(inside)),
            ),
        )
    return judged


def _empty(points: NDArray[np.float64], grid: Grid) -> int:
    axes, sides = grid
    cells = np.stack([cell_of(points[axis], side) for axis, side in zip(axes, sides, strict=True)])
    total = int(np.prod(sides))
    return total - int(np.unique(np.ravel_multi_index(tuple(cells), sides)).size)


@check("strata", 8, requires=_promises_strata)
def check_strata(subject: Subject) -> None:
    """Every promised interval and cell holds exactly one point, in every set."""
    spec = subject.spec
    judged = 0
    for promise in spec.promises:
        for dims in sorted({subject.dims(d) for d in (1, 2, 3, 5)}):
            counts = subject.counts(*(_QUICK_COUNTS if subject.quick else COUNTS), dims=dims)
            for count in counts:
                if next(promised_grids(promise, count, dims), None) is None:
                    continue
                wanted = 1 if not spec.randomized else 64 if count <= 100 else 4
                realizations = wanted if wanted == 1 else subject.affordable(wanted, count, dims, least=4)
                for seed in _SEEDS if spec.randomized else (0,):
                    judged += judge_strata(subject, promise, subject.sets(count, dims, realizations, seed=seed), count)
    if not judged:
        raise NotApplicable("no count that it makes has the promised strata")
    if not subject.quick:
        for extreme in forced_extremes(subject):
            for promise in spec.promises:
                when = f" with random bits all {extreme.pattern}"
                judge_strata(subject, promise, extreme.values, extreme.count, when=when)
