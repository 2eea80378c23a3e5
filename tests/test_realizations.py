from dataclasses import replace

import numpy as np
import pytest

import samplekit
from samplekit import Realizations, Sampler, SamplerSpec, UsageError, seed_words
from samplekit._bases.realizations import LARGEST_COORDINATE, _mix64
from samplekit.kernels import kernel, mix64, pixel_key

GOLDEN = 0x9E3779B97F4A7C15
SEEDS = [0, 1, 2, 2**32, 2**63, 2**64 - 1]


def image_keys(width, height, seed, left=0, top=0):
    y, x = np.mgrid[top : top + height, left : left + width]
    return Realizations.of_pixels(x.ravel(), y.ravel(), seed).keys


def test_keys_are_distinct_over_an_image_and_over_seeds():
    """Three images of 2^18 keys: a chance coincidence among 64-bit words has probability 2e-8."""
    keys = np.concatenate([image_keys(512, 512, seed) for seed in (0, 1, 2**64 - 1)])
    assert np.unique(keys).size == 3 * 512 * 512


def unmixed(word):
    """The inverse of mix64."""
    word ^= word >> 31 ^ word >> 62
    word = word * pow(0x94D049BB133111EB, -1, 2**64) % 2**64
    word ^= word >> 27 ^ word >> 54
    word = word * pow(0xBF58476D1CE4E5B9, -1, 2**64) % 2**64
    return word ^ word >> 30 ^ word >> 60


def structured_seeds():
    """A million seeds: small ones, powers of two and their neighbours, and those whose words are near another seed's.

    A first word that differs from another seed's by the code x | y << 32 of a pixel moves the codes of all pixels.
    """
    assert mix64(np.uint64(unmixed(12345))) == 12345
    codes = [x | y << 32 for y in range(64) for x in range(64)]
    seeds = set(range(500_000))
    seeds.update((sign * 2**k + j) % 2**64 for k in range(64) for j in range(-500, 500) for sign in (1, -1))
    for seed in (*range(20), 2**63, 2**64 - 1):
        first, second = map(int, seed_words(seed))
        seeds.update(unmixed(first ^ code) ^ GOLDEN for code in codes)
        seeds.update(unmixed((second + code) % 2**64) for code in codes[:1000])
    assert 12358395470402263640 in seeds
    random = np.random.default_rng(0).integers(0, 2**64, 1_000_000 - len(seeds), dtype=np.uint64)
    return np.concatenate([np.array(sorted(seeds), np.uint64), random])


@kernel("void(uint64[:,::1], uint64[:,::1], int64, int64)")
def sum_images(sums, words, width, height):
    """Hash the set of keys of each seed's image: the sum of a hash of each key, which their order does not change."""
    for s in range(words.shape[0]):
        for y in range(height):
            for x in range(width):
                sums[s, 0] += mix64(pixel_key(x, y, words[s, 0], words[s, 1]))


def check_no_image_is_a_permutation_of_another(sizes):
    """Images that are permutations of each other have equal sums; a chance coincidence has probability 3e-8 a size."""
    seeds = np.unique(structured_seeds())
    assert seeds.size > 999_000
    words = np.stack([_mix64(seeds ^ np.uint64(GOLDEN)), _mix64(seeds)], axis=1)
    assert words[:1000].tolist() == [[*map(int, seed_words(seed))] for seed in seeds[:1000]]
    for width, height in sizes:
        sums = np.zeros((seeds.size, 1), np.uint64)
        sum_images(sums, words, width, height)
        assert np.unique(sums).size == seeds.size


def test_no_small_image_of_a_million_seeds_is_a_permutation_of_another():
    check_no_image_is_a_permutation_of_another([(1, 1), (2, 1), (1, 2), (2, 2), (4, 4)])


@pytest.mark.slow
def test_no_image_of_a_million_seeds_is_a_permutation_of_another():
    check_no_image_is_a_permutation_of_another([(3, 1), (3, 3), (8, 8), (64, 1), (1, 64), (16, 16), (32, 32), (64, 64)])


