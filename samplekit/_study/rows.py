"""From what the store holds of each cell to the rows of the results and the fits through them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit._study.errors import errors_of, influence, ratio_of
from samplekit._study.fit import fit_line
from samplekit._study.results import Clock, Fit, Interval, LeftOut, Row, Spread, Times
from samplekit._study.theory import theory_of
from samplekit._study.trials import TRIALS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from samplekit._bases.reference import Reference
    from samplekit._study.cells import Cell
    from samplekit._study.errors import Errors
    from samplekit._study.request import Request
    from samplekit._study.store import Store
    from samplekit._study.subjects import Subjects

    Array = NDArray[np.float64]

_TRUSTED = 10.0
"""Times the reference's own error that an rmse must be to tell of the sampler."""
_ROUNDING = 64 * 2.0**-53
"""Relative error that rounding leaves in a mean at most, in practice."""


class Analysis:
    """Rows and fits of a study.

    Parameters
    ----------
    request, cells
        What was asked for, and the rows that there can be.
    store
        What was found.
    machine
        The kind of machine whose times count.
    cost
        Nanoseconds that a sample costs besides.
    fitted
        First and last count that fits use; None: all.
    """

    def __init__(
        self,
        request: Request,
        cells: Sequence[Cell],
        store: Store,
        subjects: Subjects,
        machine: str,
        cost: float,
        fitted: tuple[int, int] | None,
    ) -> None:
        self._request = request
        self._subjects = subjects
        self._store = store
        self._machine = machine
        self._cost = cost
        self._fitted = fitted or (1, max(cell.count for cell in cells))
        self._sums = {cell: store.sums(cell) for cell in cells}
        self.cells = [cell for cell in cells if len(self._sums[cell])]
        self.left_out = [
            LeftOut(*cell.pair, cell.count, "interrupted before its first trial was done")
            for cell in cells
            if not len(self._sums[cell])
        ]
        self.complete = all(sum(self._trials(cell)) == cell.trials for cell in cells)

    def _trials(self, cell: Cell) -> list[int]:
        return [last - first for first, last in self._store.ranges(cell)]

    def rows(self) -> list[Row]:
        """A row for each cell that has trials."""
        return [self._row(cell) for cell in self.cells]

    def fits(self, rows: Sequence[Row]) -> list[Fit]:
        """A fit for each scene and sampler that has two rows to use."""
        fits = []
        for pair in dict.fromkeys(cell.pair for cell in self.cells):
            own = [(cell, row) for cell, row in zip(self.cells, rows, strict=True) if cell.pair == pair]
            used = [(cell, row) for cell, row in own if row.fitted]
            influences = [
                influence(self._sums[cell]) if np.count_nonzero(self._sums[cell][:, TRIALS]) > 1 else None
                for cell, _ in used
            ]
            line = fit_line([row.count for _, row in used], [row.mse.estimate or 0.0 for _, row in used], influences)
            if line is not None:
                counts = [row.count for _, row in used]
                left_out = {row.count: row.left_out for _, row in own if not row.fitted}
                first_last = counts[0], counts[-1]
                fits.append(
                    Fit(
                        *pair, line.slope, line.constant, line.scatter, *first_last, counts, left_out, *theory_of(*pair)
                    )
                )
        return fits

    def _row(self, cell: Cell) -> Row:
        sums = self._sums[cell]
        errors = errors_of(sums, one_pixel=self._request.one_pixel)
        reference = self._subjects.reference(cell.scene, self._request.size)
        samples = self.samples(cell)
        times = self._times(cell)
        time = None if times is None else times.total.cpu.median + self._cost * 1e-9 * samples
        left_out = self._left_out(cell, errors, reference)
        notes = list(cell.notes)
        done = sum(self._trials(cell))
        if done < cell.trials:
            notes.append(f"interrupted: {done} of {cell.trials} trials")
        if errors.mse.estimate == 0.0:
            notes.append("exact: every trial gave the reference to the last bit")
        elif left_out and cell.count >= self._fitted[0] and cell.count <= self._fitted[1]:
            notes.append(left_out)
        if errors.invalid_pixels:
            notes.append(f"{errors.invalid_pixels} pixels of all trials were not finite and are left out")
        row = Row(
            scene=cell.scene,
            sampler=cell.sampler,
            count=cell.count,
            asked=list(cell.asked),
            replaced=cell.replaced,
            dims=cell.dims,
            samples=samples,
            trials=errors.trials,
            mse=errors.mse,
            rmse=errors.rmse,
            bias=errors.bias,
            variance=errors.variance,
            squared_bias=errors.squared_bias,
            blurred_mse=errors.blurred_mse,
            efficiency=_efficiency(errors.mse, time),
            ratio=self._ratio(cell),
            reference_error=reference.error,
            reference_kind=reference.kind,
            invalid_pixels=errors.invalid_pixels,
            times=times,
            time=time,
            fitted=not left_out,
            left_out=left_out,
            notes=notes,
            pictures=None,
        )
        return row if sums[:, TRIALS].any() else replace(row, fitted=False, left_out="no finite error")

    def samples(self, cell: Cell) -> int:
        """Samples of one trial."""
        if self._request.one_pixel:
            return cell.count
        return int(self._subjects.pixels(cell.scene, self._request.size).sampled.size) * cell.count

    def _left_out(self, cell: Cell, errors: Errors, reference: Reference) -> str:
        """Why the fit does not use a row; empty: it does."""
        mse = errors.mse.estimate
        first, last = self._fitted
        if not first <= cell.count <= last:
            return f"outside of the range of the fit, {first} to {last}"
        if mse is None:
            return "no finite error"
        if mse == 0.0:
            return "exact: its logarithm is minus infinity"
        floor = reference.error + _ROUNDING * float(np.nan_to_num(np.abs(reference.image)).max(initial=0.0))
        if math.sqrt(mse) <= _TRUSTED * floor:
            rmse = f"{math.sqrt(mse):.1g}"
            return f"its rmse of {rmse} is not above {_TRUSTED:g} times the reference's own error of {floor:.1g}"
        return ""

    def _ratio(self, cell: Cell) -> Interval | None:
        first = self._request.samplers[0]
        for other in self.cells:
            if (other.scene, other.sampler, other.count) == (cell.scene, first, cell.count):
                return Interval(1.0) if other is cell else ratio_of(self._sums[cell], self._sums[other])
        return None

    def _times(self, cell: Cell) -> Times | None:
        laps = self._store.laps(self._machine, cell)
        if not len(laps):
            return None
        points, scene = (Clock(_spread(laps[:, column]), _spread(laps[:, column + 1])) for column in (0, 2))
        total = Clock(_spread(laps[:, 0] + laps[:, 2]), _spread(laps[:, 1] + laps[:, 3]))
        return Times(points, scene, total, *self._store.setup(self._machine, cell), len(laps))


def _spread(seconds: Array) -> Spread:
    lower, median, upper = (float(value) for value in np.percentile(seconds, [25, 50, 75]))
    return Spread(median, lower, upper)


def _efficiency(mse: Interval, time: float | None) -> Interval | None:
    if not time or not mse.estimate:
        return None
    low, high = (1.0 / (end * time) if end else None for end in (mse.high, mse.low))
    return Interval(1.0 / (mse.estimate * time), low, high)
