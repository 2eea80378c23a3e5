import numpy as np
import pytest
from scipy import stats

import samplekit


def prefix_length(x, y):
    """Number of binary digits, up to 32, that two fractions have in common."""
    difference = (x * 2.0**32).astype(np.uint64) ^ (y * 2.0**32).astype(np.uint64)
    return 32 - np.ceil(np.log2(difference + 1.0)).astype(int)


@pytest.mark.parametrize("text", ["sobol", "halton", "van-der-corput"])
def test_points_keep_the_number_of_digits_that_they_share(text):
    plain = samplekit.points(text, 200, 1, realizations=10, seed=1)[:, :, 0]
    scrambled = samplekit.points(f"{text}+owen", 200, 1, realizations=10, seed=1)[:, :, 0]
    for i in (0, 1, 57):
        before, after = (prefix_length(x[:, i : i + 1], np.delete(x, i, axis=1)) for x in (plain, scrambled))
        assert np.array_equal(before, after)


@pytest.mark.parametrize("name", ["sobol", "hammersley", "halton", "van-der-corput"])
def test_scrambling_is_the_same_fused_and_apart(name):
    """Sobol' scrambles its integers at once; the randomizer does the same to finished points."""
    from samplekit._builtin.randomizers.owen import Owen

    dims = 1 if name == "van-der-corput" else 4
    realizations = samplekit.sampler("random").trials(0, 6, 2)
    sampler, plain = samplekit.sampler(f"{name}+owen"), samplekit.sampler(name)
    fused, apart = np.empty((2, 6, dims, 500))
    sampler.fill(fused, realizations, 3000, 2000)
    plain.fill(apart, realizations, 3000, 2000)
    bases = {"sobol": (2, 2, 2, 2), "hammersley": (2, 2, 3, 5), "halton": (2, 3, 5, 7), "van-der-corput": (2,)}[name]
    Owen().apply(apart, realizations, bases)
    assert np.array_equal(fused, apart)


WORD = 2**64 - 1


def mix(x):
    """SplitMix64's finaliser on Python's integers."""
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 & WORD
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB & WORD
    return x ^ (x >> 31)


def reversed_bits(x):
    return int(f"{x:032b}"[::-1], 2)


def scrambled(x, seed, pixel, dimension):
    """A 32-bit fraction scrambled, as a 53-bit one, from the definition in Python's integers."""
    key = (mix(pixel ^ mix(seed ^ 0x9E3779B97F4A7C15)) + mix(seed)) & WORD
    key = mix(mix(key ^ ((dimension + 1) * 0xD1342543DE82EF95 & WORD)) ^ 0x510E527FADE682D1)
    x = reversed_bits(x)
    x ^= x * 0x3D20ADEA % 2**32
    x = (x + key) * (key >> 32 | 1) % 2**32
    x ^= x * 0x05526C56 % 2**32
    x ^= x * 0x53A22864 % 2**32
    return reversed_bits(x) << 21 | mix((key + 0x9B05688C2B3E6C1F) & WORD) >> 43


@pytest.mark.parametrize("seed", [0, 2**64 - 1])
def test_points_are_those_of_the_definition(seed):
    plain = (samplekit.points("sobol", 50, 3)[0] * 2.0**32).astype(int).tolist()
    points = samplekit.points("sobol+owen", 50, 3, realizations=4, seed=seed)
    expected = [[[scrambled(x, seed, r, d) for d, x in enumerate(point)] for point in plain] for r in range(4)]
    assert (points * 2.0**53).astype(int).tolist() == expected


def nested_scrambling(points, digits, realizations, rng):
    """Owen 1995 to the letter in base 2: a fair coin at every node of the tree of digits; [N] to [R, N]."""
    numerators = np.round(points * 2**digits).astype(int)
    result = np.zeros((realizations, points.size))
    for k in range(digits):
        coins = rng.integers(0, 2, (realizations, 2**k))
        nodes = numerators >> (digits - k)
        bit = numerators >> (digits - 1 - k) & 1
        result += (bit ^ coins[:, nodes]) * 2.0 ** -(k + 1)
    return result + rng.random(result.shape) * 2.0**-digits