def test_seeds_whose_words_differ_by_a_pixel_have_other_points():
    """With one word for each seed, the image of the first seed was that of seed 0 with neighbouring pixels swapped."""
    for seed in (12358395470402263640, unmixed(int(seed_words(7)[0]) ^ 1 << 32) ^ GOLDEN):
        for of in (0, 7):
            assert not np.intersect1d(image_keys(8, 8, seed), image_keys(8, 8, of)).size


def test_kernels_make_the_same_keys():
    x, y = np.array([0, 5, 2**32 - 1]), np.array([7, 2**32 - 1, 3])
    for seed in SEEDS:
        keys = [pixel_key(*pixel, *seed_words(seed)) for pixel in zip(x.tolist(), y.tolist(), strict=True)]
        assert Realizations.of_pixels(x, y, seed).keys.tolist() == keys


def test_keys_of_seed_0():
    """Numbers of version 0.1.0, which had no second word: seed 0 keeps its points."""
    code = np.arange(4, dtype=np.uint64) | np.uint64(9 << 32)
    expected = [int(mix64(word ^ mix64(np.uint64(GOLDEN)))) for word in code]
    assert Realizations.of_pixels(np.arange(4), np.full(4, 9), 0).keys.tolist() == expected


def test_a_trial_is_a_pixel_of_the_first_row():
    trials = samplekit.sampler("random").trials(3, 11, 5)
    pixels = Realizations.of_pixels(np.arange(3, 11), np.zeros(8, np.int64), 5)
    assert np.array_equal(trials.keys, pixels.keys)
    assert trials.x.tolist() == list(range(3, 11))
    assert not trials.y.any()
    assert len(trials) == 8


BLOCKS = ["z-sobol", "z-sobol+shift", "z-sobol+owen", "z-sobol:orders=random"]


@pytest.mark.parametrize("text", BLOCKS)
@pytest.mark.parametrize("apart", [1, 64, 4099])
@pytest.mark.parametrize("start", [0, 1_047_000, 66_076_000, 2**31, 2**35])
def test_trials_are_in_blocks_of_their_own(text, apart, start):
    """Randomizers do not make the shapes of the sets of a block independent."""
    trials = samplekit.sampler(text).trials(start, start + 2000, 1, apart=apart)
    assert np.unique(np.stack([trials.x >> 6, trials.y >> 6]), axis=1).shape[1] == 2000
    assert np.unique(trials.x & 63).size == 64
    part = samplekit.sampler(text).trials(start + 700, start + 900, 1, apart=apart)
    assert np.array_equal(part.keys, trials.keys[700:900])


def test_rows_of_trials_end_before_the_largest_coordinate():
    for apart, columns in ((1, 2**32), (4099, 1_047_809), (65, 66_076_420)):
        trials = samplekit.sampler("random").trials(columns - 1, columns + 2, 0, apart=apart)
        assert trials.x.tolist() == [(columns - 1) * apart, 0, apart]
        assert trials.y.tolist() == [0, apart, apart]
        assert (columns - 1) * apart <= LARGEST_COORDINATE < columns * apart
    with pytest.raises(UsageError, match="from 0 to 4294967295"):
        samplekit.sampler("random").trials(-1, 1, 0)


def test_a_block_that_the_options_decide_counts():
    trials = samplekit.sampler(SamplerSpec("tiled", f"{__name__}:Tiled", "a block")).followed_by("owen").trials(0, 3, 0)
    assert trials.x.tolist() == [0, 17, 34]


class Tiled(Sampler):
    def refine(self, spec):
        return replace(spec, screen_block=16)

    def fill(self, out, realizations, count, start):
        out[:] = 0.5


def test_the_points_of_a_trial_are_those_of_the_pixel():
    out = np.empty((2, 2, 9))
    samplekit.sampler("random").fill(out, Realizations.of_pixels(np.array([6, 1]), np.array([0, 0]), 8), 9, 0)
    points = samplekit.points("random", 9, realizations=7, seed=8)
    assert np.array_equal(out.transpose(0, 2, 1), points[[6, 1]])


