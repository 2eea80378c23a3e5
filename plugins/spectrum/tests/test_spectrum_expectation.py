"""Means over realisations: threads, blocks, interrupts, errors of the mean."""

import numpy as np
import pytest
from samplekit_spectrum import power
from samplekit_spectrum.moments import Moments
from samplekit_spectrum.spectrum import powers

import samplekit
from samplekit import UsageError


def test_threads_change_no_bit():
    for count in (16, 500):
        one = power("jittered", 16 if count == 16 else 504, realizations=301, max_frequency=16, threads=1)
        two = power("jittered", 16 if count == 16 else 504, realizations=301, max_frequency=16, threads=3)
        assert np.array_equal(one.mean, two.mean)
        assert np.array_equal(one.standard_error, two.standard_error)
        assert np.array_equal(one.radial.standard_error, two.radial.standard_error)


@pytest.mark.parametrize("count", [12, 600])
def test_mean_and_standard_error_are_those_of_single_spectra(count):
    sets = samplekit.points("random", count, realizations=7, seed=9)
    m = np.arange(-6, 7)
    single = []
    for points in sets:
        x = np.exp(-2j * np.pi * np.outer(m, points[:, 0]))
        y = np.exp(-2j * np.pi * np.outer(m, points[:, 1]))
        single.append(np.abs(y @ x.T / count) ** 2)
    spectrum = power("random", count, realizations=7, max_frequency=6, seed=9)
    np.testing.assert_allclose(spectrum.mean, np.mean(single, axis=0), atol=1e-13)
    np.testing.assert_allclose(spectrum.standard_error, np.std(single, axis=0, ddof=1) / np.sqrt(7), atol=1e-13)
    radius = np.floor(np.hypot(*np.meshgrid(m, m)) + 0.5)
    for ring in range(1, 7):
        means = [one[radius == ring].mean() for one in single]
        assert spectrum.radial.power[ring - 1] == pytest.approx(np.mean(means), abs=1e-13)
        assert spectrum.radial.standard_error[ring - 1] == pytest.approx(np.std(means, ddof=1) / np.sqrt(7), abs=1e-13)
        assert spectrum.radial.frequencies[ring - 1] == np.count_nonzero(radius == ring)


def test_merging_is_adding():
    rng = np.random.default_rng(0)
    rings = np.array([0, 1, 1, 2, 2], np.int32)
    sums = rng.normal(size=(9, 5)) + 1j * rng.normal(size=(9, 5))
    weights = rng.random(5)
    together, first, second = (Moments(rings, weights) for _ in range(3))
    together.add([(0, sums)], 9, 4)
    first.add([(0, sums[:4])], 4, 4)
    second.add([(0, sums[4:])], 5, 4)
    first.merge(second)
    for name in ("mean", "squares", "amplitude", "ring_mean", "ring_squares", "totals"):
        np.testing.assert_allclose(getattr(first, name), getattr(together, name), rtol=1e-12, atol=1e-15)


def test_an_interrupt_keeps_what_is_done_if_that_is_wanted():
    def interrupt(done, total):
        if done >= 1000:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        power("random", 64, realizations=10**6, max_frequency=32, progress=interrupt)
    (kept,) = powers(
        "random", 64, [None], realizations=10**6, max_frequency=32, progress=interrupt, keep_interrupted=True
    )
    assert kept.interrupted
    assert 1000 <= kept.realizations < 10**6
    # White: 5 standard errors, about one false alarm in a million for a fixed seed that is met once.
    assert abs(64 * kept.radial.power[5] - 1) < 5 * 64 * kept.radial.standard_error[5]


def test_projections_of_one_run_are_those_of_their_own():
    pair, triple = powers("sobol+owen", 64, [(0, 2), (3, 1)], realizations=4, max_frequency=8, dims=4)
    alone = power("sobol+owen", 64, realizations=4, max_frequency=8, dims=4, project=(3, 1))
    assert np.array_equal(triple.mean, alone.mean)
    assert not np.array_equal(pair.mean, alone.mean)
    assert np.array_equal(
        triple.mean, power("sobol+owen", 64, realizations=4, max_frequency=8, dims=4, project=(1, 3)).mean.T
    )