INTEGRANDS = {
    "bell": lambda x, y: np.exp(-((x - 0.4523) ** 2 + (y - 0.5317) ** 2) / 0.125),
    "disk": lambda x, y: ((x - 0.4523) ** 2 + (y - 0.5317) ** 2 < 0.09).astype(float),
    "product": lambda x, y: x * y,
    "wave": lambda x, y: np.cos(2 * np.pi * (3 * x + 2 * y)),
}


@pytest.mark.parametrize("bits", [2, 4, 6])
def test_the_variance_is_that_of_true_nested_scrambling(bits):
    """20000 realisations of either, four integrands: within 4.5 standard errors of 1.4 %, false alarms 5e-5."""
    realizations = 20000
    sobol = samplekit.points("sobol", 2**bits)[0]
    rng = np.random.default_rng(bits)
    x, y = (nested_scrambling(sobol[:, d], bits, realizations, rng) for d in range(2))
    hashed = samplekit.points("sobol+owen", 2**bits, realizations=realizations, seed=bits)
    for name, integrand in INTEGRANDS.items():
        true, found = integrand(x, y).mean(axis=1), integrand(hashed[:, :, 0], hashed[:, :, 1]).mean(axis=1)
        kurtosis = max(stats.kurtosis(values, fisher=False) for values in (true, found))
        error = np.sqrt(2 * (kurtosis - 1) / realizations)
        assert abs(found.var() / true.var() - 1) < 4.5 * error, name
        assert abs(found.mean() - true.mean()) < 4.5 * np.sqrt(2 * true.var() / realizations), name


