import numpy as np
import pytest

import samplekit


def words(points):
    assert np.array_equal(points * 2.0**53, np.floor(points * 2.0**53))
    return (points * 2.0**53).astype(np.uint64)


@pytest.mark.parametrize("name", ["sobol", "van-der-corput", "hammersley"])
def test_all_points_are_changed_by_the_same_word(name):
    plain = words(samplekit.points(name, 64, 1, realizations=50, seed=1))
    changed = words(samplekit.points(f"{name}+xor", 64, 1, realizations=50, seed=1))
    difference = plain ^ changed
    assert np.array_equal(difference, np.broadcast_to(difference[:, :1], difference.shape))
    assert np.unique(difference[:, 0]).size == 50


def test_bits_of_the_words_are_fair_and_dimensions_independent():
    """Bits of 10000 realisations by 4 dimensions, and correlations, within 5 standard errors: false alarms 1e-4."""
    found = words(samplekit.points("sobol+xor", 1, 4, realizations=10000, seed=2)[:, 0])
    bits = np.array([(found >> np.uint64(k) & np.uint64(1)).mean(axis=0) for k in range(53)])
    assert np.abs(bits - 0.5).max() < 5 * 0.5 / 100
    correlations = np.corrcoef(found.T.astype(float))[np.triu_indices(4, 1)]
    assert np.abs(correlations).max() < 5 / 100


def digits(x, base, places):
    """The first digits of the points; those are far from any edge under a scrambling."""
    found = []
    for _ in range(places):
        x = x * base
        digit = np.floor(x)
        found.append(digit.astype(int))
        x = x - digit
    return np.stack(found, axis=-1)


@pytest.mark.parametrize("base", [3, 5, 7, 10, 31])
def test_every_place_has_a_digit_added_modulo_the_base(base):
    plain = samplekit.points(f"van-der-corput:base={base}", 100, 1, realizations=40, seed=3)[:, :, 0]
    # Between fraction and fraction: the digits of an unscrambled point are taken inside of its cell.
    before = digits(plain + 0.25 / base**4, base, 3)
    after = digits(
        samplekit.points(f"van-der-corput:base={base}+xor", 100, 1, realizations=40, seed=3)[:, :, 0], base, 3
    )
    added = (after - before) % base
    assert np.array_equal(added, np.broadcast_to(added[:, :1], added.shape))


@pytest.mark.parametrize("base", [3, 5, 10])
def test_added_digits_are_uniform(base):
    """The first two digits of point 0, jointly, over 20000 realisations: chi-square, false alarms 1e-4 each."""
    from scipy import stats

    points = samplekit.points(f"van-der-corput:base={base}+xor", 1, 1, realizations=20000, seed=4)[:, 0, 0]
    cells = np.floor(points * base**2).astype(int)
    assert stats.chisquare(np.bincount(cells, minlength=base**2)).pvalue > 1e-4


def test_dimensions_of_halton_have_words_of_their_own():
    points = samplekit.points("halton+xor", 1, 10, realizations=10000, seed=5)[:, 0]
    correlations = np.corrcoef(points.T)[np.triu_indices(10, 1)]
    assert np.abs(correlations).max() < 5 / 100
    assert np.abs(points.mean(axis=0) - 0.5).max() < 5 * np.sqrt(1 / 12) / 100
