"""Every value is in [0, 1), also if all random bits are zeros or ones; the sampler writes every value and no other."""

from __future__ import annotations

import math

import numpy as np

from samplekit.testing._result import CheckFailed, conformance_check
from samplekit.testing._subject import Array, SamplerSubject

_COUNTS = (1, 2, 3, 5, 7, 64, 97, 100, 1000)
_ROUNDS_TO_ONE = np.float64(1.0 - 2.0**-25)
"""From here on a float64 rounds to 1.0 in float32."""


@conformance_check("range", 1)
def check_range(subject: SamplerSubject) -> None:
    """Every value is at least 0 and below 1."""
    rounded = drawn = 0
    dims, high = subject.dims(2), subject.most_dims(64)
    requests = [(count, dims, 64 if count <= 100 else 4) for count in subject.counts(*_COUNTS, 4096, dims=dims)]
    requests += [(count, high, 4) for count in subject.counts(2, 64, dims=high)]
    # Many draws: a value that reaches 1.0 once in a million is seen with probability 1 - exp(-2).
    count = subject.counts(64, dims=dims)[0]
    requests.append((count, dims, subject.affordable(2**11 if subject.quick else 2**14, count, dims)))
    for count, dims, realizations in requests:
        for seed in (0, 2**64 - 1):
            values = subject.sets(count, dims, realizations, seed=seed)
            judge_range(subject, values, count, seed)
            rounded += int(np.count_nonzero(values >= _ROUNDS_TO_ONE))
            drawn += values.size
    for when, values in subject.extremes:
        judge_range(subject, values, values.shape[2], 0, when)
    # A uniform float64 rounds to 1.0 in float32 with probability 2^-25: no fault, unless it happens far more often.
    expected = drawn * 2.0**-25
    if rounded > expected + 6.0 * math.sqrt(expected) + 2:
        subject.hints.append(
            f"{rounded} of {drawn} values round to 1.0 in float32, {expected:.2g} are expected of uniform ones:"
            " code that converts them must clamp"
        )


def judge_range(subject: SamplerSubject, values: Array, count: int, seed: int, when: str = "") -> None:
    """Raise if a value of ``values`` float64[R, D, N] is outside [0, 1); NaN is outside."""
    outside = ~((values >= 0.0) & (values < 1.0))
    if outside.any():
        row, dimension, point = (int(i) for i in np.argwhere(outside)[0])
        raise CheckFailed(
            f"value {float(values[row, dimension, point])!r} in dimension {dimension}{when}: expected at least 0 and"
            " below 1",
            subject.example(values, count, seed=seed, row=row, indices=(point,)),
        )


@conformance_check("shape", 2)
def check_shape(subject: SamplerSubject) -> None:
    """Every request gives all its points, finite float64, at both limits of the dimensions, and writes nothing else."""
    most = subject.spec.dimensions[1]
    low, high = subject.dims(1), subject.most_dims(4096 if most else 256)
    if high < (most or 0):
        subject.note(f"judged in up to {high} dimensions")
    for dims, wanted in ((low, _COUNTS), (subject.dims(2), _COUNTS), (high, (1, 3, 64) if high > 64 else _COUNTS)):
        for count in subject.counts(*wanted, dims=dims):
            _judge_guarded(subject, count, dims)
            points = subject.sampler.points(count, dims, realizations=2)
            if points.shape != (2, count, dims) or points.dtype != np.float64:
                raise CheckFailed(
                    f"shape {points.shape} of {points.dtype}: expected {(2, count, dims)} of float64",
                    subject.request(count, dims),
                )
    for count, dims, what in ((0, low, "0 points"), (-1, low, "-1 points"), (1, 0, "0 dimensions")):
        if subject.makes(count, dims):
            raise CheckFailed(f"accepts {what}: expected an error", subject.request(count, dims))


def _judge_guarded(subject: SamplerSubject, count: int, dims: int) -> None:
    """Fill the middle of a larger array, and raise if its ends are written as well: kernels check no bounds."""
    untouched = -7.0
    buffer = np.full((4, dims, count), untouched)
    buffer[1:3] = np.nan
    subject.write(buffer[1:3], subject.sampler.trials(0, 2, 0), count, 0, subject.sampler)
    if (buffer[[0, 3]] != untouched).any():
        raise CheckFailed("writes outside of the array that it was given", subject.request(count, dims))
