"""Judge blocks of pixels that share one sequence: for them, this replaces the independence of pixels.

A sampler that declares ``screen_block`` must do two things. Exactly: the sets of a block's pixels together keep every
net and all strata that are promised of one set, so they are different parts of one good set. Statistically: the part of
their errors that is left after averaging over a square of pixels is less than half of what independent errors leave.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from samplekit._bases.realizations import Realizations
from samplekit._specs import Strata
from samplekit.testing._checks.promises import promised_nets
from samplekit.testing._judge import judge_promise
from samplekit.testing._result import CheckFailed
from samplekit.testing._subject import Array, SamplerSubject

_COUNTS = (1, 4, 16)
_EXACT_BLOCKS = 4
_BLOCKS = 128
"""Blocks whose errors are averaged: see ``_LEFT``."""
_LEFT = 0.5
"""Variance of a mean over a square of pixels, relative to that of independent pixels, that is too much.

A sampler that leaves a quarter exceeds it in 128 blocks with probability 2e-10 (chi-square with 128 degrees of freedom,
twice its mean; the pixels of one block count as one), and one with independent pixels stays below it with 4e-6.
"""
_MOST_POINTS = 1 << 16
_APART = 3
"""Blocks from one that is judged to the next."""


def judge_blocks(subject: SamplerSubject, side: int) -> None:
    """Raise unless the sets of each block together keep what is promised, and their errors cancel."""
    _judge_unions(subject, side)
    _judge_errors(subject, side)


def _block_sets(
    subject: SamplerSubject, side: int, blocks: int, count: int, dims: int, seed: int = 0
) -> tuple[Array, NDArray[np.int64]]:
    """Return sets of whole blocks float64[K, pixels, D, N], pixels row by row, and the blocks' corners int64[K, 2]."""
    y, x = np.mgrid[0:side, 0:side]
    place = np.arange(blocks) * _APART
    corners = np.stack([place, 7 * place + 1], axis=1) * side
    xs = (corners[:, 0, None] + x.ravel()).ravel()
    ys = (corners[:, 1, None] + y.ravel()).ravel()
    values = subject.fill(Realizations.of_pixels(xs, ys, seed), count, dims)
    return values.reshape(blocks, side * side, dims, count), corners


def _judge_unions(subject: SamplerSubject, side: int) -> None:
    nets = promised_nets(subject.spec)
    dims = subject.dims(max([4, *(max(net.dims) + 1 for net in nets)]))
    for count in subject.counts(*_COUNTS[: 2 if subject.quick else 3], dims=dims):
        together = side * side * count
        if together > _MOST_POINTS:
            continue
        for seed in (0,) if subject.quick else (0, 1):
            sets, corners = _block_sets(subject, side, _EXACT_BLOCKS, count, dims, seed)
            union = np.ascontiguousarray(sets.transpose(0, 2, 1, 3)).reshape(_EXACT_BLOCKS, dims, together)
            try:
                for promise in [*nets, *subject.spec.promised(Strata)]:
                    judge_promise(subject, promise, union, together, seed=seed)
            except CheckFailed as failed:
                raise _locate(failed, side, count, corners) from None


def _locate(failed: CheckFailed, side: int, count: int, corners: NDArray[np.int64]) -> CheckFailed:
    """Return the failure of a union with the pixels that its points come from."""
    example = failed.example
    assert example is not None
    assert isinstance(example.realization, int)
    x, y = (int(c) for c in corners[example.realization])
    pixels = [divmod(index // count, side) for index in example.indices]
    owners = ", ".join(f"({x + column}, {y + row})" for row, column in dict.fromkeys(pixels[:4]))
    where = f", points of the pixels {owners}" if owners else ""
    return CheckFailed(
        f"the sets of the {side} x {side} pixels from ({x}, {y}) on, together: {failed.message}{where}",
        replace(example, count=count, realization=(x, y)),
    )


def _judge_errors(subject: SamplerSubject, side: int) -> None:
    dims = subject.dims(2)
    count = subject.counts(4, dims=dims)[0]
    sets, corners = _block_sets(subject, side, _BLOCKS, count, dims)
    for name, errors in _errors(sets):
        grid = errors.reshape(_BLOCKS, side, side)
        pixel = float((grid**2).mean())
        for square in dict.fromkeys((2, side)):
            if side % square or pixel == 0.0:
                continue
            squares = grid.reshape(_BLOCKS, side // square, square, side // square, square).mean(axis=(2, 4))
            left = square**2 * float((squares**2).mean()) / pixel
            if left > _LEFT:
                raise CheckFailed(
                    f"averaged over squares of {square} x {square} pixels, {left:.3g} of the variance of {name} is left"
                    f" that independent pixels would leave: less than {_LEFT:g} expected of {side} x {side} pixels that"
                    f" share one sequence ({_BLOCKS} blocks)",
                    subject.request(count, dims, realization=(int(corners[0, 0]), int(corners[0, 1]))),
                )


def _errors(sets: Array) -> list[tuple[str, Array]]:
    """Return the errors float64[K, pixels] of smooth integrands, by name."""
    if sets.shape[2] == 1:
        return [("x0", sets[:, :, 0].mean(axis=2) - 1 / 2)]
    return [
        ("x0 + x1", sets[:, :, :2].sum(axis=2).mean(axis=2) - 1.0),
        ("x0 x1", (sets[:, :, 0] * sets[:, :, 1]).mean(axis=2) - 1 / 4),
    ]
