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


def test_none_is_excused():
    assert not [name for name in NAMES if registry().find("sampler", name).spec.expected_failures]


def test_the_same_verdict_twice():
    only = ["uniformity", "unbiasedness", "variance", "across-pixels", "across-dimensions"]
    first, second = (check_sampler("halton+owen", quick=True, only=only) for _ in range(2))
    assert [(each.check, each.status, each.message) for each in first] == [
        (each.check, each.status, each.message) for each in second
    ]
