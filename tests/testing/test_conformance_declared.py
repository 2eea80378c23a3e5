"""The suite finds the counts to judge near those that it would like; the rules are tested in tests/specs."""

import pytest

from samplekit import AnyCount, Exactly, PowersOf, PrimePowers, Products, SamplerSpec
from samplekit.testing._subject import SamplerSubject


def nearest(counts, wanted, **declared):
    spec = SamplerSpec("plain", "faulty_samplers:Plain", "for tests", counts=counts, **declared)
    return SamplerSubject(spec).counts(wanted, dims=2)


@pytest.mark.parametrize(
    ("counts", "wanted", "found"),
    [
        (PowersOf(2), 100, 128),
        (Products(), 97, 96),
        (AnyCount(), 97, 97),
        (PrimePowers(3), 5, 8),
    ],
)
def test_the_nearest_count_is_found(counts, wanted, found):
    assert nearest(counts, wanted) == [found]


def test_the_smaller_of_two_counts_that_are_as_near_is_taken():
    assert nearest(PowersOf(2), 96) == [64]


def test_counts_that_the_sampler_refuses_and_those_too_large_are_passed_over():
    spec = SamplerSpec("picky", "faulty_samplers:Picky", "for tests", counts=PowersOf(2))
    assert SamplerSubject(spec).counts(100, dims=2) == [32]
    assert nearest(PowersOf(2), 100, largest_index=99) == [64]
    assert nearest(PowersOf(2), 1000, largest_index=99) == [64]
    assert nearest(Exactly(2**20 + 1), 100) == []
    assert nearest(Exactly(1000), 100, largest_index=99) == []
