import mpmath
import numpy as np
import pytest

from samplekit._builtin.scenes.zoneplate import ZonePlate


def fresnel_means(edges, centre, k):
    """Means of exp(i k x^2) by Fresnel's integrals at 60 digits."""
    if k == 0:
        return [mpmath.mpc(1)] * (edges.size - 1)
    scale = mpmath.sqrt(2 * mpmath.mpf(k) / mpmath.pi)
    places = [scale * (mpmath.mpf(edge) - mpmath.mpf(centre)) for edge in edges.tolist()]
    integrals = [mpmath.mpc(mpmath.fresnelc(place), mpmath.fresnels(place)) for place in places]
    return [(integrals[i + 1] - integrals[i]) / (places[i + 1] - places[i]) for i in range(edges.size - 1)]


def adversarial_edges(rng, centre, k):
    """Edges whose boxes are 1e-6 to 1 wide, across the centre, touching it, and where the method changes."""
    period = (10 / max(k, 10)) ** 0.5
    edges = [0.0, *rng.random(3)]
    edges += [
        edges[1] + 1e-6,
        edges[2] + 10 ** rng.uniform(-6, -2),
        edges[3] + 5 / max(k, 1e2) / abs(edges[3] - centre),
    ]
    edges += [centre - period * rng.random(), centre - 1e-6 * rng.random(), centre, np.nextafter(centre, 9) + 1e-6]
    edges += [centre + period * rng.random(), centre + 2 * period]
    return np.unique(edges)


@pytest.mark.parametrize("k", [0.0, 1e-12, 1e-6, 1e-3, 1.0, 30.0, 1024.0, 1e5, 1e7, 1e10, 1e12])
def test_exact_against_fresnel_integrals(k):
    rng = np.random.default_rng([7, int(1e12 * k)])
    for cx, cy in [(0.0, 0.0), tuple(rng.uniform(-0.5, 1.5, 2))]:
        x_edges, y_edges = adversarial_edges(rng, cx, k), adversarial_edges(rng, cy, k)
        assert (x_edges.size - 1) * (y_edges.size - 1) >= 90
        exact = ZonePlate(k, cx, cy).exact(x_edges, y_edges)
        with mpmath.workdps(60):
            columns, rows = fresnel_means(x_edges, cx, k), fresnel_means(y_edges, cy, k)
            for j, row in enumerate(rows):
                for i, column in enumerate(columns):
                    assert abs(exact[j, i] - (1 + (row * column).real) / 2) <= 5e-16, (k, cx, cy, i, j)


def test_exact_where_the_tails_are_longest():
    rng = np.random.default_rng(5)
    for k in 10 ** rng.uniform(0, 10, 150):
        near = (10 ** rng.uniform(0, 2.5) / k) ** 0.5
        x_edges = np.array([near, near + 5.1 / (k * near)])
        y_edges = np.array([0.0, 1e-3 / k**0.5])
        with mpmath.workdps(60):
            mean = fresnel_means(x_edges, 0.0, k)[0] * fresnel_means(y_edges, 0.0, k)[0]
            assert abs(ZonePlate(k).exact(x_edges, y_edges)[0, 0] - (1 + mean.real) / 2) <= 3e-16


@pytest.mark.parametrize("count", [1, 7, 64, 1024])
def test_sums_against_numpy(count, boxes_of, sums):
    rng = np.random.default_rng(count)
    edges = np.arange(6) / 5
    boxes = boxes_of(edges, edges)
    tile = rng.random((25, 2, count))
    x = boxes[0][:, None] + tile[:, 0] * boxes[1][:, None] - 0.25
    y = boxes[2][:, None] + tile[:, 1] * boxes[3][:, None] - 1.5
    expected = (0.5 + 0.5 * np.cos(200 * (x * x + y * y))).sum(axis=1)
    np.testing.assert_allclose(sums(ZonePlate(200.0, 0.25, 1.5), tile, boxes), expected, rtol=1e-12, atol=1e-13 * count)


@pytest.mark.parametrize("k", [0.0, 1e-12, 2e-9, 5e-9])
def test_constant_pixels_give_that_value_at_every_sample(k, constant_pixels):
    constant, sampled = constant_pixels(ZonePlate(k, 0.2, 0.3), 16)
    known = np.isfinite(constant)
    assert known.any()
    assert np.array_equal(sampled[known], constant[known])


def test_nothing_is_constant_where_rings_are_seen():
    edges = np.arange(9) / 8
    assert np.isnan(ZonePlate().constant(edges, edges)).all()
