"""Verdicts on right cells and on wrong ones: false alarms are as rare as stated, and faults are found."""

import math
from random import Random

import numpy as np
import pytest
from cells import faults, random_cell
from scipy.special import stdtr
from scipy.stats import binom

import samplekit
from samplekit._builtin.samplers.random import Random as RandomSampler
from samplekit._builtin.scenes.gaussian import Gaussian
from samplekit._integrate.hits import ENOUGH_HITS, describe_hits, effective_hits
from samplekit._stability.verdict import CONFIRMING_BOUND, CONFIRMING_REALIZATIONS, FALSE_ALARMS, chance_bound


def one(scene, sampler, count, **more):
    (cell,) = samplekit.stability(scene, sampler, [count], **more).cells
    return cell


@pytest.mark.parametrize("realizations", [2, 32])
def test_estimates_that_are_all_equal_are_no_hits(realizations):
    """Samples see both values, but the edge lies on that of a stratum, and the strip between them is never hit."""
    found = samplekit.stability("step:angle=1e-12,offset=0.25", "jittered", [16], realizations=realizations)
    (cell,) = found.cells
    assert cell.measured.hits > 0.0
    assert cell.measured.spread == cell.measured.effective_realizations == 0.0
    assert cell.measured.realizations == CONFIRMING_REALIZATIONS
    assert cell.verdict.kind == "no hits"
    assert "all 256 estimates are 0.25" in cell.verdict.reason
    assert faults(found) == []


def test_a_strip_that_few_realisations_hit_is_not_wrong():
    """32 estimates are equal; of 256 with another seed four differ, which explains the error."""
    scene = "disk:radius=81277.609,cx=-81277.109,cy=0.97"
    assert np.ptp(samplekit.estimate(scene, "jittered", 4096, realizations=32)) == 0.0
    found = samplekit.stability(scene, "jittered", [4096])
    assert found.cells[0].verdict.kind == "right"
    assert faults(found) == []


@pytest.mark.parametrize(
    ("scene", "sampler", "count", "realizations", "seed"),
    [
        ("disk:radius=0.3", "random", 256, 2, 0),
        ("disk:radius=0.3", "sobol+owen", 256, 3, 211),
        ("power:a=0.4957", "halton+owen", 1024, 16, 112),
        ("power:a=0.4957", "halton+owen", 64, 32, 4),
        ("power:a=0.4957", "halton+owen", 64, 32, 50),
    ],
)
def test_beyond_four_standard_errors_twice_is_chance_for_few_or_skewed_estimates(
    scene, sampler, count, realizations, seed
):
    assert one(scene, sampler, count, realizations=realizations, seed=seed).verdict.kind == "right"


def test_a_pedestal_that_cancels_the_values_leaves_their_rounding():
    """Values of 1 - 1e-12 are rounded to 1e-16, with a bias that their differences from 1 keep."""
    scene = "offset:pedestal=-1,scene=zoneplate:k=6.396e-06+cx=0.375+cy=0.5"
    assert one(scene, "sobol+owen", 512, realizations=1024).verdict.kind == "right"


@pytest.mark.parametrize("realizations", [2, 3, 5, 8, 32, 1000])
def test_chance_is_as_rare_as_stated_for_normal_estimates(realizations):
    assert 2.0 * stdtr(realizations - 1, -chance_bound(realizations)) == pytest.approx(FALSE_ALARMS, rel=1e-9)
    assert chance_bound(1) == math.inf


def test_false_alarms_of_rare_events_are_rarer_than_stated():
    """Exact, for 256 estimates of two values and every probability of the rarer one: below 1e-10.

    Symmetric estimates exceed the bound with a probability below 2e-11 whatever their distribution.
    """
    number = CONFIRMING_REALIZATIONS
    k = np.arange(1, number)
    error = np.sqrt(k / number * (1.0 - k / number) / (number - 1))
    enough = [describe_hits(min(hits, number - hits), number) == "" for hits in k]
    assert describe_hits(ENOUGH_HITS, number) == ""
    assert describe_hits(ENOUGH_HITS - 1.0, number) == "few hits"
    rates = [
        binom.pmf(k, number, p)[enough & (np.abs(k / number - p) > CONFIRMING_BOUND * error)].sum()
        for p in np.geomspace(1e-6, 0.5, 500)
    ]
    assert max(rates) < 1e-10
    self_normalized = CONFIRMING_BOUND * math.sqrt(number / (number - 1 + CONFIRMING_BOUND**2))
    assert 2.0 * math.exp(-(self_normalized**2) / 2.0) < 2e-11


