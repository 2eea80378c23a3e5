"""Relations: nothing ties the points of one pixel, seed, dimension, count or number of dimensions to those of another.

One point of a randomised, unbiased set is uniform in the unit cube, whatever the sampler: its coordinates are
independent of each other, and of those of every other realisation. So a table of such coordinates holds independent
numbers, in which no two are equal or mirror images, no two differences are equal, and none is the sum of two others,
except by chance. The comparison is exact up to rounding. Only what one realisation gives for other counts, numbers of
dimensions and indices may be related, and here it is never compared.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from samplekit._bases.realizations import LARGEST_COORDINATE, Realizations
from samplekit.testing._judge import repeated
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import poisson_threshold
from samplekit.testing._subject import Array, SamplerSubject

Words = NDArray[np.int64]
Owner = tuple[int, int, int]
"""Seed and pixel of a realisation."""

_BITS = 44
"""Binary digits that are compared: sums that are wrapped and rounded agree in them."""
_MASK = (1 << _BITS) - 1
_TESTS = 1000
"""More than the comparisons that are made: each may raise a false alarm."""
_COUNT = 16
_COUNTS, _DIMS = (4, _COUNT, 17, 64), (2, 3, 5)
_SIDE, _ROW = 4, 2048
_SEEDS, _QUICK_SEEDS = (0, 1, 2, 3, *(2**k for k in range(2, 64))), (0, 1, 2, 3, 2**31, 2**32, 2**63)
_MOST_DIMS, _MOST_POINTS = 256, 64
_PLACES = (*(2**k for k in range(2, 32)), 1000, 1920, 2**16 + 1, 2**31 - 1, LARGEST_COORDINATE)
_FEW_SEEDS, _FEW = 4, 3
"""Of these seeds, and of pixels of this many columns and rows, all differences and sums are compared."""


class _Table(NamedTuple):
    """Coordinates that are compared, as fractions of 2^44: one a row.

    Attributes
    ----------
    words
        int64[M].
    owner
        Number of the realisation of each.
    column
        int64[M, 4]: dimension, count, number of dimensions, and index of the point; -1 and -2 where the word is that of
        the least and the greatest coordinate of a set, times the count: these see sets in another order.
    """

    words: Words
    owner: Words
    column: Words


@conformance_check("relations", 22)
def check_relations(subject: SamplerSubject) -> None:
    """No seeds, pixels, dimensions, counts or numbers of dimensions have equal, shifted, mirrored or added points."""
    spec = subject.spec
    if not spec.randomized:
        raise NotApplicable("it is not declared randomised")
    pixels, seeds = _pixels(subject), _affordable_seeds(subject)
    if not spec.unbiased:
        _judge_whole_sets(subject, pixels, seeds)
        return
    table, owners = _draw(subject, pixels, seeds)
    _judge_pairs(subject, table, owners, mirrored=False)
    _judge_pairs(subject, table, owners, mirrored=True)
    _judge_differences(subject)
    _judge_dimensions(subject)


def _judge_dimensions(subject: SamplerSubject) -> None:
    """Raise if two dimensions of one realisation or of two, as many as there are up to 256, have equal coordinates.

    All points are compared: point i + 1 of one dimension may be point i of another.
    """
    dims = subject.most_dims(_MOST_DIMS)
    count = subject.counts(2**dims if subject.spec.counts.depends_on_dims else _COUNT, dims=dims)[0]
    side = subject.spec.screen_block or 1
    period = subject.spec.period or LARGEST_COORDINATE
    pixels = np.array([(x % period, y % period) for x, y in ((0, 0), (1, 0), (0, 1))], np.int64) * side
    owners: dict[Owner, int] = {}
    parts = []
    for seed in range(2):
        values = subject.fill(Realizations.of_pixels(pixels[:, 0], pixels[:, 1], seed), count, dims)[
            :, :, :_MOST_POINTS
        ]
        realization = [owners.setdefault((seed, int(x), int(y)), len(owners)) for x, y in pixels]
        for index in range(values.shape[2]):
            words, _, column = _rows(values, np.array(realization), count, dims, index)
            parts.append((words, np.repeat(realization, dims) * dims + column[:, 0], column))
    table = _Table(*(np.concatenate(each) for each in zip(*parts, strict=True)))
    names = [owner for owner in owners for _ in range(dims)]
    _judge_pairs(subject, table, names, mirrored=False)
    _judge_pairs(subject, table, names, mirrored=True)


def _pixels(subject: SamplerSubject) -> NDArray[np.int64]:
    """Return pixels int64[P, 2]: a small square first, then a row, and far places along both axes and together."""
    near = [(x, y) for y in range(_SIDE) for x in range(_SIDE)]
    far = [pixel for place in _PLACES for pixel in ((place, 0), (0, place), (place, place), (place + 1, 1))]
    row = [(x, y) for i in range(_SIDE, 64 if subject.quick else _ROW) for x, y in ((i, 0), (0, i))]
    block = subject.spec.screen_block or 1
    blocks = [(x * block, y * block) for x, y in near]
    period = subject.spec.period or LARGEST_COORDINATE + 1
    chosen = dict.fromkeys((x % period, y % period) for x, y in (*near, *blocks, *row, *far) if x <= LARGEST_COORDINATE)
    return np.array(list(chosen), np.int64)


def _affordable_seeds(subject: SamplerSubject) -> tuple[int, ...]:
    """Return the seeds: fewer of a sampler that is slow, which may make something for each."""
    seeds = _QUICK_SEEDS if subject.quick else _SEEDS
    dims = subject.dims(2)
    affordable = subject.affordable(len(seeds), subject.counts(_COUNT, dims=dims)[0], dims, least=4)
    return _QUICK_SEEDS[:4] if subject.slow or affordable < len(seeds) else seeds


def _judge_whole_sets(subject: SamplerSubject, pixels: NDArray[np.int64], seeds: tuple[int, ...]) -> None:
    """Raise if two realisations have one set: of sets that are biased nothing else is known."""
    dims = subject.dims(2)
    (count,) = subject.counts(_COUNT, dims=dims)
    near = pixels[: _SIDE**2]
    made = [subject.fill(Realizations.of_pixels(near[:, 0], near[:, 1], seed), count, dims) for seed in seeds]
    names = [(seed, int(x), int(y)) for seed in seeds for x, y in near]
    for first, second in repeated(np.concatenate(made)):
        (seed, x, y), (other, x2, y2) = names[first], names[second]
        raise CheckFailed(
            f"pixel ({x}, {y}) with seed {seed} and pixel ({x2}, {y2}) with seed {other} have one set",
            subject.request(count, dims, seed, (x, y)),
        )


def _requests(subject: SamplerSubject) -> list[tuple[int, int]]:
    """Return counts and numbers of dimensions: about 16 points first, and three dimensions first."""
    dims = sorted({subject.dims(d) for d in _DIMS}, key=lambda d: (d != subject.dims(3), d))
    found = [(count, d) for d in dims for count in subject.counts(*_COUNTS, dims=d)]
    return sorted(found, key=lambda request: abs(request[0] - _COUNT))[
        : 2 if subject.slow else 4 if subject.quick else None
    ]


def _draw(subject: SamplerSubject, pixels: NDArray[np.int64], seeds: tuple[int, ...]) -> tuple[_Table, list[Owner]]:
    """Return the table, and the seed and pixel of each owner."""
    requests = _requests(subject)
    count, dims = requests[0]
    # All pixels of the first seeds; of the others, and for other requests, the small square and what stands beside it.
    many = subject.affordable(len(pixels), count, dims, least=_SIDE**2)
    few = min(2 * _SIDE**2, many)
    owners: dict[Owner, int] = {}
    parts: list[tuple[Words, Words, Words]] = []
    for number, seed in enumerate(seeds):
        for place, (count, dims) in enumerate(requests if number < _FEW_SEEDS else requests[:2]):
            chosen = pixels[: many if number < _FEW_SEEDS and place == 0 else few]
            values = subject.fill(Realizations.of_pixels(chosen[:, 0], chosen[:, 1], seed), count, dims)
            # Pixels of a block that shares a sequence count as one: for other counts they may exchange their parts.
            blocks = chosen // (subject.spec.screen_block or 1) * (subject.spec.screen_block or 1)
            mine = np.array([owners.setdefault((seed, int(x), int(y)), len(owners)) for x, y in blocks])
            parts += [_rows(values, mine, count, dims, index) for index in _columns(count)]
    table = _Table(*(np.concatenate(each) for each in zip(*parts, strict=True)))
    return table, list(owners)


def _columns(count: int) -> list[int]:
    return sorted({0, min(1, count - 1), count - 1, *((-1, -2) if count > 1 else ())})


def _rows(values: Array, owners: Words, count: int, dims: int, index: int) -> tuple[Words, Words, Words]:
    extreme = {-1: values.min, -2: values.max}.get(index)
    words = _words(values[:, :, index] if extreme is None else extreme(axis=2) * count)
    compared = words.shape[1]
    column = np.stack([np.arange(compared), *(np.full(compared, each) for each in (count, dims, index))], axis=1)
    return words.ravel(), np.repeat(owners, compared), np.tile(column, (len(values), 1))


def _words(values: Array) -> Words:
    """Return the fractional parts as integers, the nearest multiples of 2^-44; 1 is 0."""
    return np.rint(values * 2.0**_BITS).astype(np.int64) & _MASK


def _resolution(words: Words) -> float:
    """Return the probability that two random values agree: samplers may use few binary digits."""
    used = int(np.bitwise_or.reduce(words))
    return 2.0 ** ((used & -used).bit_length() - 1 - _BITS) if used else 1.0


def _judge_pairs(subject: SamplerSubject, table: _Table, owners: list[Owner], *, mirrored: bool) -> None:
    """Raise if coordinates of two realisations are equal, or add up to 1, more often than by chance."""
    words, rows = table.words, np.arange(table.words.size)
    if mirrored:
        words, rows = np.concatenate([words, -words & _MASK]), np.tile(rows, 2)
    owner = table.owner[rows]
    # A value may stand several times for one realisation: equal words are sorted by their realisation.
    order = np.lexsort((owner, words))
    first, second = order[:-1], order[1:]
    found = (words[first] == words[second]) & (owner[first] != owner[second])
    if mirrored:
        found &= (first < table.words.size) != (second < table.words.size)
    places = np.flatnonzero(found)
    # A point of one index may lie in a cell of its own: its coordinate is uniform in a part 1 / count alone.
    chance = words.size**2 / 2 * _resolution(table.words) * int(table.column[:, 1].max())
    if places.size >= poisson_threshold(chance, _TESTS):
        one, two = (int(rows[each[places[0]]]) for each in (first, second))
        text = f"{_name(table, owners, one)} {'mirrors' if mirrored else 'equals'} {_name(table, owners, two)}"
        _fail(subject, text, places.size, table, owners, one)


def _judge_differences(subject: SamplerSubject) -> None:
    """Raise if two differences of coordinates are equal, or a coordinate is the sum of two, more often than by chance.

    Equal sums are equal differences: a + b = c + d is a - c = d - b.
    """
    scale = subject.spec.screen_block or 1
    most = subject.spec.period or _FEW
    pixels = np.array([(x, y) for y in range(min(2, most)) for x in range(min(_FEW, most))], np.int64) * scale
    tables = []
    for count, dims in _requests(subject):
        owners: list[Owner] = []
        parts = []
        for seed in range(_FEW_SEEDS):
            values = subject.fill(Realizations.of_pixels(pixels[:, 0], pixels[:, 1], seed), count, dims)[:, :_FEW]
            mine = np.arange(len(pixels)) + len(owners)
            owners += [(seed, int(x), int(y)) for x, y in pixels]
            parts.append(_rows(values, mine, count, dims, 0))
        tables.append(_Table(*(np.concatenate(each) for each in zip(*parts, strict=True))))
    for table in tables:
        _judge_sums(subject, table, owners)
        a, b = np.triu_indices(table.words.size, 1)
        _judge_equal_differences(subject, table, table, owners, a, b)
    # Differences between requests. Two that are made of the same two realisations may be equal.
    for one, two in itertools.permutations(tables, 2):
        a, b = (each.ravel() for each in np.indices((one.words.size, two.words.size)))
        apart = one.owner[a] != two.owner[b]
        _judge_equal_differences(subject, one, two, owners, a[apart], b[apart])


def _judge_equal_differences(
    subject: SamplerSubject, one: _Table, two: _Table, owners: list[Owner], a: Words, b: Words
) -> None:
    """Judge the differences of rows ``a`` of one table and rows ``b`` of another, with either sign or as digits."""
    differences = {"are": _unsigned(one.words[a] - two.words[b]), "are digit by digit": one.words[a] ^ two.words[b]}
    low, high = np.minimum(one.owner[a], two.owner[b]), np.maximum(one.owner[a], two.owner[b])
    code = low * len(owners) + high if one is not two else np.arange(a.size)
    chance = a.size**2 * _resolution(np.concatenate([one.words, two.words])) * int(one.column[:, 1].max())
    for how, words in differences.items():
        order = np.lexsort((code, words))
        first, second = order[:-1], order[1:]
        places = np.flatnonzero((words[first] == words[second]) & (code[first] != code[second]))
        if places.size >= poisson_threshold(chance, _TESTS):
            (i, j), (k, m) = ((int(a[each[places[0]]]), int(b[each[places[0]]])) for each in (first, second))
            text = (
                f"{_name(one, owners, i)} and {_name(two, owners, j)} {how} as far apart as {_name(one, owners, k)}"
                f" and {_name(two, owners, m)}"
            )
            _fail(subject, text, places.size, one, owners, i)


def _judge_sums(subject: SamplerSubject, table: _Table, owners: list[Owner]) -> None:
    words = table.words
    a, b = np.triu_indices(words.size)
    order = np.argsort(words)
    chance = 4 * a.size * words.size * _resolution(words) * int(table.column[:, 1].max())
    for sign in (1, -1):
        sums = (words[a] + words[b]) * sign & _MASK
        place = order[np.minimum(np.searchsorted(words, sums, sorter=order), words.size - 1)]
        # A word that is 0 is the sum of itself and any other.
        found = np.flatnonzero((words[place] == sums) & (place != a) & (place != b))
        if found.size >= poisson_threshold(chance, _TESTS):
            i, j, k = int(a[found[0]]), int(b[found[0]]), int(place[found[0]])
            sum_of = f"the sum, modulo 1, of {_name(table, owners, i)} and {_name(table, owners, j)}"
            relation = "is" if sign == 1 else "mirrors"
            _fail(subject, f"{_name(table, owners, k)} {relation} {sum_of}", found.size, table, owners, k)


def _unsigned(differences: Words) -> Words:
    """Return differences modulo 1, the smaller of each and its opposite."""
    wrapped = differences & _MASK
    smaller: Words = np.minimum(wrapped, -wrapped & _MASK)
    return smaller


def _name(table: _Table, owners: list[Owner], row: int) -> str:
    seed, x, y = owners[int(table.owner[row])]
    dimension, count, dims, index = (int(each) for each in table.column[row])
    point = {-1: "least", -2: "greatest"}.get(index, f"point {index}")
    return f"coordinate {dimension} of {dims}, {point} of {count} (seed {seed}, pixel ({x}, {y}))"


def _fail(subject: SamplerSubject, text: str, found: int, table: _Table, owners: list[Owner], row: int) -> None:
    seed, x, y = owners[int(table.owner[row])]
    _, count, dims, index = (int(each) for each in table.column[row])
    raise CheckFailed(
        f"{text}: {found} such relations, independent realisations have none",
        subject.request(count, dims, seed, (x, y), indices=(max(index, 0),)),
    )
