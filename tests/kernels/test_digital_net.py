import itertools

import numpy as np
import pytest

from samplekit.kernels._digital_net import BITS, net_coordinates

IDENTITY = 1 << np.arange(BITS - 1, -1, -1, dtype=np.uint32)
RNG = np.random.default_rng(11)
ARBITRARY = RNG.integers(0, 2**32, BITS, np.uint32)


def coordinates(columns, start, count):
    out = np.full(count, 0xDEADBEEF, np.uint32)
    getattr(net_coordinates, "py_func", net_coordinates)(out, columns.astype(np.uint32), start)
    return [int(x) for x in out]


def product(columns, index):
    """The generator matrix times the digits of the index, over the field of two elements."""
    result = 0
    for bit in range(BITS):
        if index >> bit & 1:
            result ^= int(columns[bit])
    return result


@pytest.mark.parametrize("start", [0, 1, 255, 2**16 - 3, 2**31 - 8, 2**32 - 16])
def test_coordinates_are_the_matrix_times_the_index(start):
    assert coordinates(ARBITRARY, start, 16) == [product(ARBITRARY, start + i) for i in range(16)]


def test_the_identity_mirrors_the_bits():
    assert coordinates(IDENTITY, 0, 64) == [int(f"{i:032b}"[::-1], 2) for i in range(64)]


def test_coordinates_are_linear_in_the_index():
    x = coordinates(ARBITRARY, 0, 64)
    assert all(x[i] ^ x[j] == x[i ^ j] for i in range(64) for j in range(64))


def test_pascals_matrix_beside_the_identity_is_a_net():
    """Faure's second matrix, binomials modulo 2, and the identity: one point in every elementary interval."""
    pascal = np.zeros(BITS, np.uint32)
    row = [1]
    for column in range(BITS):
        for digit in range(BITS):
            if digit < len(row) and row[digit] & 1:
                pascal[column] |= np.uint32(1 << (BITS - 1 - digit))
        row = [1, *(a + b for a, b in itertools.pairwise(row)), 1]
    for m in range(1, 9):
        for start in (0, 5 << m):
            x = np.array(coordinates(IDENTITY, start, 1 << m))
            y = np.array(coordinates(pascal, start, 1 << m))
            for q in range(m + 1):
                cells = (x >> (32 - q) << (m - q)) | (y >> (32 - (m - q)))
                assert sorted(cells) == list(range(1 << m))
