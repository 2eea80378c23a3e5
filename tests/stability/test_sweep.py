"""The sweep: verdicts are true, and an estimate that missed everything is not called right."""

import math

import numpy as np
import pytest

import samplekit
from samplekit import Option, SceneSpec
from samplekit._bases.reference import Reference
from samplekit._stability.measurement import measure
from samplekit._stability.results import precision_lost_beyond
from samplekit._stability.sweep import scenes_of
from samplekit._stability.verdict import chance_bound, judge

EDGES = np.array([0.0, 1.0])


def one(scene, sampler, count, **more):
    (cell,) = samplekit.stability(scene, sampler, [count], **more).cells
    return cell


def test_false_convergence_is_called_no_hits():
    """Estimate 0, variance 0: every sample missed."""
    cell = one("gaussian:sigma=1e-8", "sobol+owen", 256)
    assert cell.measured.estimate == 0.0
    assert cell.measured.spread == 0.0
    assert cell.measured.hits == 0.0
    assert cell.verdict.kind == "no hits"
    assert "variance is 0" in cell.verdict.reason


def test_missing_what_is_dark_is_false_convergence_as_well():
    """All samples are 1, and the hole is not seen: the mean is not 1."""
    cell = one("spike:peak=0,background=1,area=1e-8", "random", 64)
    assert cell.measured.estimate == 1.0
    assert cell.verdict.kind == "no hits"


@pytest.mark.parametrize("scene", ["power:a=0", "gaussian:sigma=1e8", "disk:radius=1e9", "zoneplate:k=0"])
def test_a_scene_that_is_constant_is_right(scene):
    cell = one(scene, "random", 1000)
    assert cell.verdict.kind == "right"
    assert cell.measured.digits_right > 15


def test_the_estimate_is_not_taken_from_the_error():
    """The ground of a spike is 48 orders of magnitude below its mean."""
    cell = one("spike:area=1e-12", "random", 64)
    assert cell.measured.estimate == pytest.approx(1e-30, rel=1e-15)
    assert cell.measured.error == pytest.approx(-1e18, rel=1e-9)


def test_infinite_variance_is_no_standard_error():
    assert one("power:a=0.9", "random", 256).verdict.kind == "infinite variance"
    assert one("power:a=0.25", "random", 256).verdict.kind == "right"


def test_precision_is_lost_on_a_high_pedestal_beyond_a_count():
    cells = samplekit.stability("offset:pedestal=1e12", "sobol+owen", [16, 256, 4096, 16384]).cells
    assert [cell.verdict.kind for cell in cells] == ["right", "right", "precision lost", "precision lost"]
    assert precision_lost_beyond(cells) == {("offset", "pedestal=1e12", "sobol+owen"): 256}
    # Rounding leaves what it leaves; without it sampling would go on converging.
    assert cells[-1].measured.arithmetic_error > 10 * cells[-1].measured.sampling_error


def test_what_a_sampler_does_not_make_is_refused_with_its_words():
    cell = one("oscillating:d=5", "fibonacci", 13)
    assert cell.measured is None
    assert cell.verdict.kind == "refused"
    assert "fibonacci" in cell.verdict.reason


def test_values_that_are_not_finite_are_counted():
    """Without randomization the first point is the origin, where the power is infinite."""
    cell = one("power:a=0.25", "sobol", 64, realizations=3)
    assert cell.verdict.kind == "invalid"
    assert cell.measured.invalid == 3
    assert math.isnan(cell.measured.estimate)


def test_a_sampler_that_is_not_random_has_no_standard_error():
    cell = one("disk:radius=0.3", "hammersley", 64)
    assert cell.verdict.kind == "not random"
    assert math.isnan(cell.measured.standard_error)


def test_a_wrong_estimate_is_found():
    """A reference that is off by a tenth of what one estimate errs: seen with enough realisations, not with few."""
    scene, sampler = samplekit.scene("disk"), samplekit.sampler("sobol+owen")
    exact = scene.exact(EDGES, EDGES)
    honest = measure(scene, sampler, 256, realizations=64, seed=1, reference=Reference(exact))
    wrong = Reference(exact + honest.spread)
    measured = measure(scene, sampler, 256, realizations=64, seed=1, reference=wrong)
    assert judge(honest, finite_variance=True, bound=chance_bound(64)).kind == "right"
    assert judge(measured, finite_variance=True, bound=chance_bound(64)).kind == "wrong"
    assert measured.standard_errors == pytest.approx(-8, abs=4)


def test_hits_are_those_of_a_set_in_bright_light():
    cell = one("disk:radius=0.1", "random", 1000, realizations=10)
    expected = math.pi * 0.01 * 10000
    assert cell.measured.hits == round(cell.measured.hits)
    assert abs(cell.measured.hits - expected) < 5 * math.sqrt(expected)


@pytest.mark.parametrize("count", [1, 16, 1500])
def test_digits_lost_are_few(count):
    for scene in (
        "gaussian:sigma=0.1",
        "spike:area=1e-12",
        "oscillating:family=corner-peak,d=6",
        "offset:pedestal=1e8",
    ):
        cell = one(scene, "random", count, realizations=8)
        assert 0.0 <= cell.measured.digits_lost <= 1.0


def test_a_name_alone_is_all_its_extremes_and_options_are_one():
    assert len(scenes_of(["gaussian"])) == len(samplekit.scene("gaussian").spec.extremes)
    assert scenes_of(["gaussian:sigma=2"]) == [("gaussian", "sigma=2")]
    assert scenes_of(["bilinear"]) == [("bilinear", "")]
    assert {name for name, _ in scenes_of([])} >= {
        spec.name for spec in samplekit.scenes() if not spec.required_options
    }


def test_extremes_are_declared_as_texts():
    assert SceneSpec("a", "b:C", "", options=(Option("k", 1.0),), extremes=("k=1", "k=2")).extremes == ("k=1", "k=2")
    for wrong in (["k=1"], ("k",), (1,), "k=1"):
        with pytest.raises(ValueError, match="extremes"):
            SceneSpec("a", "b:C", "", extremes=wrong)
