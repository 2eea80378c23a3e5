"""Every elementary interval of every net that a built-in sampler declares, in the first block and in later ones."""

import itertools
import math

import numpy as np
import pytest

import samplekit
from samplekit import Net

TEXTS = [
    f"{name}{suffix}"
    for name in ("halton", "hammersley", "sobol", "niederreiter", "faure")
    for suffix in ("", "+owen", "+xor")
] + [
    *("halton:scramble=digits", "halton:scramble=owen", "faure:base=2+owen", "faure:base=3", "faure:base=7+xor"),
    *("owen-sobol", "pmj02", "z-sobol", "z-sobol:orders=random"),
]
BLOCKS = (0, 1, 5)
WORK = 1 << 20


def shapes(digits, dims):
    if dims == 1:
        return [(digits,)]
    return [(first, *rest) for first in range(digits + 1) for rest in shapes(digits - first, dims - 1)]


def cells_of(x, cells):
    """The cell of each coordinate; a boundary is the float nearest to it, as the exact coordinate's float is."""
    found = np.floor(x * cells).astype(np.int64)
    found -= x < found / cells
    found += x >= (found + 1) / cells
    return found


def broken_interval(points, base, t):
    """The shape of an interval that does not hold b^t of the points [R, n, s]; None if there is none."""
    sets, count, dims = points.shape
    digits = round(math.log(count, base)) - t
    finest = cells_of(points, base**digits)
    offsets = np.arange(sets)[:, None] * base**digits
    for shape in shapes(digits, dims):
        cell = np.zeros((sets, count), np.int64)
        for dimension, q in enumerate(shape):
            cell = cell * base**q + finest[:, :, dimension] // base ** (digits - q)
        held = np.bincount((cell + offsets).ravel(), minlength=sets * base**digits)
        if not (held == base**t).all():
            return shape
    return None


@pytest.mark.parametrize("text", TEXTS)
def test_every_elementary_interval(text):
    sampler = samplekit.sampler(text)
    nets = [promise for promise in sampler.spec.promises if isinstance(promise, Net)]
    assert nets
    judged = 0
    for net in nets:
        for m in range(max(net.t, 1), 15):
            count = net.base**m
            work = count * math.comb(m - net.t + len(net.dims) - 1, len(net.dims) - 1)
            if count > 1 << 14 or work > WORK:
                break
            realizations = max(1, min(100, WORK // work // len(nets))) if sampler.spec.randomized else 1
            for block in BLOCKS if net.sequence else (0,):
                points = sampler.points(
                    (block + 1) * count,
                    max(net.dims) + 1,
                    realizations=realizations,
                    seed=m,
                    start=block * count,
                    stop=(block + 1) * count,
                )
                found = broken_interval(points[:, :, list(net.dims)], net.base, net.t)
                assert found is None, (net, m, block, found)
                judged += 1
    assert judged >= 2


def test_a_net_that_lacks_a_point_is_found():
    points = samplekit.points("sobol+owen", 64, realizations=3)
    assert broken_interval(points, 2, 0) is None
    points[1, 17] = points[1, 18]
    assert broken_interval(points, 2, 0) is not None


@pytest.mark.parametrize(("text", "dims", "t"), [("owen-sobol", 8, 2), ("pmj02", 8, 0)])
def test_pairs_within_a_block_at_1024_points(text, dims, t):
    block = 4 if text == "owen-sobol" else 2
    points = samplekit.points(text, 1024, dims, realizations=4, seed=3)
    for first in range(0, dims, block):
        for pair in itertools.combinations(range(first, first + block), 2):
            assert broken_interval(points[:, :, list(pair)], 2, t) is None, pair
