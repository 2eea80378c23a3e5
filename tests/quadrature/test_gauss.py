import math
from fractions import Fraction

import pytest

from samplekit.quadrature._gauss import NODES, WEIGHTS


def test_the_mean_of_a_constant_is_that_constant():
    total = 0.0
    for weight in WEIGHTS.tolist():
        total += weight
    assert total == 1.0


@pytest.mark.parametrize("degree", range(2, 48, 2))
def test_integrates_every_power_up_to_47(degree):
    mean = sum(Fraction(w) * Fraction(x) ** degree for x, w in zip(NODES.tolist(), WEIGHTS.tolist(), strict=True))
    assert float(mean) == pytest.approx(1 / (degree + 1), rel=1e-15 * math.sqrt(degree))
