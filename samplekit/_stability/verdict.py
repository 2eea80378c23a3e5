"""Classify a measured cell as right, or name the reason why it is not.

An estimate is wrong if chance does not explain its error, twice. The first bound is Student's t, which the estimates of
a right cell exceed once in 1000 times if they are normal. Estimates of few realisations are often far from normal, so a
second measurement with another seed has at least 256 realisations and a bound of 8 standard errors. Symmetric estimates
of any distribution exceed it with a probability of at most 2e-11, since P(|sum e| > x sqrt(sum e²)) is at most
2 exp(-x² / 2) (Efron 1969, "Student's t-test under symmetry conditions"). Skewed estimates exceed it if few of them see
what makes the mean: such cells have few hits, and are not called wrong.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from samplekit._integrate.hits import ENOUGH_HITS, describe_hits

if TYPE_CHECKING:
    from samplekit._stability.measurement import Measurement

Kind = Literal[
    "right", "no hits", "few hits", "infinite variance", "precision lost", "not random", "invalid", "refused", "wrong"
]

FALSE_ALARMS = 1e-3
"""Share of right cells with normal estimates that are measured twice."""
CONFIRMING_REALIZATIONS = 256
"""Least number of realisations of a second measurement."""
CONFIRMING_BOUND = 8.0
"""Standard errors beyond which a second measurement confirms that an estimate is wrong."""
_VISIBLE = 64.0 * 2.0**-53
"""Rounding errors below this share of the values' own deviation do not count as lost precision."""

MEANINGS: dict[Kind, str] = {
    "right": "rounding or chance explains the error",
    "no hits": "all samples, or all estimates, are equal: the variance is 0, which says nothing about the error",
    "few hits": f"chance does not explain the error, but fewer than {ENOUGH_HITS:g} estimates differ from the others:"
    " the standard error is itself a guess",
    "infinite variance": "the standard error says nothing about the error",
    "precision lost": "rounding is larger than the error of sampling",
    "not random": "one set: no standard error",
    "invalid": "values that are not finite",
    "refused": "the sampler cannot make such sets",
    "wrong": f"chance does not explain the error, nor that of {CONFIRMING_REALIZATIONS} or more estimates with another"
    f" seed, which is beyond {CONFIRMING_BOUND:g} standard errors",
}


@dataclass(frozen=True)
class Verdict:
    """The kind of a cell, and the reason in words and numbers; the reason is empty if the cell is right."""

    kind: Kind
    reason: str = ""


def chance_bound(realizations: int) -> float:
    """Return the standard errors that chance explains, by Student's t; infinite for one realisation."""
    from scipy.special import stdtrit

    return float(-stdtrit(realizations - 1, FALSE_ALARMS / 2.0)) if realizations > 1 else math.inf


def judge(measured: Measurement, *, finite_variance: bool, bound: float) -> Verdict:
    """Judge one measurement; a second one must confirm ``wrong``.

    Parameters
    ----------
    measured
        The measurement.
    finite_variance
        Whether the values of the scene have a finite variance.
    bound
        Standard errors that chance explains.
    """
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
        return Verdict("infinite variance", f"the error {measured.error:.3g} has no standard error")
    rounding, sampling = measured.arithmetic_error, measured.sampling_error
    if rounding > _VISIBLE * measured.deviation > 0.0 and not rounding <= sampling:
        of_sampling = "unknown" if math.isnan(sampling) else f"{sampling:.2g}"
        return Verdict("precision lost", f"rounding {rounding:.2g}, error of sampling {of_sampling}")
    if within:
        return Verdict("right")
    if math.isnan(measured.spread):
        return Verdict("not random", f"the error of the one set is {measured.error:.2g}")
    hits = describe_hits(measured.effective_realizations, measured.realizations)
    if hits == "no hits":
        return Verdict(
            hits,
            f"all {measured.realizations} estimates are {measured.estimate:.3g} but for rounding:"
            f" the variance is 0, and the error {measured.error:.3g}",
        )
    if abs(measured.standard_errors) <= bound:
        return Verdict("right")
    reason = (
        f"{measured.standard_errors:.3g} standard errors, and {measured.effective_realizations:.1f} of"
        f" {measured.realizations} estimates that differ"
    )
    return Verdict(hits or "wrong", reason)