def test_effective_hits():
    estimates = np.full(100, 0.3)
    assert effective_hits(estimates) == 0.0
    estimates[:7] = 0.4
    assert effective_hits(estimates) == pytest.approx(7.0, rel=1e-12)
    assert effective_hits(-1e200 * estimates) == pytest.approx(7.0, rel=1e-12)
    assert effective_hits(estimates - 0.35, allowance=0.11) == 0.0
    # Rounding differs everywhere, and hits nothing.
    noise = np.random.default_rng(3).standard_normal(100)
    assert effective_hits(estimates + 1e-15 * noise, allowance=1e-14) == pytest.approx(7.0, rel=1e-9)
    assert effective_hits(noise) == pytest.approx(200.0 / math.pi, rel=0.15)
    assert effective_hits(noise**9) < 10.0
    assert [describe_hits(hits, 32) for hits in (0.0, 1.0, 6.0, 7.0)] == ["no hits", "few hits", "few hits", ""]


def test_a_reference_that_is_off_by_a_thousandth_is_found(monkeypatch):
    """Each of ten seeds; it is about 10 standard errors of 32 estimates."""
    exact = Gaussian.exact
    monkeypatch.setattr(Gaussian, "exact", lambda *given: exact(*given) * 1.001)
    for seed in range(10):
        cell = one("gaussian:sigma=0.1", "sobol+owen", 4096, seed=seed)
        assert cell.verdict.kind == "wrong"
        assert cell.repeated
        assert cell.measured.realizations == CONFIRMING_REALIZATIONS


@pytest.mark.parametrize("scene", ["bilinear", "power:a=0.25", "gaussian:sigma=0.3"])
def test_a_sampler_with_a_bias_of_ten_standard_errors_is_found(scene, monkeypatch):
    """Each of ten seeds; points are moved towards 1 until the mean is off by 10 standard errors of 32 estimates."""
    spread = np.std(samplekit.estimate(scene, "random", 256, realizations=1024))
    configured = samplekit.scene(scene)
    exact = configured.reference(np.array([0.0, 1.0]), np.array([0.0, 1.0])).image[0, 0]
    fill = RandomSampler.fill
    power = 1.0

    def biased(*given):
        fill(*given)
        np.power(given[1], power, out=given[1])

    monkeypatch.setattr(RandomSampler, "fill", biased)
    while True:
        bias = abs(samplekit.estimate(scene, "random", 256, realizations=1024).mean() - exact) / spread * math.sqrt(32)
        if bias > 10.0:
            break
        power *= 0.95
    assert bias < 16.0
    for seed in range(10):
        assert one(scene, "random", 256, seed=seed).verdict.kind == "wrong"


def test_no_sentence_has_a_number_that_is_none():
    for scene in ("power:a=0.6", "offset:pedestal=1e15", "disk", "gaussian:sigma=1e-8", "bilinear"):
        for sampler in ("sobol", "hammersley", "random"):
            for realizations in (1, 2, 5):
                assert faults(samplekit.stability(scene, sampler, [64], realizations=realizations)) == []


@pytest.mark.slow
@pytest.mark.parametrize("part", range(4))
def test_no_right_cell_is_called_wrong(part):
    """1200 random cells. Of 20 000 others none was; `python benchmarks/verdicts.py` repeats that."""
    cells = [random_cell(Random(f"test {part} {k}")) for k in range(300)]
    assert [(cell, found) for cell in cells if (found := faults(cell.sweep()))] == []
