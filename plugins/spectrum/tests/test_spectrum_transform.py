"""The sums themselves: against 50 digits, each method against the others, and zeros that must be zeros."""

import mpmath
import numpy as np
import pytest
from samplekit_spectrum import power, transform
from samplekit_spectrum.exponentials import separate
from samplekit_spectrum.frequencies import Cube
from samplekit_spectrum.transform import few_points, nufft_pair, nufft_slab, product_slab, slabs

import samplekit


def direct(points, vectors):
    """S at 50 digits for points[D, n] and vectors[K, D]."""
    with mpmath.workdps(50):
        return np.array(
            [
                complex(
                    mpmath.fsum(
                        mpmath.expjpi(-2 * mpmath.fdot([mpmath.mpf(float(v)) for v in vector], map(mpmath.mpf, point)))
                        for point in points.T.tolist()
                    )
                )
                for vector in vectors
            ]
        )


def edge_points(rng, count):
    """Random points among which are 0, the last number below 1, and a point that is there twice."""
    points = rng.random((2, count))
    points[:, 0] = 0.0
    points[:, 1] = np.nextafter(1.0, 0.0)
    points[:, 2] = points[:, 3]
    return points


@pytest.mark.parametrize(("count", "reach"), [(16, 6), (40, 4), (4, 64)])
def test_every_method_agrees_with_50_digits_to_1e_11_of_n(count, reach):
    rng = np.random.default_rng(1)
    first, second = edge_points(rng, count), edge_points(rng, count)
    cube = Cube(2, reach)
    chosen = rng.choice(cube.half, min(cube.half, 60), replace=False)
    vectors = cube.vectors(0, cube.half)[chosen]
    # The arrays' axes are (y, x).
    both = np.stack([first, second])[:, ::-1]
    exact = np.stack([direct(first, vectors), direct(second, vectors)])
    pair = np.empty((2, cube.half), np.complex128)
    separate(nufft_pair(both, cube), 0, pair)
    assert np.abs(pair[:, chosen] - exact).max() < 1e-11 * count
    for method in (product_slab, nufft_slab):
        parts = [method(both, cube, slab)[:, slab.start - slab.stop :] for slab in slabs(cube)]
        assert np.abs(np.concatenate(parts, axis=1)[:, chosen] - exact).max() < 1e-11 * count


@pytest.mark.parametrize("vector", [(2.0**40, 3.0), (0.5, -1.25), (123456789.0, 2.0**39 + 0.5), (1e-9, 0.0)])
def test_continuous_frequencies_up_to_2_to_the_40(vector):
    points = samplekit.points("jittered", 64, seed=3)[0].T
    exact = direct(points, [vector])[0] / 64
    spectrum = power("jittered", 64, realizations=1, frequencies=[vector], seed=3)
    assert abs(spectrum.mean[0] - abs(exact) ** 2) < 1e-13


@pytest.mark.parametrize("step", [0.25, 0.3, 2.5])
def test_a_step_is_a_list_of_its_multiples(step):
    grid = power("jittered", 400, realizations=2, max_frequency=12, step=step, seed=2)
    y, x = np.mgrid[-12:13, -12:13] * step
    listed = power("jittered", 400, realizations=2, frequencies=np.stack([x.ravel(), y.ravel()], axis=1), seed=2)
    np.testing.assert_allclose(grid.mean.ravel(), listed.mean, atol=1e-12)


@pytest.mark.parametrize("dims", [1, 2, 3])
@pytest.mark.parametrize("count", [8, 700])
def test_slabs_and_chunks_change_nothing(dims, count, monkeypatch):
    whole = power("random", count, realizations=3, max_frequency=9, dims=dims)
    monkeypatch.setattr(transform, "_SLAB", 40)
    monkeypatch.setattr("samplekit_spectrum.point_sets.CHUNK", 100)
    monkeypatch.setattr(transform, "LARGEST_WHOLE", 1)
    parts = power("random", count, realizations=3, max_frequency=9, dims=dims)
    np.testing.assert_allclose(parts.mean, whole.mean, atol=1e-12)
    np.testing.assert_allclose(parts.radial.power, whole.radial.power, atol=1e-12)


def test_the_axes_are_y_and_x():
    # x is a regular comb of 8, y is not: its power is on the row my = 0, at mx = 8.
    spectrum = power("hammersley", 8, max_frequency=9)
    assert spectrum.mean[9, 9 + 8] == pytest.approx(1.0, abs=1e-12)
    assert spectrum.mean[9 + 8, 9] == pytest.approx(1.0, abs=1e-12)
    spectrum = power("halton", 8, max_frequency=9)
    assert spectrum.mean[9, 9 + 8] == pytest.approx(1.0, abs=1e-12)
    assert spectrum.mean[9 + 8, 9] < 0.9


@pytest.mark.parametrize("reach", [16, 160])
def test_exact_zeros_of_a_net_are_zero_to_1e_20(reach):
    """Each coordinate of Hammersley's set is a regular grid of N: on the axes all below N is 0."""
    spectrum = power("hammersley", 1024, max_frequency=reach)
    rows = np.delete(spectrum.mean[reach], reach)
    columns = np.delete(spectrum.mean[:, reach], reach)
    assert rows.max() < 1e-20
    assert columns.max() < 1e-20


def test_the_choice_of_the_method_depends_on_sizes_alone():
    assert few_points(Cube(2, 128), 16)
    assert not few_points(Cube(2, 128), 4096)
    assert not few_points(Cube(1, 2**16), 4096)


@pytest.mark.parametrize("sampler", ["random", "jittered", "regular", "sobol+owen"])
def test_one_point_has_power_1_everywhere(sampler):
    spectrum = power(sampler, 1, realizations=3, max_frequency=5)
    np.testing.assert_allclose(spectrum.mean, 1.0, atol=1e-14)


def test_dc_is_exactly_1_and_the_spectrum_symmetric():
    for count in (5, 3000):
        spectrum = power("random", count, realizations=2, max_frequency=20)
        assert spectrum.mean[20, 20] == 1.0
        assert spectrum.standard_error[20, 20] == 0.0
        assert np.array_equal(spectrum.mean, spectrum.mean[::-1, ::-1])
