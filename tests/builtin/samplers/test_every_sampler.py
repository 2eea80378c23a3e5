"""What holds for all samplers alike, plain and under every randomizer: their declarations say what."""

import itertools

import numpy as np
import pytest

import samplekit
from samplekit import Realizations, UsageError
from samplekit._builtin import samplekit_randomizers, samplekit_samplers

OPTIONS = ["halton:scramble=digits", "halton:scramble=owen", "halton:scramble=owen+owen", "faure:base=31+owen"]
CHOICES = OPTIONS + [
    spec.name + suffix
    for spec in samplekit_samplers()
    if not any(option.required for option in spec.options)
    for suffix in ("", *(f"+{randomizer.name}" for randomizer in samplekit_randomizers()))
]
PROGRESSIVE = [text for text in CHOICES if samplekit.sampler(text).spec.progressive is not None]
COUNTS = (1, 2, 7, 16, 25, 96, 1000, 1024, 1026, 1369, 1560, 3000)


def possible(text, counts=COUNTS):
    """The sampler, as many dimensions as it has up to five, and those of the counts that it makes."""
    sampler = samplekit.sampler(text)
    dims = min(5, sampler.spec.dimensions[1] or 5)
    makes = []
    for count in counts:
        try:
            sampler.check(count, dims)
        except UsageError:
            continue
        makes.append(count)
    assert makes
    return sampler, dims, makes


def filled(sampler, realizations, dims, count):
    out = np.full((len(realizations), dims, count), np.nan)
    sampler.fill(out, realizations, count, 0)
    return out


@pytest.mark.parametrize("text", CHOICES)
def test_values_lie_in_range(text):
    sampler, dims, counts = possible(text)
    for count in counts:
        points = sampler.points(count, dims, realizations=20, seed=count)
        assert points.shape == (20, count, dims)
        assert points.min() >= 0.0
        assert points.max() < 1.0


@pytest.mark.parametrize("text", CHOICES)
def test_slices_are_parts_of_the_whole(text):
    sampler, dims, counts = possible(text)
    for count in counts:
        whole = sampler.points(count, dims, realizations=2, seed=5)
        for start, stop in {(0, 1), (count - 1, count), (count // 3, count // 2 + 1), (count // 2, count)}:
            part = sampler.points(count, dims, realizations=2, seed=5, start=start, stop=stop)
            assert np.array_equal(part, whole[:, start:stop]), (count, start, stop)


@pytest.mark.parametrize("text", CHOICES)
def test_order_and_chunks_of_realisations_do_not_matter(text):
    sampler, dims, counts = possible(text, (16, 25, 1026, 1369))
    x, y = np.array([0, 1, 2, 2**31 - 1, 2**32 - 1, 70000, 5]), np.array([0, 0, 7, 2**32 - 1, 0, 2**16 + 1, 2**31 - 1])
    for count in counts:
        whole = filled(sampler, Realizations.of_pixels(x, y, 3), dims, count)
        reverse = filled(sampler, Realizations.of_pixels(x[::-1], y[::-1], 3), dims, count)
        assert np.array_equal(reverse[::-1], whole)
        for size in (1, 3):
            for first in range(0, x.size, size):
                rows = slice(first, first + size)
                part = filled(sampler, Realizations.of_pixels(x[rows], y[rows], 3), dims, count)
                assert np.array_equal(part, whole[rows])


@pytest.mark.parametrize("text", PROGRESSIVE)
def test_prefixes(text):
    """points(M)[:N] == points(N), at every N."""
    sampler, dims, counts = possible(text, (1, 2, 3, 15, 16, 17, 64, 97, 100, 1023, 1024, 1025, 2048))
    whole = sampler.points(5000, dims, realizations=2, seed=6)
    for count in counts:
        assert np.array_equal(sampler.points(count, dims, realizations=2, seed=6), whole[:, :count])


@pytest.mark.parametrize("text", PROGRESSIVE)
def test_dimensions_do_not_depend_on_how_many_follow(text):
    sampler, dims, _ = possible(text)
    whole = sampler.points(100, dims, realizations=2, seed=8)
    for fewer in range(1, dims):
        assert np.array_equal(sampler.points(100, fewer, realizations=2, seed=8), whole[:, :, :fewer])


@pytest.mark.parametrize("text", CHOICES)
def test_seeds_and_realisations_give_other_points_if_random(text):
    sampler, dims, counts = possible(text)
    count = counts[-1]
    sets = np.concatenate([sampler.points(count, dims, realizations=3, seed=seed) for seed in (0, 1, 2**64 - 1)])
    for one, other in itertools.combinations(sets, 2):
        if sampler.spec.randomized:
            assert not (one == other).any()
        else:
            assert np.array_equal(one, other)


@pytest.mark.parametrize("text", [text for text in CHOICES if not text.startswith("regular")])
def test_coordinates_are_distinct_in_every_dimension(text):
    sampler, dims, counts = possible(text)
    points = sampler.points(counts[-1], dims, realizations=3, seed=7)
    for realization, dimension in itertools.product(range(3), range(dims)):
        assert np.unique(points[realization, :, dimension]).size == counts[-1]


LARGE = [
    ("random", 2**63),
    ("van-der-corput", 2**40),
    ("van-der-corput:base=1000", 2**40),
    ("halton", 2**40),
    ("hammersley", 2**40),
    ("sobol", 2**32),
    ("sobol+owen", 2**32),
    ("halton+owen", 2**32),
    ("halton+xor", 2**32),
    ("halton+shift", 2**40),
    ("halton:scramble=digits", 2**32),
    ("halton:scramble=owen", 2**32),
    ("faure", 2**40),
    ("faure:base=1021", 2**40),
    ("faure:base=7+owen", 2**32),
    ("faure+xor", 2**32),
    ("hammersley+owen", 2**32),
    ("random+xor", 2**32),
    ("regular", 2**32),
    ("jittered", 2**32),
    ("latin-hypercube", 2**32),
    ("n-rooks", 2**32),
    ("multi-jittered", 2**32),
    ("correlated-multi-jittered", 2**32),
    ("uncorrelated-jitter", 2**32),
]


@pytest.mark.parametrize(("text", "count"), LARGE)
def test_slices_at_large_indices(text, count):
    sampler = samplekit.sampler(text)
    dims = min(2, sampler.spec.dimensions[1] or 2)
    assert count == sampler.spec.largest_index + 1
    for start in (2**16 - 3, 2**31 - 3, 2**32 - 6, 2**40 - 6, 2**63 - 6):
        if start >= count:
            continue
        part = sampler.points(count, dims, realizations=2, seed=1, start=start, stop=start + 6)
        assert part.min() >= 0.0
        assert part.max() < 1.0
        assert np.unique(part[0], axis=0).shape[0] == 6
        alone = [
            sampler.points(count, dims, realizations=2, seed=1, start=index, stop=index + 1)
            for index in range(start, start + 6)
        ]
        assert np.array_equal(np.concatenate(alone, axis=1), part)


@pytest.mark.parametrize(
    ("text", "dims"),
    [
        ("halton", 1024),
        ("hammersley", 1025),
        ("sobol", 4096),
        ("random", 3000),
        ("halton+owen", 1024),
        ("faure:base=1021", 1021),
    ],
)
def test_as_many_dimensions_as_declared(text, dims):
    points = samplekit.points(text, 9, dims)
    assert points.shape == (1, 9, dims)
    assert points.min() >= 0.0
    assert points.max() < 1.0
