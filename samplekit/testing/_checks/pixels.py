"""Across pixels: no set comes back before the declared period, and neighbours are independent of each other.

Pixels that are declared to share a sequence with their neighbours (``screen_block``) must do more: see ``screen.py``.
Pixels of different blocks are independent.
"""

from __future__ import annotations

import math

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit.testing._checks.screen import judge_blocks
from samplekit.testing._judge import repeated
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import normal_threshold
from samplekit.testing._subject import Array, SamplerSubject

_PIXELS, _QUICK_PIXELS = 1 << 17, 1 << 13
_LAGS = (1, 2, 16, 256)
_COUNT = 4


@conformance_check("across-pixels", 13)
def check_across_pixels(subject: SamplerSubject) -> None:
    """No two of 2^17 pixels in a row or column have the same set; neighbours are not correlated, or share a net."""
    if not subject.spec.randomized:
        raise NotApplicable("it is not declared randomised: all pixels have one set")
    dims = subject.dims(2)
    count = subject.counts(_COUNT, dims=dims)[0]
    pixels = subject.affordable(_QUICK_PIXELS if subject.quick else _PIXELS, count, dims, least=512)
    along, zero = np.arange(pixels, dtype=np.int64), np.zeros(pixels, np.int64)
    block = subject.spec.screen_block
    both = subject.fill(Realizations.of_pixels(np.append(along, zero[1:]), np.append(zero, along[1:]), 0), count, dims)
    _judge_repeats(subject, both, pixels, count)
    for axis, x, y in (("x", along, zero), ("y", zero, along)):
        values = both[:pixels] if axis == "x" else np.concatenate([both[:1], both[pixels:]])
        if block is not None:
            values = subject.fill(Realizations.of_pixels(x * block, y * block, 0), count, dims)
        for dimension in range(min(dims, 2)):
            # One point of each set: the points of a set depend on each other.
            _judge_neighbours(subject, values[:, dimension, -1], axis, dimension, count, dims)
    if block is not None:
        judge_blocks(subject, block)


def _pixel(axis: str, place: int) -> tuple[int, int]:
    return (place, 0) if axis == "x" else (0, place)


def _judge_repeats(subject: SamplerSubject, values: Array, pixels: int, count: int) -> None:
    """Judge the sets of a row of ``pixels``, and then those of the column below its first pixel, all together."""
    period = subject.spec.period
    for first, second in repeated(values):
        pair = [(i, 0) if i < pixels else (0, i - pixels + 1) for i in (first, second)]
        if period is None or any((b - a) % period != 0 for a, b in zip(*pair, strict=True)):
            promised = "never" if period is None else f"after {period} pixels"
            points = values[second].T.copy()
            raise CheckFailed(
                f"the set of pixel {pair[0]} comes back in pixel {pair[1]}: it is declared to come back {promised}",
                subject.request(count, int(values.shape[1]), realization=pair[1], points=points),
            )


def _judge_neighbours(subject: SamplerSubject, u: Array, axis: str, dimension: int, count: int, dims: int) -> None:
    """Judge the correlation, and the mean of cos and sin of the difference, which show a shift from pixel to pixel."""
    if u.std() == 0.0:
        return
    threshold = normal_threshold(2 * len(_LAGS) * min(dims, 2) * 3)
    # Where points stay in cells of their own, differences are not uniform: then correlation alone is a test.
    uniform = abs(u.min()) < 0.01 and u.max() > 0.99 and _fills_circle(u)
    for lag in _LAGS:
        first, second = u[:-lag], u[lag:]
        found = {"correlation": (float(np.corrcoef(first, second)[0, 1]), 1.0)}
        if uniform:
            difference = 2 * math.pi * (second - first)
            found["mean cosine of the difference"] = float(np.cos(difference).mean()), math.sqrt(0.5)
            found["mean sine of the difference"] = float(np.sin(difference).mean()), math.sqrt(0.5)
        for name, (value, sigma) in found.items():
            limit = threshold * sigma / math.sqrt(first.size)
            if abs(value) > limit:
                block = subject.spec.screen_block
                apart = lag * (block or 1)
                advice = "" if block else "; pixels that share a sequence on purpose are declared by screen_block"
                raise CheckFailed(
                    f"dimension {dimension} of pixels {apart} apart along {axis}: {name} {value:.3g}, at most"
                    f" {limit:.2g} expected of {first.size} independent pixels{advice}",
                    subject.request(count, dims, realization=_pixel(axis, apart), indices=(count - 1,)),
                )


def _fills_circle(u: Array) -> bool:
    """Tell whether one coordinate is about uniform over pixels: its first Fourier coefficient is small."""
    return abs(complex(np.exp(2j * math.pi * u).mean())) < 4.0 / math.sqrt(u.size)
