"""Across pixels: no set comes back before the declared period, and neighbours know nothing of each other.

Of pixels that are declared to share a sequence with their neighbours (``screen_block``) more than that is asked: see
``screen``. Pixels of different blocks know nothing of each other.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit.testing._result import CheckFailed, CounterExample, check
from samplekit.testing._screen import judge_blocks
from samplekit.testing._statistics import normal_threshold

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Subject

_PIXELS, _QUICK_PIXELS = 1 << 17, 1 << 13
_LAGS = (1, 2, 16, 256)
_COUNT = 4


def _declared_randomized(spec: SamplerSpec) -> str:
    return "" if spec.randomized else "it is not declared randomised: all pixels have one set"


@check("across-pixels", 13, tolerance="repeats exact; correlation family-wise 1e-3", requires=_declared_randomized)
def check_across_pixels(subject: Subject) -> None:
    """No two of 2^17 pixels of a row, and of a column, have one set; neighbours are not correlated, or share a net."""
    dims = subject.dims(2)
    count = subject.counts(_COUNT, dims=dims)[0]
    pixels = subject.affordable(_QUICK_PIXELS if subject.quick else _PIXELS, count, dims, least=512)
    along, zero = np.arange(pixels, dtype=np.int64), np.zeros(pixels, np.int64)
    tests = 2 * len(_LAGS) * min(dims, 2) * 3
    block = subject.spec.screen_block
    for axis, x, y in (("x", along, zero), ("y", zero, along)):
        values = subject.fill(Realizations.of_pixels(x, y, 0), count, dims)
        _judge_repeats(subject, values, axis, count)
        if block is not None:
            values = subject.fill(Realizations.of_pixels(x * block, y * block, 0), count, dims)
        for dimension in range(min(dims, 2)):
            # One point of each set: the points of a set depend on each other.
            _judge_neighbours(subject, values[:, dimension, -1], axis, dimension, count, tests)
    if block is not None:
        judge_blocks(subject, block)


def _judge_repeats(subject: Subject, values: NDArray[np.float64], axis: str, count: int) -> None:
    rows = np.ascontiguousarray(values.reshape(len(values), -1)).view(np.dtype((np.void, values[0].nbytes))).ravel()
    _, first, group = np.unique(rows, return_index=True, return_inverse=True)
    later = np.flatnonzero(first[group] != np.arange(len(rows)))
    period = subject.spec.period
    if period is not None:
        later = later[(later - first[group[later]]) % period != 0]
    if not later.size:
        return
    second = int(later[0])
    earlier = int(first[group[second]])
    promised = "never" if period is None else f"after {period} pixels"
    place = (second, 0) if axis == "x" else (0, second)
    raise CheckFailed(
        f"the set of pixel {earlier} comes back in pixel {second} along {axis}, {second - earlier} pixels on:"
        f" it is declared to come back {promised}",
        CounterExample(subject.text, count, int(values.shape[1]), 0, place, points=values[second].T.copy()),
    )


def _judge_neighbours(
    subject: Subject, u: NDArray[np.float64], axis: str, dimension: int, count: int, tests: int
) -> None:
    """Correlation, and the mean of cos and sin of the difference: a shift from pixel to pixel shows in these."""
    spread = float(u.std())
    if spread == 0.0:
        return
    threshold = normal_threshold(tests)
    for lag in _LAGS:
        first, second = u[:-lag], u[lag:]
        number = first.size
        difference = 2 * math.pi * (second - first)
        found = {
            "correlation": (float(np.corrcoef(first, second)[0, 1]), 1.0),
        }
        # Where points stay in cells of their own, differences are not uniform: then correlation alone is a test.
        if abs(u.min()) < 0.01 and u.max() > 0.99 and _fills_circle(u):
            found["mean cosine of the difference"] = float(np.cos(difference).mean()), math.sqrt(0.5)
            found["mean sine of the difference"] = float(np.sin(difference).mean()), math.sqrt(0.5)
        for name, (value, sigma) in found.items():
            limit = threshold * sigma / math.sqrt(number)
            if abs(value) > limit:
                block = subject.spec.screen_block
                apart = lag * (block or 1)
                place = (apart, 0) if axis == "x" else (0, apart)
                advice = "" if block else "; pixels that share a sequence on purpose are declared by screen_block"
                raise CheckFailed(
                    f"dimension {dimension} of pixels {apart} apart along {axis}: {name} {value:.3g}, at most"
                    f" {limit:.2g} expected of {number} independent pixels{advice}",
                    CounterExample(subject.text, count, subject.dims(2), 0, place, indices=(count - 1,)),
                )


def _fills_circle(u: NDArray[np.float64]) -> bool:
    """Whether one coordinate is about uniform over pixels: its first Fourier coefficient is small."""
    return abs(complex(np.exp(2j * math.pi * u).mean())) < 4.0 / math.sqrt(u.size)
