"""Classify a measured cell as right, or name the reason why it is not."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from samplekit._stability.measurement import Measurement

Kind = Literal[
    "right", "no hits", "few hits", "infinite variance", "precision lost", "not random", "invalid", "refused", "wrong"
]

_STANDARD_ERRORS = 4.0
_ENOUGH_HITS = 100.0
_VISIBLE = 64.0 * 2.0**-53
"""Rounding errors below this share of the values' own deviation do not count as lost precision."""

MEANINGS: dict[Kind, str] = {
    "right": f"within {_STANDARD_ERRORS:g} standard errors and rounding",
    "no hits": "no sample hit: all samples are equal, so the variance is 0 although the estimate has not converged",
    "few hits": f"beyond {_STANDARD_ERRORS:g} standard errors, from fewer than {_ENOUGH_HITS:g} samples that hit",
    "infinite variance": "the standard error says nothing about the error",
    "precision lost": "rounding is larger than the error of sampling",
    "not random": "one set: no standard error",
    "invalid": "values that are not finite",
    "refused": "the sampler cannot make such sets",
    "wrong": f"beyond {_STANDARD_ERRORS:g} standard errors twice, with independent seeds",
}


@dataclass(frozen=True)
class Verdict:
    """The kind of a cell, and the reason in words and numbers; the reason is empty if the cell is right."""

    kind: Kind
    reason: str = ""


def judge(measured: Measurement, *, finite_variance: bool) -> Verdict:
    """Judge one measurement; a second one with another seed must confirm ``wrong``.

    Parameters
    ----------
    measured
        The measurement.
    finite_variance
        Whether the values of the scene have a finite variance.
    """
    errors = f"{measured.standard_errors:.3g} standard errors"
    within = abs(measured.error) <= measured.allowance
    if measured.invalid:
        return Verdict("invalid", f"{measured.invalid} of {measured.samples} values are not finite")
    if not math.isfinite(measured.estimate):
        return Verdict("invalid", "the sum overflows")
    if measured.hits == 0.0 and not within:
        return Verdict(
            "no hits",
            f"all {measured.samples} samples gave {measured.estimate:.3g}:"
            f" the variance is 0, and the error {measured.error:.3g}",
        )
    if not finite_variance:
        return Verdict("infinite variance", f"{errors}, which say nothing about the error")
    rounding, sampling = measured.arithmetic_error, measured.sampling_error
    if rounding > _VISIBLE * measured.deviation > 0.0 and not rounding <= sampling:
        return Verdict("precision lost", f"rounding {rounding:.2g}, error of sampling {sampling:.2g}")
    if within or abs(measured.standard_errors) <= _STANDARD_ERRORS:
        return Verdict("right")
    if math.isnan(measured.spread):
        return Verdict("not random", f"the error of the one set is {measured.error:.2g}")
    if measured.hits < _ENOUGH_HITS:
        return Verdict("few hits", f"{errors}, and {measured.hits:.0f} samples that hit")
    return Verdict("wrong", f"{errors}, {measured.hits:.0f} samples that hit")
