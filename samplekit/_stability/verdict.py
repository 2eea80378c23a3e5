"""What is to be thought of a cell: right, or why not."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from samplekit._stability.cell import Measured

Kind = Literal[
    "right", "no hits", "few hits", "infinite variance", "precision lost", "not random", "invalid", "refused", "wrong"
]

STANDARD_ERRORS = 4.0
ENOUGH_HITS = 100.0
_VISIBLE = 64.0 * 2.0**-53
"""Rounding errors below this much of the values' own deviation are nobody's loss."""

MEANINGS: dict[Kind, str] = {
    "right": f"within {STANDARD_ERRORS:g} standard errors and rounding",
    "no hits": "right, but no sample hit: all are the same, the variance is 0 and nothing has converged",
    "few hits": f"beyond {STANDARD_ERRORS:g} standard errors, from fewer than {ENOUGH_HITS:g} samples that hit",
    "infinite variance": "a standard error means nothing",
    "precision lost": "rounding is larger than the error of sampling",
    "not random": "one set: no standard error",
    "invalid": "values that are not finite",
    "refused": "the sampler makes no such sets",
    "wrong": f"beyond {STANDARD_ERRORS:g} standard errors twice, with independent seeds",
}


@dataclass(frozen=True)
class Verdict:
    """A kind, and the reason in words and numbers; empty where it is right."""

    kind: Kind
    reason: str = ""


def judge(cell: Measured, *, randomized: bool, finite_variance: bool) -> Verdict:
    """Judge one measurement; ``wrong`` is to be confirmed by another one.

    Parameters
    ----------
    cell
        What was measured.
    randomized
        Whether the sampler's realisations differ.
    finite_variance
        Whether the scene's values have a variance.
    """
    within = abs(cell.error) <= cell.allowance
    if cell.invalid:
        return Verdict("invalid", f"{cell.invalid} of {cell.samples} values are not finite")
    if not math.isfinite(cell.estimate):
        return Verdict("invalid", "the sum overflows")
    if cell.hits == 0.0 and not within:
        return Verdict(
            "no hits",
            f"all {cell.samples} samples gave {cell.estimate:.3g}: the variance is 0, and the error {cell.error:.3g}",
        )
    if not finite_variance:
        return Verdict("infinite variance", f"{_apart(cell)} standard errors, which mean nothing")
    if cell.arithmetic_error > _VISIBLE * cell.deviation > 0.0 and not cell.arithmetic_error <= cell.sampling_error:
        return Verdict(
            "precision lost",
            f"rounding {cell.arithmetic_error:.2g}, error of sampling {cell.sampling_error:.2g}",
        )
    if within or abs(cell.standard_errors) <= STANDARD_ERRORS:
        return Verdict("right")
    if not randomized or math.isnan(cell.spread):
        return Verdict("not random", f"the error of the one set is {cell.error:.2g}")
    if cell.hits < ENOUGH_HITS:
        return Verdict("few hits", f"{_apart(cell)} standard errors, and {cell.hits:.0f} samples that hit")
    return Verdict("wrong", f"{_apart(cell)} standard errors, {cell.hits:.0f} samples that hit")


def _apart(cell: Measured) -> str:
    return f"{cell.standard_errors:.3g}"