def test_extreme_coordinates_have_keys_of_their_own():
    values = [0, 1, 2**16 - 1, 2**16, 2**16 + 1, 2**31 - 1, 2**31, 2**32 - 2, 2**32 - 1]
    x, y = (grid.ravel() for grid in np.meshgrid(values, values))
    keys = Realizations.of_pixels(x, y, 0).keys
    assert np.unique(keys).size == keys.size
    assert LARGEST_COORDINATE == 2**32 - 1


@pytest.mark.parametrize("coordinate", [-1, 2**32, -(2**63), 2**63 - 1])
def test_coordinates_out_of_range_are_errors(coordinate):
    good, bad = np.array([0]), np.array([coordinate], np.int64)
    for x, y in ((good, bad), (bad, good)):
        with pytest.raises(UsageError, match="from 0 to 4294967295"):
            Realizations.of_pixels(x, y, 0)


@pytest.mark.parametrize("seed", SEEDS)
def test_every_seed_gives_points(seed):
    points = samplekit.points("jittered", 16, realizations=3, seed=seed)
    assert points.min() >= 0.0
    assert points.max() < 1.0
    assert np.array_equal(points, samplekit.points("jittered", 16, realizations=3, seed=np.uint64(seed)))


def test_seeds_give_other_points():
    sets = [samplekit.points("random", 16, seed=seed) for seed in SEEDS]
    assert np.unique(np.concatenate(sets)).size == 16 * 2 * len(SEEDS)


@pytest.mark.parametrize("seed", [-1, 2**64, 1.0, 1.5, "1", None, True, float("nan")])
def test_bad_seeds_are_errors(seed):
    for request in (
        lambda: samplekit.points("random", 4, seed=seed),
        lambda: samplekit.estimate("disk", "random", 4, seed=seed),
        lambda: samplekit.sampler("random").trials(0, 1, seed),
    ):
        with pytest.raises(UsageError, match="expected an integer from 0 to 18446744073709551615"):
            request()


def test_a_slice_is_the_same_realisations():
    whole = samplekit.sampler("random").trials(0, 10, 1)
    part = whole[3:7]
    assert np.array_equal(part.keys, whole.keys[3:7])
    assert part.x.tolist() == [3, 4, 5, 6]
    assert part.seed == 1


def test_random_words_depend_on_key_and_dimension_alone():
    realizations = samplekit.sampler("random").trials(0, 100, 1)
    words = realizations.random_words(8)
    assert words.shape == (100, 8)
    assert words.dtype == np.uint64
    assert np.unique(words).size == 800
    assert np.array_equal(realizations.random_words(3), words[:, :3])
    assert np.array_equal(realizations[40:].random_words(8), words[40:])
    assert not np.intersect1d(words, samplekit.sampler("random").trials(0, 100, 2).random_words(8)).size


def test_bits_of_keys_and_words_are_fair():
    """Each bit over 2^16 pixels, and over 8192 pixels by 8 dimensions: within 5 standard errors (false alarms 7e-5)."""
    keys = image_keys(256, 256, 3, left=2**31, top=7)
    words = samplekit.sampler("random").trials(0, 8192, 3).random_words(8).ravel()
    for sample in (keys, words):
        for bit in range(64):
            ones = np.count_nonzero(sample >> np.uint64(bit) & np.uint64(1))
            assert abs(ones / 65536 - 0.5) < 5 * 0.5 / 256


def test_every_other_realisation():
    every, other = np.empty((10, 2, 4)), np.empty((5, 2, 4))
    realizations = samplekit.sampler("random").trials(0, 10, 0)
    sampler = samplekit.sampler("random")
    sampler.fill(every, realizations, 4, 0)
    sampler.fill(other, realizations[::2], 4, 0)
    assert np.array_equal(every[::2], other)
