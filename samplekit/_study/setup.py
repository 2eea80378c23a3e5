"""What is spent before the first sample: importing, compiling or loading kernels, tables, banks of sets."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._integrate.loop import unit_square

if TYPE_CHECKING:
    from collections.abc import Callable

    from samplekit._study.cells import Cell
    from samplekit._study.subjects import Subjects


def set_up(
    cell: Cell, subjects: Subjects, progress: Callable[[int, int], None] = lambda _, __: None
) -> tuple[float, float]:
    """Make all that a cell's samples need; return the seconds that took, by processor and wall clock.

    What several cells share is made for the first, and counts for each.
    """
    scene, sampler = subjects.scene(cell.scene), subjects.sampler(cell.sampler)
    subjects.prepared(cell.sampler, cell.count, cell.dims, progress)
    tile = np.zeros((1, cell.dims, 1))

    def fill() -> None:
        sampler.fill(np.empty((1, cell.dims, cell.count)), Realizations.of_trials(0, 1, 0, scene.blocks), cell.count, 0)

    def evaluate() -> None:
        scene.sums(tile, unit_square(1), np.empty(1))

    first = {
        ("points", cell.sampler, cell.dims): fill,
        ("scene", cell.scene): evaluate,
    }
    shared = [
        subjects.kept(("setup", *key), lambda call=call: _more_than_again(call))  # type: ignore[misc]
        for key, call in first.items()
    ]
    own = [
        subjects.seconds(("scene", cell.scene)),
        subjects.seconds(("sampler", cell.sampler)),
        subjects.seconds(("prepared", cell.sampler, cell.count, cell.dims)),
    ]
    return sum(cpu for cpu, _ in [*shared, *own]), sum(wall for _, wall in [*shared, *own])


def _more_than_again(call: Callable[[], None]) -> tuple[float, float]:
    """The seconds that a first call takes above a second one."""
    marks = [(time.process_time(), time.perf_counter())]
    for _ in range(2):
        call()
        marks.append((time.process_time(), time.perf_counter()))
    (cpu0, wall0), (cpu1, wall1), (cpu2, wall2) = marks
    return max(0.0, (cpu1 - cpu0) - (cpu2 - cpu1)), max(0.0, (wall1 - wall0) - (wall2 - wall1))
