"""Combinations: a count that a sampler cannot make is replaced by the nearest below, and the row says so."""

import numpy as np
import pytest

import samplekit
from samplekit._errors import UsageError
from samplekit._study.combinations import list_combinations
from samplekit._study.request import checked_request
from samplekit._study.resources import Resources


def combinations_of(samplers, counts, *, scenes=("disk",), trials=8, size=(1, 1)):
    return list_combinations(checked_request(scenes, samplers, counts, trials, size, 0), Resources())


def test_counts_are_replaced_by_the_nearest_below():
    combinations, left_out = combinations_of(["jittered", "random"], [13, 14, 16, 97])
    jittered = {combination.count: combination for combination in combinations if combination.sampler == "jittered"}
    assert {count: combination.asked for count, combination in jittered.items()} == {12: (13, 14), 16: (16,), 96: (97,)}
    assert "not 97" in jittered[96].replaced
    assert jittered[16].replaced == ""
    assert [combination.count for combination in combinations if combination.sampler == "random"] == [13, 14, 16, 97]
    assert left_out == []


def test_what_cannot_be_made_is_left_out_with_its_reason():
    combinations, left_out = combinations_of(
        ["orthogonal-array", "random", "poisson-disk"], [2, 9], scenes=["disk", "depth-of-field"]
    )
    assert {(combination.scene, combination.sampler) for combination in combinations} >= {
        ("disk", "poisson-disk"),
        ("depth-of-field", "random"),
    }
    reasons = {(item.scene, item.sampler, item.count): item.reason for item in left_out}
    assert "not 2" in reasons["disk", "orthogonal-array", 2]
    assert "2 dimensions" in reasons["depth-of-field", "poisson-disk", 9]


def test_nothing_left_is_an_error():
    with pytest.raises(UsageError, match="dimension"):
        combinations_of(["van-der-corput"], [16])


def test_sampler_that_is_not_random_has_one_trial():
    found = samplekit.compare(["hammersley", "hammersley+shift"], "gaussian", [64], trials=32, size=(1, 1), times=False)
    fixed, shifted = found.rows
    assert (fixed.trials, fixed.mse.low, fixed.mse.high) == (1, fixed.mse.estimate, fixed.mse.estimate)
    assert any("not random" in note for note in fixed.notes)
    edges = np.array([0.0, 1.0])
    error = samplekit.estimate("gaussian", "hammersley", 64)[0] - samplekit.scene("gaussian").exact(edges, edges)[0, 0]
    assert fixed.bias.estimate == pytest.approx(error, rel=1e-12)
    assert fixed.mse.estimate == pytest.approx(error**2, rel=1e-12)
    assert shifted.trials == 32
    assert shifted.mse.low is not None


def test_single_trial_says_that_it_has_no_interval():
    row = samplekit.compare("random", "disk", 16, trials=1, size=(8, 8), times=False).rows[0]
    assert (row.mse.low, row.variance.estimate) == (None, None)
    assert (row.no_interval, row.mse.low, row.mse.high) == ("few trials", None, None)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([], ["random"], [4]), "no scene"),
        ((["disk"], [], [4]), "no sampler"),
        ((["disk"], ["random"], []), "no counts"),
        ((["disk"], ["random", "random"], [4]), "given twice"),
        ((["disk"], ["random"], [0]), "positive"),
        ((["disk"], ["random"], [2**50]), "at most"),
    ],
)
def test_bad_requests(arguments, message):
    with pytest.raises(UsageError, match=message):
        checked_request(*arguments, 8, (1, 1), 0)
