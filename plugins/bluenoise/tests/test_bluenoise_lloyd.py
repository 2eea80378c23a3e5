import itertools

import numpy as np
import pytest
from samplekit_bluenoise.voronoi import relax
from scipy.spatial import Voronoi

import samplekit


def centroids(points):
    """The centroids of the Voronoi cells of float64[N, 2] on the torus, from the diagram of 5 x 5 copies."""
    copies = sorted(itertools.product(range(-2, 3), repeat=2), key=lambda copy: copy != (0, 0))
    diagram = Voronoi(np.concatenate([points + np.array(copy) for copy in copies]))
    moved = np.empty_like(points)
    area = 0.0
    for i in range(len(points)):
        corners = diagram.vertices[diagram.regions[diagram.point_region[i]]] - points[i]
        corners = corners[np.argsort(np.arctan2(corners[:, 1], corners[:, 0]))]
        following = np.roll(corners, -1, axis=0)
        cross = corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1]
        moved[i] = points[i] + ((corners + following) * cross[:, None]).sum(0) / (3 * cross.sum())
        area += cross.sum() / 2
    assert area == pytest.approx(1.0, abs=1e-12)
    return moved


def apart(a, b):
    difference = a - b
    return np.abs(difference - np.rint(difference)).max()


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 8, 17, 100])
def test_a_step_moves_points_to_the_centroids_of_their_cells(count):
    for points in np.random.default_rng(count).random((20, count, 2)):
        relaxed = np.ascontiguousarray(points.T[None])
        relax(relaxed, 1)
        assert apart(relaxed[0].T, centroids(points)) < 1e-12
        assert relaxed.min() >= 0.0
        assert relaxed.max() < 1.0


def test_a_regular_grid_stays_where_it_is():
    x, y = np.meshgrid(np.arange(5) / 5 + 0.1, np.arange(4) / 4 + 0.1)
    grid = np.array([[x.ravel(), y.ravel()]])
    relaxed = grid.copy()
    relax(relaxed, 5)
    assert apart(relaxed, grid) < 1e-14


def test_points_in_one_place_do_no_harm():
    relaxed = np.full((1, 2, 3), 0.25)
    relax(relaxed, 3)
    assert apart(relaxed, 0.25) < 1e-15


def test_steps_add_up():
    points = np.random.default_rng(3).random((4, 2, 50))
    at_once, in_turn = points.copy(), points.copy()
    relax(at_once, 5)
    for _ in range(5):
        relax(in_turn, 1)
    np.testing.assert_array_equal(at_once, in_turn)


def test_the_default_has_a_clear_round_ring_and_no_crystal(spectrum, radial):
    """Bounds are far from the values, 3.2 and 0.33 (60 sets; 2 % standard error each)."""
    points = samplekit.points("lloyd:bank=0", 256, 2, realizations=60)
    power = spectrum(points, 32)
    rings = radial(power)
    assert rings[15:19].max() > 2.7
    assert rings[23:27].min() < 0.42
    power[32, 32] = 0.0
    # A crystal of one orientation would reach N; the largest of 500 gamma(60) variables at the ring's height is 5.
    assert power.max() < 7.0


def test_jittered_points_fall_back_onto_the_lattice_of_their_strata(spectrum):
    power = spectrum(samplekit.points("lloyd:bank=0,initial=jittered", 256, 2, realizations=30), 16)
    assert power[[0, 32, 16, 16], [16, 16, 0, 32]].mean() > 20.0


def test_random_points_keep_their_clumps_for_long(spectrum):
    points = samplekit.points("lloyd:bank=0,initial=random", 256, 2, realizations=60)
    power = spectrum(points, 1)
    assert power[[0, 2, 1, 1], [1, 1, 0, 2]].mean() > 0.2


@pytest.mark.parametrize("initial", ["poisson-disk", "jittered", "random"])
def test_no_step_leaves_the_initial_points(initial):
    sampler = samplekit.sampler(f"lloyd:steps=0,bank=0,initial={initial}")
    out = np.empty((3, 2, 30))
    sampler.fill(out, sampler.trials(0, 3, 1), 30, 0)
    assert len(np.unique(out[:, 0])) == 90
