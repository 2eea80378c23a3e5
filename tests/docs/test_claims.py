"""Figures of the pages and captions that no other test holds, measured anew with fixed seeds.

Every limit is at least four standard errors from what was measured: with other random numbers, one of all these tests
would fail by chance with a probability below 0.01.
"""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import samplekit

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
CHOOSING = (ROOT / "docs" / "choosing-a-sampler.md").read_text(encoding="utf-8")
SCENES = ("disk", "gaussian")
POWERS = tuple(2**m for m in range(2, 13))


@cache
def variance(scene, sampler, count, realizations=1000):
    return samplekit.estimate(scene, sampler, count=count, realizations=realizations).var()


def exponent(scene, sampler, counts, realizations=1000):
    """Slope of the variance against the count, both as logarithms."""
    variances = [variance(scene, sampler, count, realizations) for count in counts]
    return np.polyfit(np.log(counts), np.log(variances), 1)[0]


@pytest.mark.parametrize(
    ("sampler", "disk", "gaussian"),
    [
        ("random", -1.0, -1.0),
        ("latin-hypercube", -1.03, -1.05),
        ("jittered", -1.5, -1.9),
        ("halton+owen", -1.5, -1.9),
        ("sobol+owen", -1.5, -2.4),
        ("pmj02", -1.5, -2.4),
        ("correlated-multi-jittered", -1.55, -3.0),
    ],
)
def test_exponents_of_the_convergence_figures(sampler, disk, gaussian):
    assert exponent("disk", sampler, POWERS) == pytest.approx(disk, abs=0.1)
    assert exponent("gaussian", sampler, POWERS) == pytest.approx(gaussian, abs=0.1)


def test_correlated_multi_jitter_is_poor_where_opposite_edges_differ_and_lattices_are_better_where_they_do_not():
    assert "on x y: -1.55 ± 0.04" in CHOOSING
    assert exponent("bilinear", "correlated-multi-jittered", POWERS) == pytest.approx(-1.55, abs=0.06)
    correlated = variance("gaussian", "correlated-multi-jittered", 1024)
    assert max(variance("gaussian", "rank1", 1024), variance("gaussian", "fibonacci", 987)) < 1e-3 * correlated


def test_counts_that_are_no_powers_of_two():
    for count, ratio in ((100, 4), (1000, 13)):
        assert f"{ratio} times" in CHOOSING
        found = variance("bilinear", "r2", count, 4000) / variance("bilinear", "halton+owen", count, 4000)
        assert found == pytest.approx(ratio, rel=0.25)
    for scene in SCENES:
        assert variance(scene, "sobol+owen", 1000, 4000) > variance(scene, "sobol+owen", 1024, 4000)


def test_a_shifted_net_loses_where_opposite_edges_differ():
    assert "about 900 times the variance" in CHOOSING
    ratio = variance("bilinear", "sobol+shift", 1024, 4000) / variance("bilinear", "sobol+owen", 1024, 4000)
    assert ratio == pytest.approx(900, rel=0.25)


@pytest.mark.parametrize(("d", "sides"), [(3, (3, 4, 6, 8, 11, 16)), (4, (2, 3, 4, 5, 6, 7, 8))])
def test_exponents_of_jitter_in_more_dimensions(d, sides):
    counts = [side**d for side in sides]
    edge, smooth = (f"oscillating:family={family},d={d}" for family in ("discontinuous", "gaussian,difficulty=4"))
    assert exponent(edge, "jittered", counts, 6000) == pytest.approx(-1 - 1 / d, abs=0.12)
    assert exponent(smooth, "jittered", counts, 6000) == pytest.approx(-1 - 2 / d, abs=0.05)


def test_first_points_of_high_halton_dimensions_lie_on_a_line():
    points = samplekit.points("halton", 20, 36)[0]
    assert np.corrcoef(points[:, 34], points[:, 35])[0, 1] > 0.999


def test_what_z_sobol_leaves_after_a_blur():
    """Four trials in place of the page's sixteen: a figure has a standard error of a tenth of itself."""
    rows = re.findall(r"^\| `(\w+)`, `(z-sobol\S*)` \| (.*) \|$", CHOOSING, re.MULTILINE)
    assert len(rows) == 6
    counts, samplers = (1, 4, 16, 64), ("sobol+owen", "z-sobol", "z-sobol:orders=random")
    scenes = {scene for scene, _, _ in rows}
    study = samplekit.compare(samplers, scenes, counts, trials=4, size=(512, 512), times=False)
    blurred = {(row.scene, row.sampler, row.count): row.blurred_mse.estimate for row in study.rows}
    for scene, sampler, figures in rows:
        for count, figure in zip(counts, map(float, figures.split(" | ")), strict=True):
            found = blurred[scene, sampler, count] / blurred[scene, "sobol+owen", count]
            assert abs(np.log(found / figure)) < 0.6, (scene, sampler, count, found)


@pytest.mark.parametrize("scene", SCENES)
def test_poisson_disks_beat_jitter_at_few_samples_and_lose_at_many(scene):
    pytest.importorskip("samplekit_bluenoise")
    for count, ahead, behind in (
        (16, "poisson-disk", "jittered"),
        (64, "poisson-disk", "jittered"),
        (256, "jittered", "poisson-disk"),
        (4096, "jittered", "poisson-disk"),
    ):
        trials = 8000 if count <= 64 else 2000
        assert variance(scene, ahead, count, trials) < variance(scene, behind, count, trials)


