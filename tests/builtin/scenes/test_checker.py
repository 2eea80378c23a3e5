from fractions import Fraction

import numpy as np
import pytest

from samplekit._builtin.scenes.checker import Checker


def square_wave_means(edges, cells):
    """Means of the square wave in rational arithmetic, from its integral, a triangle wave."""
    places = [cells * Fraction(edge) for edge in edges.tolist()]
    integrals = [min(place % 2, 2 - place % 2) for place in places]
    return [(integrals[i + 1] - integrals[i]) / (places[i + 1] - places[i]) for i in range(edges.size - 1)]


def adversarial_edges(rng, cells):
    """Edges on, one float beside, and around the cells' edges; narrow and wide boxes."""
    on = rng.integers(0, cells + 1, 3) / cells
    edges = [0.0, 1.0, *rng.random(4), *on, *np.nextafter(on, 2), *np.nextafter(on, -1)]
    edges += [edges[2] + 1e-6, edges[3] + 10 ** rng.uniform(-9, 0) / cells, on[0] - 0.3 / cells, on[1] + 1.5 / cells]
    return np.unique(edges)


@pytest.mark.parametrize("cells", [1, 2, 3, 7, 8, 10, 49, 512, 1000, 99991, 2**20 - 1, 2**20])
def test_exact_against_rational_arithmetic(cells):
    rng = np.random.default_rng(cells)
    x_edges, y_edges = adversarial_edges(rng, cells), adversarial_edges(rng, cells)
    assert (x_edges.size - 1) * (y_edges.size - 1) >= 100
    exact = Checker(cells).exact(x_edges, y_edges)
    columns, rows = square_wave_means(x_edges, cells), square_wave_means(y_edges, cells)
    for j, row in enumerate(rows):
        for i, column in enumerate(columns):
            assert abs(Fraction(exact[j, i]) - (1 + row * column) / 2) <= Fraction(1e-15), (i, j)


@pytest.mark.parametrize(("cells", "pixels"), [(8, 512), (3, 99), (7, 511), (49, 98), (10, 10), (1000, 1000), (1, 64)])
def test_pixels_that_fit_into_cells_are_constant_and_equal_the_reference(cells, pixels):
    edges = np.arange(pixels + 1) / pixels
    scene = Checker(cells)
    cell = np.arange(pixels) * cells // pixels
    expected = 1.0 - np.add.outer(cell, cell) % 2
    assert np.array_equal(scene.constant(edges, edges), expected)
    # An edge j / cells is stored with an error of up to 2^-54: that part of the pixel's box lies in the next cell.
    np.testing.assert_allclose(scene.exact(edges, edges), expected, atol=2.0**-53 * pixels)


@pytest.mark.parametrize(("cells", "pixels"), [(8, 64), (3, 33), (7, 35), (49, 49), (7, 32), (5, 31), (20, 8), (1, 3)])
def test_constant_pixels_give_that_value_at_every_sample(cells, pixels, constant_pixels):
    constant, sampled = constant_pixels(Checker(cells), pixels)
    known = np.isfinite(constant)
    assert known.any() == (cells <= pixels)
    assert np.array_equal(sampled[known], constant[known])


@pytest.mark.parametrize("cells", [1, 3, 8, 49, 1000])
def test_cells_begin_at_the_float_nearest_to_their_edge(cells, sums):
    j = np.arange(cells)
    tile = np.zeros((cells, 2, 1))
    tile[:, 0, 0] = j / cells
    whole = np.ascontiguousarray(np.repeat([[0.0], [1.0], [0.0], [1.0]], cells, axis=1))
    assert np.array_equal(sums(Checker(cells), tile, whole), 1.0 - j % 2)
    tile[1:, 0, 0] = np.nextafter(j[1:] / cells, 0)
    assert np.array_equal(sums(Checker(cells), tile, whole)[1:], 1.0 - (j[1:] - 1) % 2)


@pytest.mark.parametrize("count", [1, 7, 64, 1024])
@pytest.mark.parametrize("cells", [8, 37])
def test_sums_against_numpy(count, cells, boxes_of, sums):
    edges = np.arange(6) / 5
    boxes = boxes_of(edges, edges)
    tile = np.random.default_rng(count).random((25, 2, count))
    x = boxes[0][:, None] + tile[:, 0] * boxes[1][:, None]
    y = boxes[2][:, None] + tile[:, 1] * boxes[3][:, None]
    expected = ((np.floor(cells * x) + np.floor(cells * y)) % 2 == 0).sum(axis=1)
    assert np.array_equal(sums(Checker(cells), tile, boxes), expected)
