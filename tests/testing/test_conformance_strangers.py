"""What the suite finds in other libraries' samplers, wrapped as plugins with what their documentation says of them."""

import pytest

from samplekit.testing import check_sampler
from samplekit.testing._result import broken

pytestmark = pytest.mark.slow

FOUND = {
    "scipy-sobol": [],
    "scipy-halton": [],
    # Digits added up in floating point: 7/9 comes out one unit in the last place short.
    "scipy-halton-plain": ["elementary-intervals"],
    "scipy-latin-hypercube": [],
    # Its distance is not kept across the edges, and its growth leaves a part of the square for last.
    "scipy-poisson-disk": ["minimum-distance"],
}
# The rest takes a library that makes a set at a time in Python a minute.
CHECKS = ["determinism", "seed", "prefix", "slices", "elementary-intervals", "strata", "pixel-extremes"]


@pytest.mark.parametrize("name", FOUND)
def test_scipy(name):
    scipy_samplers = pytest.importorskip("scipy_samplers")
    spec = next(each for each in scipy_samplers.SPECS if each.name == name)
    fewer = {
        "scipy-poisson-disk": ["minimum-distance"],
        "scipy-halton": ["determinism", "seed", "prefix"],
        "scipy-sobol": ["seed", "prefix", "elementary-intervals"],
        "scipy-latin-hypercube": ["seed", "slices", "strata"],
    }
    checks = fewer.get(name, CHECKS)
    outcomes = check_sampler(spec, quick=True, only=checks)
    assert [each.check for each in broken(outcomes)] == FOUND[name], [each.message for each in broken(outcomes)]


@pytest.mark.parametrize("index", [0, 1])
def test_qmcpy(index):
    pytest.importorskip("qmcpy")
    from qmcpy_samplers import SPECS

    outcomes = check_sampler(SPECS[index], quick=True, only=CHECKS)
    assert not broken(outcomes), [(each.check, each.message) for each in broken(outcomes)]
