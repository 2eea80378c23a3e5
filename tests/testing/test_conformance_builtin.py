"""Our own samplers are what they declare: the quick suite over all of them, and over some with each randomizer."""

import pytest

from samplekit._registry import BUILTIN, registry
from samplekit.testing import check_sampler
from samplekit.testing._result import broken

pytestmark = pytest.mark.slow

NAMES = [
    name
    for name, offer in registry().all("sampler").items()
    if offer.plugin.name == BUILTIN and not any(option.required for option in offer.spec.options)
]
RANDOMIZED = ["sobol+owen", "halton+xor", "jittered+shift"]


@pytest.mark.parametrize("name", NAMES + RANDOMIZED)
def test_it_conforms(name):
    outcomes = check_sampler(name, quick=True)
    assert not broken(outcomes), [(each.check, each.message, str(each.example)) for each in broken(outcomes)]


@pytest.mark.parametrize("name", ["orthogonal-array", "regular+shift"])
def test_large_samples_of_points_that_share_strata_or_coordinates_raise_no_false_alarm(name):
    # In each set of 127^2 points a 256th of an axis holds 63 points, and 64 in one set of 256: no group showed it.
    # The points of a shifted grid in six dimensions share few coordinates: one large set decided about a cell.
    outcomes = check_sampler(name, only=["joint-uniformity"])
    assert not broken(outcomes), outcomes[0].message


def test_none_is_excused():
    assert not [name for name in NAMES if registry().find("sampler", name).spec.expected_failures]


def test_the_same_verdict_twice():
    only = ["uniformity", "unbiasedness", "variance", "across-pixels", "across-dimensions"]
    first, second = (check_sampler("halton+owen", quick=True, only=only) for _ in range(2))
    assert [(each.check, each.status, each.message) for each in first] == [
        (each.check, each.status, each.message) for each in second
    ]
