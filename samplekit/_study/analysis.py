"""The rows of the results and the fits through them, from what the store holds of each combination."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._study.errors import FEW_TRIALS, HEAVY_TAILS, INFINITE_VARIANCE, errors_of, influence, ratio_of
from samplekit._study.fit import fit_line, theoretical_exponent
from samplekit._study.intervals import LEAST_TRIALS, derived_interval
from samplekit._study.results import Fit, Interval, LeftOut, Row, Seconds, Spread, Times
from samplekit._study.timing import falling, typical_seconds
from samplekit._study.trials import SQUARE, TRIALS, Array

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from samplekit._bases.reference import Reference
    from samplekit._study.combinations import Combination
    from samplekit._study.request import ExecutionOptions, Request
    from samplekit._study.resources import Resources
    from samplekit._study.store import Store

_TRUSTED = 10.0
"""An rmse tells something about the sampler only if it is this many times the reference's own error."""
_ROUNDING = 64 * 2.0**-53
"""Relative error that rounding leaves in a mean at most, in practice."""


class Analysis:
    """Rows and fits of a study.

    Parameters
    ----------
    request, options, combinations
        What was asked for, and the rows that there can be.
    store, resources
        The sums and times that were found; the scenes and references.

    Attributes
    ----------
    combinations
        Those that have trials, and so a row.
    left_out
        Those without any trial.
    complete
        Whether all trials were made.
    """

    def __init__(
        self,
        request: Request,
        options: ExecutionOptions,
        combinations: Sequence[Combination],
        store: Store,
        resources: Resources,
    ) -> None:
        self._request = request
        self._resources = resources
        self._store = store
        self._cost = options.cost
        self._fitted = options.fitted or (1, max(combination.count for combination in combinations))
        self._sums = {combination: store.sums(combination) for combination in combinations}
        self._done = {each: sum(last - first for first, last in store.ranges(each)) for each in combinations}
        self.combinations = [each for each in combinations if len(self._sums[each])]
        self.left_out = [
            LeftOut(*each.pair, each.count, "interrupted before its first trial was done")
            for each in combinations
            if not len(self._sums[each])
        ]
        self._seconds = typical_seconds({each: store.laps(each) for each in combinations})
        self._falls = falling(self._seconds)
        self.complete = all(self._done[each] == each.trials for each in combinations)

    def rows(self) -> list[Row]:
        """Return a row for each combination that has trials."""
        errors = {combination: self._errors(combination) for combination in self.combinations}
        return [self._row(combination, errors) for combination in self.combinations]

    def fits(self, rows: Sequence[Row]) -> list[Fit]:
        """Return a fit for each scene and sampler with at least two usable rows.

        Parameters
        ----------
        rows
            From :meth:`rows`.
        """
        fits = []
        for pair in dict.fromkeys(combination.pair for combination in self.combinations):
            all_rows = zip(self.combinations, rows, strict=True)
            own = [(self._sums[each], row) for each, row in all_rows if each.pair == pair]
            used = [(sums, row) for sums, row in own if row.fitted]
            one_pixel = self._sampled(pair[0]) == 1
            influences = [
                influence(sums, one_pixel=one_pixel) if np.count_nonzero(sums[:, TRIALS]) > 1 else None
                for sums, _ in used
            ]
            counts = [row.count for _, row in used]
            line = fit_line(counts, [row.mse.estimate or 0.0 for _, row in used], influences)
            if line is not None:
                left_out = {row.count: row.left_out for _, row in own if not row.fitted}
                slope, constant, scatter = line
                case, theory = theoretical_exponent(*pair)
                ends = counts[0], counts[-1]
                fits.append(Fit(*pair, slope, constant, scatter, *ends, counts, left_out, case, theory))
        return fits

    def _errors(self, combination: Combination) -> dict[str, Any]:
        """Return the errors of a combination by their names in a row."""
        scene, spec = self._resources.scene(combination.scene), self._resources.sampler(combination.sampler).spec
        reference = self._resources.reference(combination.scene, self._request.size)
        largest = None
        if scene.value_range is not None:
            least, most = scene.value_range
            largest = float(max(reference.image.max() - least, most - reference.image.min()))
        return errors_of(
            self._sums[combination],
            one_pixel=self._request.one_pixel,
            sampled=self._sampled(combination.scene),
            random=spec.randomized,
            unbiased=spec.unbiased,
            finite_variance=scene.finite_variance,
            finite_kurtosis=scene.finite_kurtosis,
            floor=_floor(reference),
            largest=largest,
        )

    def _row(self, combination: Combination, errors_of_all: Mapping[Combination, dict[str, Any]]) -> Row:
        errors = errors_of_all[combination]
        reference = self._resources.reference(combination.scene, self._request.size)
        samples = self._samples(combination)
        times = self._times(combination)
        time = None if times is None else _plus(times.seconds, self._cost * 1e-9 * samples)
        mse: Interval = errors["mse"]
        left_out = self._why_left_out(combination, errors["no_interval"], mse.estimate, _floor(reference))
        notes = list(combination.notes)
        if self._done[combination] < combination.trials:
            notes.append(f"interrupted: {self._done[combination]} of {combination.trials} trials")
        if errors["no_interval"]:
            notes.append(self._why_no_interval(combination, errors["no_interval"]))
        elif mse.estimate == 0.0:
            notes.append("exact: every trial gave the reference to the last bit")
        elif left_out and self._fitted[0] <= combination.count <= self._fitted[1]:
            notes.append(left_out)
        if errors["invalid_pixels"]:
            notes.append(f"{errors['invalid_pixels']} pixels of all trials were not finite and are left out")
        notes += self._fall_note(combination)
        return Row(
            scene=combination.scene,
            sampler=combination.sampler,
            count=combination.count,
            asked=list(combination.asked),
            replaced=combination.replaced,
            dims=combination.dims,
            samples=samples,
            shared_draw=combination.shared_draw,
            **errors,
            efficiency=_efficiency(mse, time),
            ratio=self._ratio(combination, errors_of_all),
            reference_error=reference.error,
            reference_kind=reference.kind,
            times=times,
            time=time,
            fitted=not left_out,
            left_out=left_out,
            notes=notes,
            pictures=None,
        )

    def _fall_note(self, combination: Combination) -> list[str]:
        """Return a note if a row takes less time than one of fewer samples; rows that seem to were measured again."""
        slower = self._falls.get(combination)
        if slower is None:
            return []
        high, low = self._seconds[combination].high, self._seconds[slower].low
        apart = high is not None and low is not None and high < low
        doubt = "" if apart else "; the intervals of the two times overlap"
        return [f"takes less time than with {slower.count} sample{'' if slower.count == 1 else 's'}{doubt}"]

    def _sampled(self, scene: str) -> int:
        """Return the number of pixels that are sampled: those that are not constant, and 1 for the unit square."""
        return 1 if self._request.one_pixel else int(self._resources.pixels(scene, self._request.size).sampled.size)

    def _samples(self, combination: Combination) -> int:
        """Return the number of samples of one trial."""
        return self._sampled(combination.scene) * combination.count

    def _why_left_out(self, combination: Combination, no_interval: str, mse: float | None, floor: float) -> str:
        """Return why the fit does not use a row; empty if it does."""
        if no_interval:
            return no_interval
        if mse is None:
            return "no finite error"
        first, last = self._fitted
        if not first <= combination.count <= last:
            return f"outside of the range of the fit, {first} to {last}"
        if mse == 0.0:
            return "exact: its logarithm is minus infinity"
        if math.sqrt(mse) <= _TRUSTED * floor:
            rmse = f"{math.sqrt(mse):.1g}"
            return f"its rmse of {rmse} is not above {_TRUSTED:g} times the reference's own error of {floor:.1g}"
        return ""

    def _why_no_interval(self, combination: Combination, reason: str) -> str:
        """Return a sentence that explains why the errors of a row have no interval."""
        sums = self._sums[combination]
        if reason == "no hits":
            error = sums[:, SQUARE].sum() / sums[:, TRIALS].sum()
            return f"all trials gave one value, with an mse of {error:.3g}; the errors of others are not known"
        return {
            "few hits": "too few trials found what makes up the error",
            FEW_TRIALS: f"an interval needs {LEAST_TRIALS} trials"
            if self._request.one_pixel
            else f"an interval needs two trials, and {LEAST_TRIALS} estimates of pixels that are not constant",
            INFINITE_VARIANCE: "the mean of the squares does not settle",
            HEAVY_TAILS: "squared errors have an infinite variance, so their mean has no standard error",
        }[reason]

    def _ratio(self, combination: Combination, errors: Mapping[Combination, dict[str, Any]]) -> Interval | None:
        """Return the mean squared error relative to that of the first sampler; None if it has no such row."""
        first = self._request.samplers[0], combination.scene, combination.count
        for other in self.combinations:
            if (other.sampler, other.scene, other.count) == first:
                if other is combination:
                    return Interval(1.0, 1.0, 1.0)
                mine, theirs = errors[combination]["mse"], errors[other]["mse"]
                one_pixel = self._sampled(combination.scene) == 1
                return ratio_of(self._sums[combination], self._sums[other], mine, theirs, one_pixel=one_pixel)
        return None

    def _times(self, combination: Combination) -> Times | None:
        laps = self._store.laps(combination)
        if not len(laps):
            return None
        points, scene = (Seconds(_spread(laps[:, column]), _spread(laps[:, column + 1])) for column in (1, 3))
        total = Seconds(_spread(laps[:, 1] + laps[:, 3]), _spread(laps[:, 2] + laps[:, 4]))
        rounds = np.unique(laps[:, 0]).size
        return Times(
            points, scene, total, *self._store.setup(combination), len(laps), rounds, self._seconds[combination]
        )


def _floor(reference: Reference) -> float:
    """Return the largest error that rounding and the reference may cause in a pixel."""
    return float(reference.error + _ROUNDING * np.nan_to_num(np.abs(reference.image)).max(initial=0.0))


def _spread(seconds: Array) -> Spread:
    lower, median, upper = (float(value) for value in np.percentile(seconds, [25, 50, 75]))
    return Spread(median, lower, upper)


def _efficiency(mse: Interval, time: Interval | None) -> Interval | None:
    if time is None or not time.estimate or not mse.estimate:
        return None
    if not (mse.low and mse.high and time.low and time.high):
        return Interval(1.0 / (mse.estimate * time.estimate))
    return derived_interval(lambda error, seconds: 1.0 / (error * seconds), [mse, time])


def _plus(time: Interval, seconds: float) -> Interval:
    return Interval(*(end if end is None else end + seconds for end in (time.estimate, time.low, time.high)))
