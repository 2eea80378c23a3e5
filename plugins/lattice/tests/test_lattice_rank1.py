import hashlib

import numpy as np
import pytest
from samplekit_lattice.rank1 import generating_vector

import samplekit

REALIZATIONS = 100


def reversed_bits(index, bits):
    return int(f"{index:0{bits}b}"[::-1], 2)


def fractions(points):
    """The points as integers over 2^53, exactly."""
    return (points * 2.0**53).astype(np.uint64)


@pytest.mark.parametrize("vector", ["ckn", "hkkn"])
@pytest.mark.parametrize("bits", [0, 4, 7])
def test_powers_of_two_are_the_shifted_lattice(vector, bits):
    count = 2**bits
    dims = 10
    z = generating_vector(vector).tolist()
    points = samplekit.points(f"rank1:vector={vector}", count=count, dims=dims, realizations=REALIZATIONS)
    found = fractions(points)
    expected = [[reversed_bits(i, bits) * z[d] % count * (2**53 // count) for d in range(dims)] for i in range(count)]
    offsets = (found - np.array(expected, np.uint64)) % np.uint64(2**53)
    assert (offsets == offsets[:, :1]).all()
    assert len(np.unique(offsets[:, 0])) == REALIZATIONS * dims


def test_later_blocks_are_the_lattice_shifted():
    points = fractions(samplekit.points("rank1", count=64, dims=5)[0])
    first = {tuple(row) for row in (points[:16] - points[0]) % np.uint64(2**53)}
    for block in range(1, 4):
        rows = points[16 * block : 16 * block + 16]
        assert {tuple(row) for row in (rows - rows[0]) % np.uint64(2**53)} == first


@pytest.mark.parametrize("count", [1, 3, 16, 100, 1000])
def test_fewer_points_are_the_first_of_more(count):
    whole = samplekit.points("rank1", count=2000, dims=250, seed=4)
    assert np.array_equal(samplekit.points("rank1", count=count, dims=250, seed=4), whole[:, :count])
    part = samplekit.sampler("rank1").points(2000, 250, seed=4, start=count - 1, stop=count + 9)
    assert np.array_equal(part, whole[:, count - 1 : count + 9])


def test_every_dimension_is_a_sequence_in_base_2():
    points = samplekit.points("rank1", count=1024, dims=250, realizations=2)
    for block in range(0, 1024, 128):
        cells = np.sort(np.floor(points[:, block : block + 128] * 128), axis=1)
        assert (cells == np.arange(128)[:, None]).all()


@pytest.mark.parametrize(
    ("vector", "dims", "digest"),
    [
        ("ckn", 250, "9d6be8adc2d6db35a602a27b9bae8d0334ee21d02b81126ec7aba09d3600fe38"),
        ("hkkn", 10, "a453b9cdbf154921638b15abbeaedef650b05e6453682d715d5cb8bf86821d47"),
    ],
)
def test_vectors_are_as_published(vector, dims, digest):
    numbers = generating_vector(vector).tolist()
    assert len(numbers) == len(set(numbers)) == dims
    assert all(number % 2 for number in numbers)
    assert hashlib.sha256(",".join(map(str, numbers)).encode()).hexdigest() == digest


def test_pairs_of_dimensions_are_good_lattices():
    # The shortest vector of the lattice in each pair, against that of the densest lattice of as many points.
    count, z = 4096, generating_vector("ckn")[:20].astype(np.int64)
    index = np.arange(1, count)
    steps = index[:, None] * z % count
    squares = np.minimum(steps, count - steps) ** 2
    ratios = [
        np.sqrt((squares[:, i] + squares[:, j]).min()) / np.sqrt(2 * count / np.sqrt(3))
        for i in range(20)
        for j in range(i)
    ]
    assert np.median(ratios) > 0.5
    assert min(ratios) > 0.1


@pytest.mark.parametrize(
    ("text", "count", "dims", "message"),
    [
        ("rank1", 16, 251, "in 1 to 250 dimensions, not 251"),
        ("rank1:vector=hkkn", 16, 11, "in 1 to 10 dimensions, not 11"),
        ("rank1", 2**20 + 1, 2, "at most 1048576 points"),
        ("rank1:vector=korobov", 16, 2, "ckn or hkkn"),
    ],
)
def test_what_no_vector_has_is_refused(text, count, dims, message):
    with pytest.raises(samplekit.UsageError, match=message):
        samplekit.points(text, count=count, dims=dims)