def test_a_sampler_that_is_not_random_is_taken_once():
    spectrum = power("halton", 100, realizations=10**9, max_frequency=4)
    assert (spectrum.realizations, spectrum.randomized) == (1, False)
    assert spectrum.standard_error.max() == 0.0


def test_homogenizing_keeps_the_power_and_takes_the_bias():
    native = power("hammersley", 64, max_frequency=40)
    shifted = power("hammersley", 64, realizations=64, max_frequency=40, homogenize=True)
    np.testing.assert_allclose(shifted.mean, native.mean, atol=1e-12)
    assert native.bias.verdict == "biased"
    assert shifted.bias.verdict == "none found"
    assert shifted.sampler == "hammersley+shift"
    twice = power("sobol+owen", 64, realizations=64, max_frequency=8, homogenize=True)
    np.testing.assert_allclose(twice.mean, power("sobol+owen", 64, realizations=64, max_frequency=8).mean, atol=1e-12)


@pytest.mark.parametrize(
    "sampler", ["random", "jittered", "multi-jittered", "latin-hypercube", "sobol+owen", "sobol+xor"]
)
def test_random_samplers_are_unbiased_natively(sampler):
    """Each a false alarm of 1e-3 for its fixed seed."""
    assert power(sampler, 64, realizations=256, max_frequency=16).bias.verdict == "none found"


def test_a_bias_is_found_and_few_realizations_are_not_judged():
    assert power("regular", 64, max_frequency=16).bias.verdict == "biased"
    assert power("random", 64, realizations=4, max_frequency=16).bias.verdict == "too few realizations"


def test_between_the_integers_an_unbiased_sampler_has_the_transform_of_the_square():
    """Two false alarms of 1e-3. Hammersley's points are biased at 2^4 and nowhere between."""
    for where in ({"max_frequency": 16, "step": 0.3}, {"frequencies": [[0.0, 0.0], [0.5, 0.25], [2.0**39 + 0.5, 0.0]]}):
        assert power("random", 16, realizations=400, **where).bias.verdict == "none found"
        shifted = power("hammersley", 16, realizations=400, homogenize=True, **where)
        assert shifted.bias.verdict == "none found"
    native = power("hammersley", 16, frequencies=[[0.0, 0.0], [16.0, 0.0]]).bias
    assert (native.verdict, native.frequency) == ("biased", (16.0, 0.0))


def test_rings_of_a_set_that_is_not_random_have_no_error():
    assert np.array_equal(power("regular", 16, max_frequency=4).radial.standard_error, np.zeros(4))


@pytest.mark.parametrize(
    "wrong",
    [
        {"count": 0}, {"count": 7, "sampler": "jittered"}, {"realizations": 0}, {"max_frequency": 0},
        {"max_frequency": 2**30}, {"step": 0.0}, {"step": float("nan")}, {"dims": 5}, {"project": (0, 0)},
        {"project": (0, 9), "dims": 3}, {"project": (-1, 0)}, {"project": (0, 1, 2, 3)}, {"frequencies": [[1.0]]},
        {"frequencies": [[2.0**41, 0.0]]}, {"frequencies": [[float("nan"), 0.0]]}, {"seed": -1},
        {"frequencies": [[1.0, 2.0]], "max_frequency": 3}, {"frequencies": []},
    ],
)  # fmt: skip
def test_wrong_use_is_one_clear_line(wrong):
    settings = {"sampler": "random", "count": 16, "realizations": 2} | wrong
    with pytest.raises(UsageError) as error:
        power(settings.pop("sampler"), settings.pop("count"), **settings)
    assert "\n" not in str(error.value)


def test_too_much_memory_is_refused():
    with pytest.raises(samplekit.SamplekitError, match="memory"):
        power("random", 16, realizations=2, max_frequency=2**19)
