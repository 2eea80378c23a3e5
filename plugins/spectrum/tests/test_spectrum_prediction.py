"""Predicted against measured variance.

Intervals of 99 %: a case fails by chance for one seed in a hundred; the seeds are fixed.
"""

import math

import numpy as np
import pytest
from samplekit_spectrum import power, predict
from samplekit_spectrum.homogenized import homogenized
from samplekit_spectrum.measurement import summarize
from scipy.stats import chi2

import samplekit
from samplekit import Sampler, UsageError
from samplekit._cli import run


@pytest.mark.parametrize("scene", ["disk", "gaussian", "step"])
@pytest.mark.parametrize(
    "sampler",
    ["random", "jittered", "latin-hypercube", "multi-jittered", "correlated-multi-jittered", "sobol+owen"],
)
def test_the_ratio_is_1_within_its_interval(sampler, scene):
    row = predict(sampler, scene, 64, trials=6000, realizations=600, native=False, seed=1)
    assert row.verdict == "agrees"
    assert row.ratio_low <= 1.0 <= row.ratio_high < 1.25 * row.ratio_low


@pytest.mark.slow
@pytest.mark.parametrize(("sampler", "count"), [("poisson-disk", 100), ("lloyd", 64), ("ccvt", 64)])
def test_blue_noise_is_predicted_from_fresh_sets(sampler, count):
    pytest.importorskip("samplekit_bluenoise")
    row = predict(sampler, "disk", count, trials=2000, realizations=64, seed=3)
    assert row.verdict.startswith("agrees")
    assert 0.8 < row.ratio_low <= 1.0 <= row.ratio_high < 1.25
    # 40 shifts of each of 50 sets; natively a set is an estimate.
    assert (row.measured.trials, row.native.trials) == (2000, 50)


class Grids(Sampler):
    """Grids under a shift of each realisation."""

    def draw(self, count, dims, rng):
        side = math.isqrt(count)
        x, y = np.meshgrid(np.arange(side), np.arange(side))
        return (np.stack([x.ravel(), y.ravel()], axis=1) + rng.random(2)) / side


def test_a_centre_as_dark_as_it_may_be_is_not_left_out():
    """Grids of 16 x 16: all below 16 is 0, and the rest is the shifted grid's."""
    grids = samplekit.sampler(samplekit.SamplerSpec("grids", f"{__name__}:Grids", "shifted grids", dimensions=(2, 2)))
    row = predict(grids, "disk", 256, trials=2000, realizations=32, native=False)
    exact = predict("regular", "disk", 256, trials=4, native=False).predicted.variance
    assert 0.85 < row.ratio < 1.15
    assert row.predicted.tail < 0.7 * row.predicted.variance
    assert row.predicted.variance - row.predicted.tail < exact < row.predicted.variance + row.predicted.tail_bound


