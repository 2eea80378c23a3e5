"""Digits past the last: a random tail never takes a point out of its cell."""

from fractions import Fraction

import numpy as np
import pytest

import samplekit
from samplekit._builtin.randomizers.owen import Owen
from samplekit._builtin.randomizers.xor import Xor
from samplekit.kernels._digits import DIGITS_LIMIT, largest_power


@pytest.mark.parametrize("randomizer", [Xor, Owen])
@pytest.mark.parametrize("base", [3, 5, 7])
def test_siblings_of_the_last_digit_stay_siblings(base, randomizer):
    power = largest_power(base, DIGITS_LIMIT)
    parent = power // base * 2 // 3 * base
    points = np.empty((1000, 1, base))
    points[:] = [(parent + i) / power for i in range(base)]
    randomizer().apply(points, samplekit.sampler("random").trials(0, 1000, 0), (base,))
    broken = 0
    for row in points[:, 0].tolist():
        cells = sorted(int(Fraction(x) * power) for x in row)
        broken += cells[0] % base != 0 or cells != list(range(cells[0], cells[0] + base))
    assert broken == 0
