"""Whether enough independent realisations differ for their spread to say how large the error is.

If an integrand is seen by few realisations, most estimates are equal, and the spread of the rest is a guess; if none
sees it, all estimates are equal, the spread is 0, and nothing has converged.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

ENOUGH_HITS = 40.0
"""Effective number of realisations from which their spread is trusted; or a fifth of them, if that is less."""
_ENOUGH_SHARE = 0.2


def effective_hits(estimates: Array, allowance: float = 0.0) -> float:
    """Return the effective number of realisations whose estimates differ from the most common one.

    It is (sum d)² / sum d², where d is the distance from the median (Kish 1965, "Survey Sampling"). If k estimates out
    of many differ from the others by the same amount, it is k. For R normal estimates it is about 0.64 R, and less for
    heavier tails.

    Parameters
    ----------
    estimates
        float64[R]: finite estimates, or errors, of independent realisations.
    allowance
        Distances up to this one are rounding, and count as 0.
    """
    distances = np.abs(estimates - np.partition(estimates, estimates.size // 2)[estimates.size // 2])
    distances[distances <= allowance] = 0.0
    largest = float(distances.max())
    if largest == 0.0:
        return 0.0
    distances /= largest
    return float(distances.sum() ** 2 / np.square(distances).sum())


def describe_hits(hits: float, realizations: int) -> Literal["", "no hits", "few hits"]:
    """Return whether so many effective hits out of so many realisations are none or few; empty if they are enough."""
    if hits == 0.0:
        return "no hits"
    return "few hits" if hits < min(ENOUGH_HITS, _ENOUGH_SHARE * realizations) else ""
