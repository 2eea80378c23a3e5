"""Two implementations of the rules of counts agree: the samplers', and the suite's brute force."""

import pytest

from samplekit._specs import counts
from samplekit.testing import _declared as declared

RULES = ["any", "products", "products-in-2", "squares", "prime-squares", "prime-cubes", "powers-of-2", "powers-of-3"]


@pytest.mark.parametrize("rule", RULES)
def test_the_same_counts_are_allowed(rule):
    for dims in (1, 2, 3, 4):
        for count in [*range(700), 1024, 2187, 4096, 6561, 9409]:
            assert declared.allows(rule, count, dims) == counts.allows(rule, count, dims), (rule, count, dims)


def test_the_same_grids_are_found():
    for dims in (1, 2, 3):
        for count in range(1, 800):
            sides = counts.grid_sides(count, dims)
            assert (sides in declared.grids(count, dims)) if sides else not declared.grids(count, dims)


def test_the_nearest_count_is_found():
    assert declared.allowed_near("powers-of-2", 100, 2) == 128
    assert declared.allowed_near("products", 97, 2) == 96
    assert declared.allowed_near("any", 97, 2) == 97
    assert declared.allowed_near("prime-cubes", 5, 2) == 8
