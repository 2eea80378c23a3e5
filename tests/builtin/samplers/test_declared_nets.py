"""Every net that a sampler declares: each elementary interval of each block holds its b^t points, exactly.

Rational arithmetic judges, but for unscrambled points in a base other than 2: 1/3 is no float64, so that an interval's
edge is the float64 nearest to it, as the point is.
"""

import itertools

import numpy as np
import pytest

import samplekit
from samplekit import Net
from samplekit._builtin import samplekit_samplers

MOST_POINTS = 4096
CASES = [
    pytest.param(spec.name + suffix, promise, id=f"{spec.name}{suffix} {promise.dims} base {promise.base}")
    for spec in samplekit_samplers()
    for promise in spec.promises
    if isinstance(promise, Net)
    for suffix in ("", "+xor", "+owen")
]


def shapes(dims, m):
    """All ways to share m digits among the dimensions."""
    return [q for q in itertools.product(range(m + 1), repeat=dims) if sum(q) == m]


def is_net(points, promise, m, cells_of):
    """Whether b^m points are a (t, m, s)-net."""
    base, t = promise.base, promise.t
    finest = [cells_of(points[:, d], base**m) for d in promise.dims]
    for shape in shapes(len(promise.dims), m - t):
        index = np.zeros(len(points), np.int64)
        for cells, digits in zip(finest, shape, strict=True):
            index = index * base**digits + cells // base ** (m - digits)
        if not (np.bincount(index, minlength=base ** (m - t)) == base**t).all():
            return False
    return True


def blocks(text, promise, m, realizations, seed):
    sampler = samplekit.sampler(text)
    dims = max(*promise.dims, *sampler.spec.dimensions[:1]) + 1
    size = promise.base**m
    if not promise.sequence:
        yield from sampler.points(size, dims, realizations=realizations, seed=seed)
        return
    for block in (0, 1, 5):
        start = block * size
        yield from sampler.points(
            start + size, dims, realizations=realizations, seed=seed, start=start, stop=start + size
        )


@pytest.mark.parametrize(("text", "promise"), CASES)
def test_declared_nets(text, promise, exact_cells, rounded_cells):
    realizations = 8 if "+" in text else 1
    cells_of = exact_cells if "+" in text or promise.base == 2 else rounded_cells
    for m in (m for m in range(promise.t + 1, 13) if promise.base**m <= MOST_POINTS):
        for points in blocks(text, promise, m, realizations, seed=m):
            assert is_net(points, promise, m, cells_of), m


@pytest.mark.parametrize("text", ["sobol+owen", "sobol+xor", "halton+owen", "halton+xor"])
def test_scrambled_nets_over_many_realisations(text, exact_cells):
    for promise in samplekit.sampler(text).spec.promises:
        m = {2: 6, 3: 4, 5: 3}[promise.base]
        for points in blocks(text, promise, m, 200, seed=1):
            assert is_net(points, promise, m, exact_cells)


@pytest.mark.parametrize("name", ["sobol", "hammersley"])
def test_a_shift_breaks_nets_and_no_net_is_declared(name, exact_cells):
    assert not any(isinstance(promise, Net) for promise in samplekit.sampler(f"{name}+shift").spec.promises)
    sets = samplekit.points(f"{name}+shift", 256, realizations=50)
    assert sum(is_net(points, Net(), 8, exact_cells) for points in sets) < 5


def test_blocks_that_do_not_start_at_a_power_are_no_nets(exact_cells):
    """The check tells: Sobol' without its first point, and points that are merely random."""
    assert not is_net(samplekit.points("sobol", 257)[0, 1:], Net(), 8, exact_cells)
    assert not is_net(samplekit.points("random", 256)[0], Net(), 8, exact_cells)
    assert is_net(samplekit.points("sobol", 256)[0], Net(), 8, exact_cells)


@pytest.mark.parametrize("base", [2, 3, 4, 6, 8, 10, 16])
@pytest.mark.parametrize("randomizer", ["", "+xor"])
def test_van_der_corput_is_a_net_in_its_base(base, randomizer, exact_cells, rounded_cells):
    cells_of = exact_cells if randomizer else rounded_cells
    for m in range(1, 4):
        size = base**m
        for start in (0, size, 5 * size):
            sets = samplekit.sampler(f"van-der-corput:base={base}{randomizer}").points(
                start + size, 1, realizations=4, seed=m, start=start
            )
            for points in sets:
                assert is_net(points, Net((0,), base), m, cells_of)


@pytest.mark.parametrize("base", [3, 7, 31, 997])
@pytest.mark.parametrize("randomizer", ["xor", "owen"])
def test_van_der_corput_is_a_net_in_primes(base, randomizer, exact_cells):
    for points in samplekit.points(f"van-der-corput:base={base}+{randomizer}", base**2, 1, realizations=3)[:, :, :1]:
        assert is_net(points[:base], Net((0,), base), 1, exact_cells)
        assert is_net(points, Net((0,), base), 2, exact_cells)
