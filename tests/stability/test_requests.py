"""Extreme requests to every sampler, plain and under every randomizer: right, or refused in one line."""

import numpy as np
import pytest

import samplekit
from samplekit import Realizations, UsageError
from samplekit._registry import BUILTIN, registry

SEEDS = (0, 1, 2**63, 2**64 - 1)
INDICES = (0, 2**24, 2**31, 2**32, 2**40, 2**53)
COUNTS = (1, 2, 3, 97, 1009, 65537, 1009**2, 2**20 - 1, 2**20, 2**20 + 1)
FAR = 2**31 - 1
_PART = 8

NAMES = [
    name
    for name, offer in registry().all("sampler").items()
    if offer.plugin.name == BUILTIN and not any(option.required for option in offer.spec.options)
]
CHOICES = [name + suffix for name in NAMES for suffix in ("", *(f"+{r}" for r in registry().all("randomizer")))]


def in_range(points):
    return bool((points >= 0.0).all() and (points < 1.0).all())


def counts_around(sampler, dims, index):
    """Counts of sets that have a point of this index, the least first; none if there is no such set."""
    if index > sampler.spec.largest_index:
        return
    nearest = sampler.spec.counts.above(index + 1, dims)
    for count in dict.fromkeys((index + _PART, nearest, 2 * index, 1 << max(index, 1).bit_length())):
        if count and count > index and possible(sampler, count, dims):
            yield count


def possible(sampler, count, dims):
    try:
        sampler.check(count, dims)
    except UsageError:
        return False
    return True


@pytest.mark.parametrize("text", CHOICES)
def test_points_at_large_indices(text):
    """Those declared are made, and are those of the whole; beyond the last one the request is refused."""
    sampler = samplekit.sampler(text)
    dims = min(2, sampler.spec.dimensions[1] or 2)
    if not sampler.streams:
        pytest.skip("it makes sets as a whole")
    seen = set()
    for index in INDICES:
        for count in list(counts_around(sampler, dims, index))[:1]:
            start, stop = index, min(index + _PART, count)
            part = sampler.points(count, dims, start=start, stop=stop)
            assert in_range(part)
            alone = sampler.points(count, dims, start=stop - 1, stop=stop)
            assert np.array_equal(alone[:, 0], part[:, -1])
            seen.update(map(bytes, part[0]))
    assert seen
    with pytest.raises(UsageError) as refusal:
        sampler.check(sampler.spec.largest_index + 2, dims)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("text", CHOICES)
def test_counts_from_one_to_beyond_a_million(text):
    """Each is made whole, or refused with the nearest that are."""
    sampler = samplekit.sampler(text)
    dims = min(2, sampler.spec.dimensions[1] or 2)
    made = 0
    for count in COUNTS:
        if not possible(sampler, count, dims):
            with pytest.raises(UsageError, match=f"^[^\n]*{count}[^\n]*$"):
                sampler.check(count, dims)
            continue
        start = max(0, count - _PART) if sampler.streams else 0
        assert in_range(sampler.points(count, dims, start=start, stop=count))
        made += 1
    assert made


@pytest.mark.parametrize("text", CHOICES)
def test_the_most_dimensions_declared_and_one_more(text):
    sampler = samplekit.sampler(text)
    least, most = sampler.spec.dimensions
    for dims in {least, most or 1000}:
        count = next(count for count in (16, 4, 1, 31**2, 1009**2) if possible(sampler, count, dims))
        assert in_range(sampler.points(count, dims, start=max(0, count - _PART) if sampler.streams else 0))
    for dims in {least - 1, 0, *([] if most is None else [most + 1])}:
        with pytest.raises(UsageError):
            sampler.check(16, dims)


@pytest.mark.parametrize("text", CHOICES)
def test_seeds_and_pixels_at_the_far_ends(text):
    """Every seed and pixel has a set of its own if the sampler is random, the same set if it is not."""
    sampler = samplekit.sampler(text)
    dims = min(2, sampler.spec.dimensions[1] or 2)
    count = next(count for count in (16, 25, 8) if possible(sampler, count, dims))
    x, y = np.array([0, FAR, 0, FAR]), np.array([0, 0, FAR, FAR])
    sets = []
    for seed in SEEDS:
        out = np.full((x.size, dims, count), np.nan)
        sampler.fill(out, Realizations.of_pixels(x, y, seed), count, 0)
        assert in_range(out)
        sets += list(out)
    distinct = len({each.tobytes() for each in sets})
    assert distinct == (len(sets) if sampler.spec.randomized else 1)


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, True])
def test_other_seeds_are_refused(seed):
    with pytest.raises(UsageError, match="seed"):
        samplekit.points("random", 4, seed=seed)


def test_halton_in_the_last_dimensions_is_nearly_a_line():
    """What the declaration allows is made as defined; scrambling is what is done about it, and it is measured here.

    In bases 8147 and 8161, the 1023rd and 1024th primes, the first 256 points are k / 8147 and k / 8161.
    """
    plain = samplekit.points("halton", 256, 1024)[0, :, -2:]
    scrambled = samplekit.points("halton+owen", 256, 1024, realizations=8)[:, :, -2:]
    assert np.corrcoef(plain.T)[0, 1] > 0.999999
    assert plain.max() < 0.0315
    correlations = [abs(np.corrcoef(each.T)[0, 1]) for each in scrambled]
    # Independent points have a standard deviation of 1/16.
    assert max(correlations) < 5 / 16
    assert scrambled.max() > 0.9
