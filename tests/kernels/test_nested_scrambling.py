"""Owen's scrambling by a hash: the laws of nested uniform scrambling, exactly, over every key that matters.

Bit k of the result depends on the low k + 1 bits of the key's words, so a few bits of both words are all keys for the
first few digits.
"""

import itertools
from collections import Counter

import numpy as np
import pytest

from samplekit.kernels import _owen as owen
from samplekit.kernels._compile import reverse_bits32

scramble = np.errstate(over="ignore")(getattr(owen.scramble_reversed, "py_func", owen.scramble_reversed))
DIGITS = 5


def scrambled(x, digits=DIGITS):
    """The first digits of x under every key, as a number with the first digit in the top bit: [addend, factor]."""
    reverse = int(f"{x:0{digits}b}"[::-1], 2)
    addends = range(1 << digits)
    factors = range(1, 1 << digits, 2)
    return [
        [int(scramble(np.uint32(reverse), np.uint32(a), np.uint32(f))) >> (32 - digits) for f in factors]
        for a in addends
    ]


@pytest.fixture(scope="module")
def images():
    """int[x, key]: where each fraction of five digits goes."""
    return np.array([np.ravel(scrambled(x)) for x in range(1 << DIGITS)])


def test_every_key_is_a_permutation_that_keeps_common_digits(images):
    for key in range(images.shape[1]):
        assert sorted(images[:, key]) == list(range(1 << DIGITS))
        for digits in range(1, DIGITS):
            heads = {(x >> (DIGITS - digits), images[x, key] >> (DIGITS - digits)) for x in range(1 << DIGITS)}
            assert len(heads) == 1 << digits


def test_every_fraction_goes_everywhere_equally_often(images):
    for x in range(1 << DIGITS):
        assert set(Counter(images[x].tolist()).values()) == {images.shape[1] >> DIGITS}


def test_every_pair_goes_to_every_possible_pair_equally_often(images):
    """All that the variance of an estimate depends on (Owen 1997): it is that of true nested scrambling, not near it.

    Two fractions whose first k digits agree go to pairs whose first k digits agree and whose next digits differ.
    """
    for x, y in itertools.combinations(range(1 << DIGITS), 2):
        common = DIGITS - (x ^ y).bit_length()
        pairs = Counter(zip(images[x].tolist(), images[y].tolist(), strict=True))
        assert all(DIGITS - (a ^ b).bit_length() == common for a, b in pairs)
        assert len(pairs) == 2**DIGITS * 2 ** (DIGITS - common - 1)
        assert len(set(pairs.values())) == 1


def test_digits_depend_on_those_before_them_alone():
    rng = np.random.default_rng(3)
    for _ in range(50):
        x, addend, factor = (int(n) for n in rng.integers(0, 2**32, 3, np.uint32))
        other = x ^ (1 << int(rng.integers(0, 32)))
        a, b = (int(scramble(np.uint32(n), np.uint32(addend), np.uint32(factor | 1))) for n in (x, other))
        first = ((x ^ other) & -(x ^ other)).bit_length() - 1
        assert (a ^ b).bit_length() == 32 - first


def test_reversal():
    for x in (0, 1, 2, 0x80000000, 0xFFFFFFFF, 0x12345678):
        assert int(reverse_bits32(x)) == int(f"{x:032b}"[::-1], 2)
