import numpy as np
import pytest

import samplekit
from samplekit.kernels import _hashing as hashing

WORD = 2**64 - 1
RNG = np.random.default_rng(20240607)
WORDS = np.concatenate([np.array([0, 1, 2**32, 2**63, WORD], np.uint64), RNG.integers(0, WORD, 2000, np.uint64, True)])


def plain(function):
    """The helper as Python sees it, on arrays as well; that integers wrap is meant."""
    return np.errstate(over="ignore")(getattr(function, "py_func", function))


mix64, dimension_key, second_key = plain(hashing.mix64), plain(hashing.dimension_key), plain(hashing.second_key)
hash_index, unit, below = plain(hashing.hash_index), plain(hashing.unit), plain(hashing.below)


def mix(x):
    """SplitMix64's finaliser with Stafford's constants 13, on Python's integers."""
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 & WORD
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB & WORD
    return x ^ (x >> 31)


def unmix(x):
    """Its inverse: every step backwards."""
    x ^= (x >> 31) ^ (x >> 62)
    x = x * pow(0x94D049BB133111EB, -1, 2**64) & WORD
    x ^= (x >> 27) ^ (x >> 54)
    x = x * pow(0xBF58476D1CE4E5B9, -1, 2**64) & WORD
    return x ^ (x >> 30) ^ (x >> 60)


def random_point(seed, x, y, dimension, index):
    """A coordinate of the sampler `random`, from the definition of its numbers alone."""
    key = (mix((x | y << 32) ^ mix(seed ^ 0x9E3779B97F4A7C15)) + mix(seed)) & WORD
    key = mix(key ^ ((dimension + 1) * 0xD1342543DE82EF95 & WORD))
    second = mix((key + 0xA0761D6478BD642F) & WORD)
    word = ((index + 1) * 0x9E3779B97F4A7C15 + key) & WORD
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9 & WORD
    word ^= second
    word = (word ^ (word >> 27)) * 0x94D049BB133111EB & WORD
    word ^= word >> 31
    return (word >> 11) / 2**53


def test_the_mix_is_a_bijection():
    mixed = mix64(WORDS)
    assert [unmix(int(word)) for word in mixed] == WORDS.tolist()
    assert mixed.tolist() == [mix(int(word)) for word in WORDS]


@pytest.mark.parametrize("seed", [0, 1, 2**63, WORD])
def test_points_are_those_of_the_definition(seed):
    points = samplekit.points("random", 20, 3, realizations=4, seed=seed)
    expected = [[[random_point(seed, r, 0, d, i) for d in range(3)] for i in range(20)] for r in range(4)]
    assert points.tolist() == expected


def test_points_of_far_pixels_and_indices_are_those_of_the_definition():
    x, y = np.array([0, 2**31 - 1, 2**32 - 1]), np.array([2**32 - 1, 65537, 0])
    out = np.empty((3, 2, 4))
    start = 2**63 - 4
    samplekit.sampler("random").fill(out, samplekit.Realizations.of_pixels(x, y, 7), 2**63, start)
    for r, d, i in np.ndindex(out.shape):
        assert out[r, d, i] == random_point(7, int(x[r]), int(y[r]), d, start + i)


def test_unit_is_below_one_for_all_ones():
    assert unit(np.uint64(WORD)) == hashing.ONE_MINUS_EPSILON == float(np.nextafter(1.0, 0.0)) < 1.0
    assert unit(np.uint64(0)) == 0.0
    assert unit(np.uint64(1 << 11)) == 2.0**-53


def test_below_reaches_every_value_and_never_the_bound():
    for bound in (1, 2, 3, 1000, 2**31 + 1, 2**32 - 1):
        assert below(np.uint64(WORD), np.uint64(bound)) == bound - 1
        assert below(np.uint64(0), np.uint64(bound)) == 0
    assert set(below(WORDS, np.uint64(7)).tolist()) == set(range(7))


def flips(function, bit):
    """How often each output bit flips with an input bit, over random words."""
    changed = function(WORDS) ^ function(WORDS ^ np.uint64(1 << bit))
    return np.array([np.count_nonzero(changed >> np.uint64(out) & np.uint64(1)) for out in range(64)]) / WORDS.size


@pytest.mark.parametrize(
    "function",
    [
        mix64,
        second_key,
        lambda words: dimension_key(words, 2),
        lambda words: hash_index(words, mix64(words), np.uint64(5)),
        lambda words: hash_index(mix64(WORDS), mix64(mix64(WORDS)), words),
    ],
    ids=["mix64", "second_key", "dimension_key", "hash_index by key", "hash_index by index"],
)
def test_avalanche(function):
    """Each input bit flips each output bit with probability 1/2.

    20480 frequencies of 2005 words each have standard error 0.0112: the limit is 6.3 of them, false alarms 7e-6.
    """
    worst = max(np.abs(flips(function, bit) - 0.5).max() for bit in range(64))
    assert worst < 0.07


def test_keys_of_dimensions_and_second_keys_are_distinct():
    keys = mix64(np.arange(1000, dtype=np.uint64))
    by_dimension = np.concatenate([dimension_key(keys, d) for d in range(64)])
    assert np.unique(np.concatenate([keys, by_dimension, second_key(keys)])).size == 66 * keys.size


def test_realisations_are_not_the_same_walk_at_another_offset():
    """One word of key would give pixels whose keys differ by a multiple of the step the same points; two do not."""
    key = np.uint64(12345)
    along = [hash_index(key, second_key(key), np.arange(1000, dtype=np.uint64))]
    for steps in (1, 2, 17):
        moved = key + np.uint64(steps * int(hashing.GOLDEN) & WORD)
        along.append(hash_index(moved, second_key(moved), np.arange(1000, dtype=np.uint64)))
    assert np.unique(np.concatenate(along)).size == 4000
