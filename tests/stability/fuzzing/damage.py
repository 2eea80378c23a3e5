"""Files that were whole: cut, with bits that flipped, blocks that moved, numbers that are others."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from random import Random

INTEGERS = (0, 1, 2**7, 2**15, 2**16, 2**31 - 1, 2**31, 2**32 - 1, 2**63 - 1, 2**63, 2**64 - 1)
WORDS = (b"nan", b"inf", b"-1", b"1e999", b"2", b"0", b"", b"\xff\xfe", b",", b"9" * 40, b"{}", b"null", b"[" * 2000)


def damaged(data: bytes, random: Random) -> bytes:
    """One to three kinds of damage."""
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        data = random.choice(KINDS)(data, random)
    return data


def _cut(data: bytes, random: Random) -> bytes:
    return data[: random.randrange(len(data) + 1)]


def _behead(data: bytes, random: Random) -> bytes:
    return data[random.randrange(min(len(data), 64) + 1) :]


def _flip(data: bytes, random: Random) -> bytes:
    changed = bytearray(data)
    for _ in range(random.choice([1, 1, 3, 20]) if data else 0):
        # The head says what the rest is: it is hit as often.
        place = random.randrange(min(len(data), 400)) if random.random() < 0.5 else random.randrange(len(data))
        changed[place] ^= 1 << random.randrange(8)
    return bytes(changed)


def _block(data: bytes, random: Random) -> bytes:
    start, length = random.randrange(len(data) + 1), random.choice([1, 4, 8, 64, 512])
    filling = random.choice([bytes(length), b"\xff" * length, random.randbytes(length), data[:length]])
    return data[:start] + filling + data[start + len(filling) :]


def _integer(data: bytes, random: Random) -> bytes:
    start = random.randrange(min(len(data), 400) + 1)
    number = random.choice(INTEGERS).to_bytes(8, random.choice(["little", "big"]))
    length = random.choice([1, 2, 4, 8])
    part = number[:length] if random.random() < 0.5 else number[-length:]
    return data[:start] + part + data[start + length :]


def _insert(data: bytes, random: Random) -> bytes:
    start = random.randrange(len(data) + 1)
    return data[:start] + random.randbytes(random.choice([1, 2, 100])) + data[start:]


def _remove(data: bytes, random: Random) -> bytes:
    start = random.randrange(len(data) + 1)
    return data[:start] + data[start + random.choice([1, 2, 8, 100]) :]


def _double(data: bytes, random: Random) -> bytes:
    return data + data[: random.choice([len(data), 10])]


def _word(data: bytes, random: Random) -> bytes:
    found = list(re.finditer(rb"[0-9.e-]+|[A-Za-z_]{3,}", data[:100_000]))
    if not found:
        return data
    match = random.choice(found)
    return data[: match.start()] + random.choice(WORDS) + data[match.end() :]


KINDS = (_cut, _behead, _flip, _flip, _block, _integer, _insert, _remove, _double, _word)
