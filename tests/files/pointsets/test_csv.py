import itertools

import numpy as np

from samplekit.files._pointsets.text import csv_text


def test_every_bit_comes_back():
    points = np.random.default_rng(1).random((3, 40, 2))
    points[0, :6, 0] = [0.0, 5e-324, 2.2250738585072014e-308, 0.1 + 0.2, 1 - 2**-53, 1 / 3]
    lines = "".join(csv_text(points)).splitlines()
    assert lines[0] == "realisation,index,x0,x1"
    rows = [line.split(",") for line in lines[1:]]
    assert [(int(row[0]), int(row[1])) for row in rows] == list(itertools.product(range(3), range(40)))
    read = np.array([[float(number) for number in row[2:]] for row in rows]).reshape(points.shape)
    assert np.array_equal(read.view(np.uint64), points.view(np.uint64))


def test_a_piece_is_a_part_of_the_text_and_progress_reaches_the_end():
    points = np.random.default_rng(2).random((1, 40_000, 1))
    seen = []
    pieces = list(csv_text(points, lambda done, total: seen.append((done, total))))
    assert len(pieces) > 3
    assert max(map(len, pieces)) < 1_000_000
    assert all(piece.endswith("\n") for piece in pieces)
    assert "".join(pieces).count("\n") == 40_001
    assert seen[-1] == (40_000, 40_000)


def test_each_dimension_has_its_column():
    assert next(csv_text(np.zeros((1, 1, 4)))) == "realisation,index,x0,x1,x2,x3\n"