def test_a_set_is_shifted_several_times_and_no_tile_changes_that():
    inner = samplekit.sampler("jittered")
    shifted = homogenized(inner, 3)
    whole = np.empty((7, 2, 16))
    shifted.fill(whole, shifted.trials(0, 7, 5), 16, 0)
    sets = np.empty((3, 2, 16))
    inner.fill(sets, inner.trials(0, 3, 5), 16, 0)
    for number, points in enumerate(whole):
        shift = (points - sets[number // 3]) % 1.0
        np.testing.assert_allclose(shift, np.repeat(shift[:, :1], 16, axis=1), atol=1e-15)
    assert np.unique(np.round((whole - sets[np.arange(7) // 3]) % 1.0, 9)).size == 14
    for first, stop in ((0, 2), (2, 3), (3, 7), (5, 6)):
        part = np.empty((stop - first, 2, 16))
        shifted.fill(part, shifted.trials(first, stop, 5), 16, 0)
        np.testing.assert_array_equal(part, whole[first:stop])


@pytest.mark.slow
def test_the_standard_errors_are_those_of_other_seeds():
    """Chi squared of 8 seeds, a false alarm of 1e-3 to either side, with strata of different numbers of sets."""
    exact = 0.09 * math.pi * (1.0 - 0.09 * math.pi) / 16
    rows = [predict("random", "disk", 16, trials=4, seed=seed).predicted for seed in range(8)]
    scores = [(row.variance - exact) / row.standard_error for row in rows]
    assert all(row.standard_error < 0.005 * row.variance for row in rows)
    assert chi2.ppf(1e-3, 8) < np.square(scores).sum() < chi2.isf(1e-3, 8)


@pytest.mark.parametrize("scene", ["disk", "bilinear", "checker:cells=3", "step:angle=30"])
def test_sets_of_one_power_need_one_spectrum(scene):
    row = predict("halton+shift", scene, 100, trials=6000, seed=2)
    assert row.predicted.realizations == 1
    assert row.predicted.standard_error == 0.0
    assert row.predicted.bound == "proven"
    assert row.verdict.startswith("agrees")
    assert 0.85 < row.ratio < 1.15


@pytest.mark.parametrize(
    ("sampler", "scene", "more"), [("jittered", "gaussian", False), ("poisson-disk", "step", True)]
)
def test_the_interval_is_narrower_than_5_percent_by_default(sampler, scene, more):
    if sampler == "poisson-disk":
        pytest.importorskip("samplekit_bluenoise")
    row = predict(sampler, scene, 16, native=False)
    assert row.ratio_high - row.ratio_low < 0.05
    assert row.verdict == "agrees"
    # Poisson disks differ much at the lowest frequencies, of which the step has most.
    assert (row.measured.trials > 40_000) == more


def test_jitter_meets_its_closed_form():
    """With N E|S|^2 = 1 - sinc^2 sinc^2 the sum is known."""
    row = predict("jittered", "disk", 256, trials=100, realizations=200, max_frequency=128, native=False)
    from scipy.special import j1

    m = np.arange(-1024, 1025)
    rho = np.hypot(m[:, None], m)
    rho[1024, 1024] = 1.0
    coefficients = (0.3 * j1(2 * np.pi * 0.3 * rho) / rho) ** 2
    product = np.outer(np.sinc(m / 16) ** 2, np.sinc(m / 16) ** 2)
    terms = coefficients * (1.0 - product) / 256
    terms[1024, 1024] = 0.0
    exact = terms.sum() + 0.3 / (math.pi * 1024) * 0.85 / 256
    assert row.predicted.variance == pytest.approx(exact, rel=4 * row.predicted.standard_error / exact + 1e-3)
    assert 0 < row.predicted.tail <= row.predicted.tail_bound < 0.1 * row.predicted.variance


def test_the_shifted_grid_is_summed_over_its_dual():
    row = predict("regular", "disk", 256, trials=4000, native=True)
    assert row.predicted.realizations == 1
    assert row.verdict == "agrees"
    assert row.native.variance < 1e-28
    assert row.native.bias != 0.0


def test_both_zero_is_exact():
    row = predict("regular", "step", 64, trials=200)
    assert row.verdict == "exact"
    assert math.isnan(row.ratio)
    assert predict("random", "checker:cells=1", 4, trials=50).verdict == "exact"


def test_the_native_variance_is_another():
    row = predict("jittered", "bilinear", 16, trials=3000, realizations=100)
    assert row.native.variance < 0.3 * row.measured.variance
    assert predict("random", "bilinear", 16, trials=100, realizations=20).native is None
    assert predict("jittered+shift", "bilinear", 16, trials=100, realizations=20).native is None


def test_a_wrong_prediction_is_told():
    """Few frequencies leave a tail that is known to be large: nothing is claimed beyond its bound."""
    row = predict("sobol+owen", "disk", 256, trials=3000, realizations=50, max_frequency=2, native=False)
    assert row.predicted.tail > 0.1 * row.predicted.variance


@pytest.mark.slow
def test_the_tail_beyond_a_square_is_off_the_axes():
    """The axes are summed further, and are darker: a smaller square with its tail gives what a larger one sums."""
    settings = {"trials": 4, "realizations": 200, "native": False}
    small = predict("multi-jittered", "bilinear", 256, max_frequency=64, **settings).predicted
    large = predict("multi-jittered", "bilinear", 256, max_frequency=256, **settings).predicted
    assert small.tail > 2.0 * large.tail > 0.0
    # The same sets: four standard errors are ample.
    assert abs(small.variance - large.variance) < 4.0 * small.standard_error


def test_wrong_use_is_one_clear_line():
    for settings in ({"trials": 1}, {"realizations": 0}, {"max_frequency": 0}, {"seed": -1}):
        with pytest.raises(UsageError):
            predict("random", "disk", 4, **settings)
    with pytest.raises(UsageError, match="nearest"):
        predict("jittered", "disk", 7)
    with pytest.raises(UsageError, match="beyond float64"):
        predict("random", "spike:peak=1e290", 4)


@pytest.mark.parametrize("setting", ["--trials=2", "--max-frequency=9999", "--threads=9999"])
def test_wrong_settings_are_refused_before_anything_is_printed(setting, capsys):
    assert run(["predict", "-s", "random", "--scene", "disk", "-n", "4", setting]) == 2
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("settings", "verdict"),
    [
        ({"trials": 15}, "too few trials"),
        ({"trials": 1000, "realizations": 1}, "too few realizations"),
        ({"trials": 1000, "realizations": 15}, "too few realizations"),
    ],
)
def test_few_sets_are_not_judged(settings, verdict, capsys):
    row = predict("jittered", "gaussian", 16, native=False, max_frequency=16, **settings)
    assert (row.verdict, math.isnan(row.ratio_low), math.isnan(row.ratio_high)) == (verdict, True, True)
    words = [f"--{name}={value}" for name, value in settings.items()]
    assert run(["predict", "-s", "jittered", "--scene", "gaussian", "-n", "16", "-f", "16", *words]) == 0
    assert "nan" not in capsys.readouterr().out
    # Sets that all have the same power need one spectrum.
    assert predict("sobol+shift", "gaussian", 16, trials=1000, realizations=1, max_frequency=64).verdict == "agrees"


def test_a_rare_shape_that_too_few_trials_hit_is_not_judged():
    # Of 200 estimates with 16 samples, 0.09 hit the disk in the mean; of 4000, 1.8.
    for trials in (200, 4000):
        for seed in range(5):
            row = predict(
                "random", "disk:radius=0.003", 16, trials=trials, realizations=32, max_frequency=64, seed=seed
            )
            assert row.verdict == "too few trials"
    assert predict("random", "disk:radius=0.1", 16, trials=4000, max_frequency=64).verdict.startswith("agrees")


def test_few_sets_that_are_judged_differ_by_chance_as_often_as_is_said():
    # Of 192 cases 2 differ in the mean; 8 or more do in one of a thousand studies.
    differ = 0
    for sampler in ("jittered", "sobol+owen", "z-sobol", "r2"):
        for scene, count in (("gaussian", 16), ("disk", 16)):
            for seed in range(24):
                row = predict(
                    sampler, scene, count, trials=64, realizations=16, max_frequency=16, native=False, seed=seed
                )
                differ += row.verdict == "differs"
    assert differ < 8


def test_the_standard_error_of_a_variance():
    """It is sqrt(2 / T) of the variance for a normal sample, and nearly 0 for a coin with equal sides."""
    rng = np.random.default_rng(3)
    normal = summarize(rng.normal(size=100_000), 0.0)
    assert normal.standard_error == pytest.approx(math.sqrt(2 / 100_000) * normal.variance, rel=0.02)
    coin = summarize(np.tile([0.0, 1.0], 5000), 0.5)
    assert coin.standard_error < 1e-4 * coin.variance
    assert coin.bias == 0.0
    # Four estimates of a set each: what they share counts once.
    of_sets = np.repeat(rng.normal(size=5000), 4)
    assert summarize(of_sets, 0.0, 4).standard_error == pytest.approx(math.sqrt(2 / 5000), rel=0.1)


def test_predictions_hold_where_pixels_share_a_sequence():
    """The scatter of 20 predictions is the stated one: within 0.5 and 1.6 (false alarms 6e-4, from the chi-square).

    At most two of the 1 % of verdicts that are wrong (false alarms 1e-3).
    """
    rows = [predict("z-sobol", "gaussian", 64, seed=seed) for seed in range(20)]
    variances = [row.predicted.variance for row in rows]
    stated = math.sqrt(np.mean([row.predicted.standard_error**2 for row in rows]))
    assert 0.5 < np.std(variances, ddof=1) / stated < 1.6
    assert sum(row.verdict == "differs" for row in rows) <= 2


def test_spectra_show_no_bias_where_pixels_share_a_sequence():
    """Each of 20 spectra has a probability of 1e-3 of a false alarm."""
    spectra = [power("z-sobol", 4, realizations=200, max_frequency=16, seed=seed) for seed in range(20)]
    assert all(spectrum.bias.verdict == "none found" for spectrum in spectra)


def test_shared_sets_of_a_sampler_whose_pixels_share_a_sequence_come_from_blocks_of_their_own():
    inner, shifted = samplekit.sampler("z-sobol"), homogenized(samplekit.sampler("z-sobol"), 3)
    whole, sets = np.empty((7, 2, 16)), np.empty((3, 2, 16))
    shifted.fill(whole, shifted.trials(0, 7, 5), 16, 0)
    inner.fill(sets, inner.trials(0, 3, 5), 16, 0)
    for number, points in enumerate(whole):
        shift = (points - sets[number // 3]) % 1.0
        assert np.ptp((shift - shift[:, :1] + 0.5) % 1.0) < 1e-12
