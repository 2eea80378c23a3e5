"""Across dimensions: no two dimensions are correlated, above all no padded ones.

The sets are so large that true sequences have converged: with 256 points, Halton's dimensions 6 and 7 (bases 17 and 19)
have correlation 0.09, which belongs to the sequence and falls as 1/N; the correlation of wrongly padded ones stays.
"""

from __future__ import annotations

import math

import numpy as np

from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import chi_square_threshold, normal_threshold
from samplekit.testing._subject import Array, SamplerSubject

_DIMS, _QUICK_DIMS = 8, 4
_COUNT = 4096
_EXCESS = 2.0
"""Variance of a correlation, relative to that of independent points, that is no fault of the sampler.

Where padded dimensions are nets of base 2 whose indices are shuffled as Owen scrambles, pairs of points stay pairs, and
lie in opposite halves of each dimension: N / 2 signs are random in place of N values, which is twice the variance.
"""
_REALIZATIONS, _QUICK_REALIZATIONS = 64, 16


@conformance_check("across-dimensions", 14)
def check_across_dimensions(subject: SamplerSubject) -> None:
    """Two dimensions of a set are correlated little more than random ones, in every set and on average.

    A set of n points may have a correlation of about 7 / sqrt(n).
    """
    if subject.spec.dimensions[1] == 1:
        raise NotApplicable("it has one dimension")
    dims = subject.most_dims(_QUICK_DIMS if subject.quick else _DIMS)
    counts = subject.counts(_COUNT, dims=dims)
    if dims < 2 or not counts or counts[0] < 16:
        raise NotApplicable("it makes no set of 16 points and more in two dimensions")
    count = counts[0]
    wanted = _QUICK_REALIZATIONS if subject.quick else _REALIZATIONS
    realizations = subject.affordable(wanted, count, dims, least=16) if subject.spec.randomized else 1
    asked = subject.sampler.trials(0, realizations, 0)
    values = subject.fill(asked, count, dims)
    correlations = pair_correlations(values)
    tests = 2 * correlations.shape[1]
    # Of independent coordinates a correlation has mean 0 and variance 1 / (n - 1).
    variance = _EXCESS / realizations / (count - 1)
    mean, rms = correlations.mean(axis=0), np.sqrt((correlations**2).mean(axis=0))
    most_mean = normal_threshold(tests) * math.sqrt(variance)
    most_rms = math.sqrt(chi_square_threshold(tests, realizations) * variance)
    judged = (
        (rms, most_rms, f"(root mean square over {realizations} sets)"),
        (mean, most_mean, f"on average over {realizations} sets"),
    )
    for pair, (i, j) in enumerate(zip(*np.triu_indices(dims, 1), strict=True)):
        for found, most, how in judged:
            if abs(found[pair]) > most:
                row = int(np.abs(correlations[:, pair]).argmax())
                raise CheckFailed(
                    f"dimensions {i} and {j} have correlation {found[pair]:.3g} {how}, at most {most:.2g} expected of"
                    f" {count} independent points",
                    subject.example(values, count, row=row, first=int(asked.x[row]) - row, axes=(int(i), int(j))),
                )


def pair_correlations(values: Array) -> Array:
    """Return Pearson's correlation of every pair of dimensions of ``values`` float64[R, D, N]: float64[R, pairs]."""
    centred = values - values.mean(axis=2, keepdims=True)
    spread = np.sqrt((centred**2).mean(axis=2, keepdims=True))
    # A constant dimension is correlated with nothing.
    standard = np.divide(centred, spread, out=np.zeros_like(centred), where=spread > 0.0)
    matrix = np.einsum("rin,rjn->rij", standard, standard) / values.shape[2]
    first, second = np.triu_indices(values.shape[1], 1)
    return np.asarray(matrix[:, first, second], np.float64)
