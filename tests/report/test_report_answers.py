from dataclasses import replace

import pytest

from samplekit._report.answers import answers, budgets
from samplekit._study.results import Choice, ToTarget


def test_sentences_stand_with_their_scene_and_those_about_one_sampler_apart(study):
    needs = [ToTarget("disk", "jittered", 1e-3, 40.0, 3e-3, ""), ToTarget("gaussian", "random", 1e-3, None, None, "no")]
    disk, gaussian = answers(replace(study(scenes=("disk", "gaussian")), to_target=needs, front=[]))
    assert disk.lead == ["For an mse of 0.001, jittered needs the fewest samples (40) and the least time (3 ms)."]
    assert disk.details == ["jittered: needs 40 samples and 3 ms, the least; its mse falls as N^-1.50."]
    assert gaussian.lead == ["No sampler reaches an mse of 0.001."]


def test_a_scene_whose_name_begins_another_keeps_its_own_sentences(study):
    needs = [ToTarget("disk:radius=0.1", "jittered", 1e-3, 40.0, None, "")]
    results = replace(study(scenes=("disk", "disk:radius=0.1")), to_target=needs, target={"disk:radius=0.1": 1e-3})
    disk, small = answers(results)
    assert disk.lead == []
    assert small.details[0].startswith("jittered: needs 40 samples")


def test_choices_of_one_sampler_in_a_row_are_one_range_and_ranges_fill_the_strip():
    front = [
        Choice("disk", "random", 4, 1e-2, 1e-6, 1e-5),
        Choice("disk", "random", 16, 1e-3, 1e-5, 1e-4),
        Choice("disk", "sobol+owen", 16, 1e-4, 1e-4, None),
    ]
    first, second = budgets(front)
    assert first.sampler == "random"
    assert "4 to 16 samples" in first.words
    assert "from 1.0 µs to 100 µs" in first.words
    assert first.start == 0.0
    assert second.start == pytest.approx(first.width)
    assert second.start + second.width == pytest.approx(100.0)
    assert first.width > second.width > 5.0


def test_a_single_choice_and_none():
    (only,) = budgets([Choice("disk", "random", 4, 1e-2, 1e-6, None)])
    assert (only.start, only.width) == (0.0, 100.0)
    assert budgets([]) == []
