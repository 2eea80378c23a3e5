"""Across dimensions: pairs of dimensions, padded ones above all, are not correlated.

Judged on sets so large that true sequences have converged: of 256 points Halton's dimensions 6 and 7 (bases 17 and 19)
have correlation 0.09, which is what the sequence is, and falls as 1/N; that of dimensions padded wrongly stays.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import chi_square_threshold, normal_threshold

if TYPE_CHECKING:
    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Array, SamplerSubject

_DIMS, _QUICK_DIMS = 8, 4
_COUNT = 4096
_EXCESS = 2.0
"""Variance of a correlation, relative to that of independent points, that is none of the sampler's faults.

Where padded dimensions are nets of base 2 whose indices are shuffled as Owen scrambles, pairs of points stay pairs, and
lie in opposite halves of each dimension: N / 2 signs are random in place of N values, which is twice the variance.
"""
_REALIZATIONS, _QUICK_REALIZATIONS = 64, 16


def _has_pairs(spec: SamplerSpec) -> str:
    return "it has one dimension" if spec.dimensions[1] == 1 else ""


@conformance_check("across-dimensions", 14, tolerance="family-wise 1e-3: about 7 / sqrt(n)", requires=_has_pairs)
def check_across_dimensions(subject: SamplerSubject) -> None:
    """Two dimensions of a set are correlated little more than random ones, in every set and on average."""
    dims = subject.most_dims(_QUICK_DIMS if subject.quick else _DIMS)
    randomized = subject.spec.randomized
    counts = subject.counts(_COUNT, dims=dims)
    if dims < 2 or not counts or counts[0] < 16:
        raise NotApplicable("it makes no set of 16 points and more in two dimensions")
    count = counts[0]
    wanted = _QUICK_REALIZATIONS if subject.quick else _REALIZATIONS
    realizations = subject.affordable(wanted, count, dims, least=16) if randomized else 1
    asked = subject.independent(0, realizations)
    values = subject.fill(asked, count, dims)
    correlations = pair_correlations(values)
    first, second = np.triu_indices(dims, 1)
    tests = 2 * first.size
    # Of independent coordinates r has mean 0 and variance 1 / (n - 1).
    squares = (count - 1) * (correlations**2).sum(axis=0)
    limit = _EXCESS * chi_square_threshold(tests, realizations)
    means = np.abs(correlations.mean(axis=0)) * math.sqrt(realizations * (count - 1) / _EXCESS)
    for pair in range(first.size):
        i, j = int(first[pair]), int(second[pair])
        row = int(np.abs(correlations[:, pair]).argmax())
        example = subject.example(values, count, row=row, first=int(asked.x[row]) - row, axes=(i, j))
        if squares[pair] > limit:
            rms = math.sqrt(float((correlations[:, pair] ** 2).mean()))
            most = math.sqrt(limit / realizations / (count - 1))
            raise CheckFailed(
                f"dimensions {i} and {j} have correlation {rms:.3g} (root mean square over {realizations} sets), at"
                f" most {most:.2g} expected of {count} independent points",
                example,
            )
        if means[pair] > normal_threshold(tests):
            raise CheckFailed(
                f"dimensions {i} and {j} have correlation {float(correlations[:, pair].mean()):.3g} on average over"
                f" {realizations} sets, at most"
                f" {normal_threshold(tests) * math.sqrt(_EXCESS / realizations / (count - 1)):.2g} expected",
                example,
            )


def pair_correlations(values: Array) -> Array:
    """Pearson's correlation of every pair of dimensions of ``values`` float64[R, D, N]: float64[R, pairs]."""
    centred = values - values.mean(axis=2, keepdims=True)
    spread = np.sqrt((centred**2).mean(axis=2, keepdims=True))
    # A dimension that is constant is no random variable: it is correlated with nothing.
    standard = np.divide(centred, spread, out=np.zeros_like(centred), where=spread > 0.0)
    matrix = np.einsum("rin,rjn->rij", standard, standard) / values.shape[2]
    first, second = np.triu_indices(values.shape[1], 1)
    return np.asarray(matrix[:, first, second], np.float64)
