"""Across dimensions: no two dimensions are correlated, above all no padded ones; no three or four are tied together.

The sets are so large that true sequences have converged: with 256 points, Halton's dimensions 6 and 7 (bases 17 and 19)
have correlation 0.09, which belongs to the sequence and falls as 1/N; the correlation of wrongly padded ones stays.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from samplekit.testing._checks.joint import SIDES, walsh
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
_TIED_DIMS, _TIED_COUNT, _TIED_SETS = 5, 1 << 16, 4
_MOST_TIED = 0.3
"""Most of |S|^2 / N^2, where S is the sum over a set of a Fourier or Walsh function of three or four dimensions.

It is 1 where one dimension is the sum of two others, 1 / N for random points, and at most 0.14 in all samplers that
come with samplekit or its plugins, lattices among them: they have such functions too, whose frequencies grow with N.
"""


@conformance_check("across-dimensions", 14)
def check_across_dimensions(subject: SamplerSubject) -> None:
    """Two dimensions of a set are correlated little more than random ones; no one is a sum of two or three.

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
    _judge_tied(subject)


def _judge_tied(subject: SamplerSubject) -> None:
    """Raise if three or four dimensions are tied together in every set: one is the sum of the others, say."""
    spec = subject.spec
    dims = subject.dims(4 if spec.counts.depends_on_dims else _TIED_DIMS)
    counts = subject.counts(_TIED_COUNT, dims=dims)
    if dims < 3 or not counts or counts[0] < _TIED_COUNT // 2:
        return
    count, sets = counts[0], _TIED_SETS if spec.randomized else 1
    values = subject.fill(subject.sampler.trials(0, sets, 0), count, dims)
    for axes in itertools.chain(*(itertools.combinations(range(dims), number) for number in (3, 4))):
        share = _largest_share(values[:, list(axes)])
        if share > _MOST_TIED:
            raise CheckFailed(
                f"dimensions {', '.join(map(str, axes))} are tied together: a Fourier or Walsh function of them has"
                f" |S|^2 = {share:.2g} N^2 in sets of N = {count} points, at most {_MOST_TIED} N^2 expected",
                subject.request(count, dims, axes=axes),
            )


def _largest_share(values: Array) -> float:
    """Return the largest mean of |S|^2 / N^2 over the sets float64[R, D, N], of functions that vary in all dimensions.

    Fourier frequencies go up to a quarter of the cells along each axis, and Walsh functions up to as many as the cells.
    """
    sets, dims, count = values.shape
    side = SIDES[dims]
    place = np.zeros((sets, count), np.int64)
    for axis in range(dims):
        place = place * side + np.clip((values[:, axis] * side).astype(np.int64), 0, side - 1)
    held = np.stack([np.bincount(row, minlength=side**dims) for row in place]).reshape(sets, *[side] * dims)
    low = [*range(1, side // 4 + 1), *range(-(side // 4), 0)]
    fourier = np.fft.fftn(held, axes=tuple(range(1, dims + 1)))[np.ix_(range(sets), *[low] * dims)]
    found = (fourier, walsh(held.astype(float))[(slice(None), *[slice(1, None)] * dims)])
    return max(float((np.abs(each) ** 2).mean(axis=0).max()) for each in found) / float(count) ** 2


def pair_correlations(values: Array) -> Array:
    """Return Pearson's correlation of every pair of dimensions of ``values`` float64[R, D, N]: float64[R, pairs]."""
    centred = values - values.mean(axis=2, keepdims=True)
    spread = np.sqrt((centred**2).mean(axis=2, keepdims=True))
    # A constant dimension is correlated with nothing.
    standard = np.divide(centred, spread, out=np.zeros_like(centred), where=spread > 0.0)
    matrix = np.einsum("rin,rjn->rij", standard, standard) / values.shape[2]
    first, second = np.triu_indices(values.shape[1], 1)
    return np.asarray(matrix[:, first, second], np.float64)