def test_exponents_of_poisson_disks():
    pytest.importorskip("samplekit_bluenoise")
    late = POWERS[6:]
    assert exponent("gaussian", "poisson-disk", late, 2000) == pytest.approx(-0.99, abs=0.08)
    assert exponent("disk", "poisson-disk", late, 2000) == pytest.approx(-1.11, abs=0.08)
    assert exponent("disk", "poisson-disk", POWERS[2:], 2000) == pytest.approx(-1.18, abs=0.05)


@pytest.mark.parametrize("count", [16, 64])
def test_a_shift_costs_jitter_the_seam(count):
    def of_mean(sampler):
        return samplekit.points(sampler, count, dims=1, realizations=20_000).mean(axis=1).var()

    assert 12 * count**3 * of_mean("jittered") == pytest.approx(1.0, rel=0.06)
    assert 6 * count**2 * of_mean("jittered+shift") == pytest.approx(1.0, rel=0.1)


def test_two_jittered_points_on_a_step_at_a_half():
    def of_step(sampler):
        return (samplekit.points(sampler, 2, dims=1, realizations=100_000) < 0.5).mean(axis=1).var()

    assert of_step("jittered") == 0.0
    assert of_step("jittered+shift") == pytest.approx(1 / 12, rel=0.03)


@pytest.mark.parametrize("distance", [1.0, 1.5, 2.5])
def test_the_weight_of_uniform_directions_changes_the_order_of_samplers(distance):
    """A floor point beside a sphere of radius 0.9 at a height of 1, with 96 rays."""
    pytest.importorskip("samplekit_bluenoise")

    def variances(sampler):
        u, v = np.moveaxis(samplekit.points(sampler, 96, realizations=6000), 2, 0)

        def visible(up):
            along = np.sqrt(1.0 - up**2) * np.cos(2.0 * np.pi * v) * distance + up
            return (along <= 0.0) | (along**2 <= distance**2 + 1.0 - 0.81)

        return (2.0 * u * visible(u)).mean(axis=1).var(), visible(np.sqrt(u)).mean(axis=1).var()

    uniform, cosine = zip(*map(variances, ("random", "jittered", "poisson-disk", "ccvt")), strict=True)
    assert uniform[1] < uniform[2]
    assert cosine[0] > cosine[1] > cosine[2] > cosine[3]


@pytest.mark.parametrize(
    ("scene", "count", "side", "shares"),
    [
        ("checker:cells=9", 16, 128, {"jittered": (0.21, 0.27)}),
        ("depth-of-field", 16, 240, {"uncorrelated-jitter": (0.24, 0.29), "sobol+owen": (0.16, 0.2)}),
        ("motion-blur:aperture=0.05", 16, 240, {"uncorrelated-jitter": (0.25, 0.3), "sobol+owen": (0.25, 0.3)}),
        (
            "ambient-occlusion:pixel-filter=center",
            96,
            160,
            {"jittered": (0.2, 0.23), "poisson-disk": (0.2, 0.22), "ccvt": (0.12, 0.14)},
        ),
        ("zoneplate:k=300", 4, 144, {"sobol+owen": (0.23, 0.27), "halton": (0.7, 1.1), "regular": (0.0, 0.05)}),
        ("zoneplate:k=300", 16, 144, {"sobol+owen": (0.028, 0.036), "sobol": (0.1, 1.0), "regular": (0.0, 0.01)}),
    ],
)
def test_captions_of_images(scene, count, side, shares):
    """The images of the gallery themselves: shares of the mean squared error of random points."""
    if "ccvt" in shares:
        pytest.importorskip("samplekit_bluenoise")

    def mse(sampler):
        return samplekit.render(scene, sampler, count, size=(side, side)).metrics["mse"]

    random = mse("random")
    for sampler, (low, high) in shares.items():
        assert low < mse(sampler) / random < high, sampler


def test_at_one_sample_a_pixel_every_random_sampler_is_the_random_one():
    def mse(sampler):
        return samplekit.render("zoneplate:k=300", sampler, 1, size=(144, 144)).metrics["mse"]

    for sampler in ("jittered", "multi-jittered", "halton+owen", "sobol+xor", "sobol+owen", "pmj02", "z-sobol", "r2"):
        assert mse(sampler) == pytest.approx(mse("random"), rel=0.04), sampler


def test_captions_of_spectra():
    samplekit_spectrum = pytest.importorskip("samplekit_spectrum")

    def normalized(sampler, count=256):
        return samplekit_spectrum.power(sampler, count, realizations=400, max_frequency=64)

    sobol, shifted = normalized("sobol").normalized, normalized("sobol+xor").normalized
    for power in (sobol, shifted):
        assert np.mean(power < 1e-9) == pytest.approx(2 / 3, abs=0.02)
        assert np.sort(power.ravel())[-3] > 100.0
    net, progressive = normalized("sobol+owen"), normalized("pmj02")
    difference = 256 * np.abs(net.radial.power - progressive.radial.power)
    assert np.all(difference < 256 * 5 * np.hypot(net.radial.standard_error, progressive.radial.standard_error))
