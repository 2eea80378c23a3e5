"""The suite finds the counts to judge near those that it would like; the rules are tested in tests/specs."""

from samplekit import AnyCount, Exactly, PowersOf, PrimePowers, Products, SamplerSpec
from samplekit.testing import _declared as declared


def test_the_nearest_count_is_found():
    assert declared.allowed_near(PowersOf(2), 100, 2) == 128
    assert declared.allowed_near(Products(), 97, 2) == 96
    assert declared.allowed_near(AnyCount(), 97, 2) == 97
    assert declared.allowed_near(PrimePowers(3), 5, 2) == 8


def test_the_smaller_of_two_counts_that_are_as_near_is_taken():
    assert declared.allowed_near(PowersOf(2), 96, 2) == 64
    assert declared.allowed_near(AnyCount(), 97, 2, makes=lambda count: count != 97) == 96


def test_counts_that_the_sampler_refuses_and_those_too_large_are_passed_over():
    assert declared.allowed_near(PowersOf(2), 100, 2, makes=lambda count: count < 50) == 32
    assert declared.allowed_near(PowersOf(2), 100, 2, largest=100) == 64
    assert declared.allowed_near(PowersOf(2), 1000, 2, largest=100) == 64
    assert declared.allowed_near(Exactly(1000), 100, 2, largest=100) is None
    assert declared.allowed_near(AnyCount(), 5, 2, makes=lambda _: False, largest=100) is None


def test_prefixes_are_judged_where_they_are_declared():
    spec = SamplerSpec("toy", "toys:Toy", "", progressive=PowersOf(2), largest_index=63)
    assert declared.progressive_counts(spec, (1, 3, 64, 16, 16, 128), 2) == [1, 16, 64]
    assert declared.progressive_counts(SamplerSpec("toy", "toys:Toy", ""), (1, 2), 2) == []
