from fractions import Fraction

import numpy as np
import pytest
from scipy.stats import qmc

import samplekit

PRIMES = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71]


def mirrored(index, base):
    """The radical inverse: digit by digit, an exact fraction."""
    value, weight = Fraction(0), Fraction(1)
    while index:
        weight /= base
        value += weight * (index % base)
        index //= base
    return value


def van_der_corput(base, count):
    return samplekit.points(f"van-der-corput:base={base}", count, 1)[0, :, 0].tolist()


@pytest.mark.parametrize(
    ("base", "table"),
    [
        (2, "0 1/2 1/4 3/4 1/8 5/8 3/8 7/8 1/16 9/16 5/16 13/16 3/16 11/16 7/16 15/16"),
        (3, "0 1/3 2/3 1/9 4/9 7/9 2/9 5/9 8/9 1/27"),
        (5, "0 1/5 2/5 3/5 4/5 1/25 6/25"),
        (10, "0 1/10 2/10 3/10 4/10 5/10 6/10 7/10 8/10 9/10 1/100 11/100"),
    ],
)
def test_van_der_corputs_table(base, table):
    expected = [float(Fraction(text)) for text in table.split()]
    assert van_der_corput(base, len(expected)) == expected


def test_base_2_is_the_default():
    assert np.array_equal(samplekit.points("van-der-corput", 100, 1), samplekit.points("van-der-corput:base=2", 100, 1))


@pytest.mark.parametrize("base", [2, 3, 6, 10, 97, 1000])
def test_van_der_corput_is_the_exact_fraction_rounded(base):
    assert van_der_corput(base, 3000) == [float(mirrored(index, base)) for index in range(3000)]


@pytest.mark.parametrize("start", [0, 990, 2**16 - 2, 2**31 - 2, 2**32 - 2, 2**40 - 20])
def test_halton_is_the_exact_fractions_rounded(start):
    points = samplekit.sampler("halton").points(2**40, 20, start=start, stop=start + 20)[0]
    for i in range(20):
        assert points[i].tolist() == [float(mirrored(start + i, base)) for base in PRIMES], start + i


def test_halton_is_scipys():
    expected = qmc.Halton(50, scramble=False).random(500)
    assert np.abs(samplekit.points("halton", 500, 50)[0] - expected).max() < 1e-15


def test_haltons_last_dimension():
    """The 1024th prime is 8161."""
    points = samplekit.points("halton", 10000, 1024)[0, :, -1]
    assert points[[1, 8160, 8161, 8162]].tolist() == [float(mirrored(i, 8161)) for i in (1, 8160, 8161, 8162)]


@pytest.mark.parametrize("count", [1, 2, 3, 7, 49, 97, 1000, 1024, 1999])
def test_hammersley_is_the_exact_fractions_rounded(count):
    points = samplekit.points("hammersley", count, 6)[0].tolist()
    for index in range(0, count, max(1, count // 200)):
        expected = [Fraction(index, count), *(mirrored(index, base) for base in PRIMES[:5])]
        assert points[index] == [float(x) for x in expected]


@pytest.mark.parametrize(("count", "start"), [(2**40, 2**40 - 5), (2**40 - 3, 2**39), (10**12, 10**12 - 5)])
def test_hammersley_at_large_indices(count, start):
    points = samplekit.sampler("hammersley").points(count, 3, start=start, stop=start + 5)[0]
    for i, point in enumerate(points.tolist(), start=start):
        assert point == [float(Fraction(i, count)), float(mirrored(i, 2)), float(mirrored(i, 3))]
        assert point[0] < 1.0


def test_hammersley_of_four_points():
    assert samplekit.points("hammersley", 4)[0].tolist() == [[0.0, 0.0], [0.25, 0.5], [0.5, 0.25], [0.75, 0.75]]


def star_discrepancy(points):
    """Exactly, in two dimensions: over all boxes whose sides are at coordinates of points, open and closed."""
    n = len(points)
    x, y = np.append(points[:, 0], 1.0), np.append(points[:, 1], 1.0)
    volume = np.multiply.outer(x, y)
    closed = (points[:, 0] <= x[:, None]).astype(int) @ (points[:, 1] <= y[:, None]).astype(int).T
    opened = (points[:, 0] < x[:, None]).astype(int) @ (points[:, 1] < y[:, None]).astype(int).T
    return max((closed / n - volume).max(), (volume - opened / n).max())


@pytest.mark.parametrize("bits", range(2, 9))
def test_hammersleys_star_discrepancy(bits):
    """N D* = n/3 + 13/9 - (-1)^n 4 / (9 2^n) for N = 2^n points (Halton and Zaremba 1969)."""
    count = 2**bits
    expected = bits / 3 + 13 / 9 - (-1) ** bits * 4 / (9 * count)
    assert star_discrepancy(samplekit.points("hammersley", count)[0]) * count == pytest.approx(expected, abs=1e-12)


def test_realisations_without_a_randomizer_are_the_same():
    for text in ("halton", "hammersley"):
        points = samplekit.points(text, 64, 3, realizations=4, seed=9)
        assert np.array_equal(points, np.broadcast_to(points[0], points.shape))
