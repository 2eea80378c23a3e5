"""Closed forms of the scenes' coefficients: against numerical integration, Parseval, and the sampled approximation."""

import math

import mpmath
import numpy as np
import pytest
from samplekit_spectrum.integrands import integrand_of
from samplekit_spectrum.integrands.products import _bell, _square_wave
from samplekit_spectrum.integrands.sampled import sampled_integrand
from samplekit_spectrum.integrands.zoneplate import _chirp

import samplekit

SCENES = [
    "disk", "disk:radius=0.1,cx=0.2,cy=0.5", "gaussian", "gaussian:sigma=0.25", "gaussian:sigma=0.3,cx=-0.1", "step",
    "gaussian:sigma=2,cx=1.5", "step:angle=30", "step:angle=90,offset=0.3", "step:angle=200,offset=-0.7", "checker",
    "checker:cells=5", "bilinear", "zoneplate:k=100", "zoneplate:k=200,cx=0.4,cy=1.2",
]  # fmt: skip


@pytest.mark.parametrize(
    ("centre", "sigma"), [(0.4523, 0.1), (0.5, 0.02), (0.9, 0.25), (-0.3, 0.4), (1.2, 0.1), (0.0, 1.0), (0.5, 30.0)]
)
def test_the_cut_off_bell_against_quadrature(centre, sigma):
    for m in (0, 1, 12):
        with mpmath.workdps(18):
            # Steepest descent would be shorter, but this is the definition.
            parts = sorted({0.0, 1.0, min(max(centre, 0.0), 1.0), *np.linspace(0.0, 1.0, m + 3)})
            exact = mpmath.quad(
                lambda x, m=m: mpmath.exp(-((x - centre) ** 2) / (2 * sigma**2)) * mpmath.expjpi(-2 * m * x), parts
            )
            square = float(abs(exact) ** 2)
        scale = float(_bell(np.zeros(1), centre, sigma)[0])
        assert _bell(np.array([m]), centre, sigma)[0] == pytest.approx(square, rel=1e-9, abs=1e-15 * scale)


@pytest.mark.parametrize("cells", [1, 2, 5, 8])
def test_the_square_wave_against_its_sum(cells):
    for m in (0, 1, 2, 3, 4, 5, 12, 20, 25):
        edges = np.arange(cells + 1) / cells
        signs = (-1.0) ** np.arange(cells)
        if m == 0:
            exact = signs.sum() / cells
        else:
            exact = (signs * np.diff(np.exp(-2j * np.pi * m * edges))).sum() / (-2j * np.pi * m)
        assert _square_wave(np.array([m]), cells)[0] == pytest.approx(abs(exact) ** 2, abs=1e-15)


@pytest.mark.parametrize(("k", "centre"), [(1.0, 0.0), (50.0, 0.3), (400.0, 0.0)])
def test_the_chirp_against_quadrature(k, centre):
    for m in (-3, 7):
        exact = mpmath.quad(
            lambda x, m=m: mpmath.expj(k * (x - centre) ** 2 - 2 * mpmath.pi * m * x),
            mpmath.linspace(0, 1, int(k / 4) + 8),
        )
        assert abs(_chirp(np.array([m]), centre, k)[0] - complex(exact)) < 1e-12


@pytest.mark.parametrize("text", SCENES)
def test_closed_forms_agree_with_the_sampled_scene(text):
    scene = samplekit.scene(text)
    closed, sampled = integrand_of(scene), sampled_integrand(scene)
    assert not closed.approximate
    assert sampled.approximate
    m = np.arange(-20, 21)
    x, y = np.meshgrid(m, m)
    keep = (x != 0) | (y != 0)
    ours, theirs = closed.power(x[keep], y[keep]), sampled.power(x[keep], y[keep])
    assert closed.mean == pytest.approx(sampled.mean, abs=1e-12)
    assert closed.energy == pytest.approx(sampled.energy, abs=2e-5)
    assert np.abs(ours - theirs).max() < 1e-4 * ours.max() + sampled.aliasing


@pytest.mark.parametrize(
    ("text", "reach", "missing"),
    [("disk", 128, 6.69e-4), ("gaussian:sigma=0.05,cx=0.5,cy=0.5", 40, 1e-12), ("zoneplate:k=60", 256, 2e-4)],
)
def test_parseval(text, reach, missing):
    integrand = integrand_of(samplekit.scene(text))
    m = np.arange(-reach, reach + 1)
    x, y = np.meshgrid(m, m)
    keep = (x != 0) | (y != 0)
    rest = integrand.variance - integrand.power(x[keep], y[keep]).sum()
    assert -1e-14 < rest < 1.01 * missing


def test_the_step_lives_on_an_axis():
    integrand = integrand_of(samplekit.scene("step"))
    assert integrand.axes_only
    m = np.arange(1, 8)
    expected = np.where(m % 2 == 1, 1.0 / (np.pi * m) ** 2, 0.0)
    np.testing.assert_allclose(integrand.power(m, 0 * m), expected, atol=1e-17)
    assert not integrand_of(samplekit.scene("step:angle=45")).axes_only


def test_a_disk_that_is_cut_is_sampled():
    integrand = integrand_of(samplekit.scene("disk:radius=0.3,cx=0.9"))
    assert integrand.approximate
    assert integrand.aliasing < 1e-3 * integrand.variance


def test_variances_of_one_random_sample():
    assert integrand_of(samplekit.scene("disk")).variance == pytest.approx(0.202800, abs=1e-6)
    assert integrand_of(samplekit.scene("checker")).variance == 0.25
    assert integrand_of(samplekit.scene("bilinear")).variance == pytest.approx(1 / 9 - 1 / 16, rel=1e-12)
    assert integrand_of(samplekit.scene("checker:cells=1")).variance == 0.0
    assert math.isclose(integrand_of(samplekit.scene("gaussian")).variance, 0.0274681, rel_tol=1e-3)