@pytest.mark.parametrize("dimension", [0, 1, 2, 3, 4, 5])
def test_pairs_of_digits_go_to_pairs_of_distinct_digits_in_primes(dimension):
    """Points 0 and k in base b: every pair of distinct first digits equally often; false alarms 1e-4 each."""
    base = [2, 3, 5, 7, 11, 13][dimension]
    points = samplekit.points("halton+owen", base, 6, realizations=20000, seed=6)[:, :, dimension]
    digits = np.floor(points * base).astype(int)
    assert (np.sort(digits, axis=1) == np.arange(base)).all()
    for other in {1, base // 2, base - 1} - {0}:
        pairs = np.bincount(digits[:, 0] * base + digits[:, other], minlength=base * base).reshape(base, base)
        assert not pairs.diagonal().any()
        assert stats.chisquare(pairs[~np.eye(base, dtype=bool)]).pvalue > 1e-4


@pytest.mark.parametrize(("dimension", "base"), [(1, 3), (2, 5)])
def test_second_digits_are_permuted_on_their_own_under_every_first_digit(dimension, base):
    """Second digits: distinct under the same first digit, independent under others; false alarms 1e-4 each."""
    points = samplekit.points("halton+owen", base**2, 3, realizations=20000, seed=7)[:, :, dimension]
    cells = np.floor(points * base**2).astype(int)
    assert (np.sort(cells, axis=1) == np.arange(base**2)).all()
    first, second = cells // base, cells % base
    # Points k and k + base share their first digit: it is the last of the index.
    assert np.array_equal(first[:, 0], first[:, base])
    same = np.bincount(second[:, 0] * base + second[:, base], minlength=base**2).reshape(base, base)
    assert not same.diagonal().any()
    assert stats.chisquare(same[~np.eye(base, dtype=bool)]).pvalue > 1e-4
    for codes in (second[:, 0] * base + second[:, 1], first[:, 0] * base + second[:, 0]):
        assert stats.chisquare(np.bincount(codes, minlength=base**2)).pvalue > 1e-4


@pytest.mark.parametrize("randomizer", ["owen", "xor"])
def test_digits_past_the_last_are_random(randomizer):
    """In base 7919 three digits reach 2^-39: what follows is uniform over realisations, false alarms 1e-4 each."""
    points = samplekit.points(f"halton+{randomizer}", 2, 1000, realizations=1000, seed=10)[:, :, 999]
    past = points * 7919.0**3 % 1.0
    assert np.abs(past - past[:, :1]).max() < 1e-4
    assert stats.kstest(past[:, 0], "uniform").pvalue > 1e-4


@pytest.mark.parametrize("text", ["halton+owen", "sobol+owen", "hammersley+owen"])
def test_estimates_are_unbiased(text):
    """Means of 8000 estimates of four integrands in 5 dimensions, z-tests: false alarms 3e-4 together."""
    points = samplekit.points(text, 12, 5, realizations=8000, seed=8)
    for integrand, integral in (
        (points.prod(axis=2), 1 / 32),
        ((points**2).sum(axis=2), 5 / 3),
        (np.exp(points.sum(axis=2)), (np.e - 1) ** 5),
        ((points.sum(axis=2) < 1).astype(float), 1 / 120),
    ):
        estimates = integrand.mean(axis=1)
        assert abs(estimates.mean() - integral) < 4 * estimates.std() / np.sqrt(8000)


def test_dimensions_and_neighbouring_pixels_are_scrambled_on_their_own():
    """Point 5 of 90 x 90 pixels in 8 dimensions: 44 correlations within 4.5 standard errors, false alarms 3e-4."""
    y, x = (grid.ravel() for grid in np.mgrid[:90, :90])
    for text in ("sobol+owen", "halton+owen"):
        out = np.empty((8100, 8, 1))
        samplekit.sampler(text).fill(out, samplekit.Realizations.of_pixels(x, y, 9), 6, 5)
        image = out[:, :, 0].T.reshape(8, 90, 90)
        correlations = np.corrcoef(out[:, :, 0].T)[np.triu_indices(8, 1)].tolist()
        for channel in image:
            correlations.append(np.corrcoef(channel[:, 1:].ravel(), channel[:, :-1].ravel())[0, 1])
            correlations.append(np.corrcoef(channel[1:].ravel(), channel[:-1].ravel())[0, 1])
        assert np.abs(correlations).max() < 4.5 / 90


@pytest.mark.parametrize("text", ["sobol+owen", "r2+owen", "owen-sobol", "pmj02", "z-sobol", "halton:scramble=owen"])
def test_points_share_the_digits_after_the_32nd(text):
    """The reason for the floor. Points of r2 have such digits before, which are flipped alike."""
    points = samplekit.points(text, 4096, 1, realizations=20, seed=3)[:, :, 0]
    digits = (points * 2.0**53).astype(int) % 2**21
    if text == "r2+owen":
        digits ^= (samplekit.points("r2", 4096, 1, realizations=20, seed=3)[:, :, 0] * 2.0**53).astype(int) % 2**21
    assert (digits == digits[:, :1]).all()
    assert np.unique(digits[:, 0]).size == 20


@pytest.mark.slow
@pytest.mark.parametrize("bits", [18, 20, 22])
def test_the_floor_of_the_variance_is_the_stated_one(bits):
    """Of f = x, 1 + N^3 / 2^64 times Owen's 1 / 12 N^3: 200 sets, within 5 standard errors of a chi-square."""
    count, realizations = 2**bits, 200
    squares = []
    sampler, points = samplekit.sampler("sobol+owen"), np.empty((1, 1, count))
    for number in range(realizations):
        sampler.fill(points, sampler.trials(number, number + 1, 5), count, 0)
        # Integers: a sum of floats would round.
        total = sum((points[0, 0] * 2.0**53).astype(np.int64).reshape(-1, 256).sum(axis=1).tolist())
        squares.append(((2 * total - count * 2**53) / count / 2.0**54) ** 2)
    ratio = np.mean(squares) * 12 * count**3 / (1 + count**3 / 2**64)
    assert abs(ratio - 1.0) < 5 * np.sqrt(2 / realizations)
