from dataclasses import replace

import pytest

from samplekit._report.answers import arranged, budgets
from samplekit._study.results import Choice


def test_sentences_stand_with_their_scene_and_those_about_one_sampler_apart(study):
    sentences = ["disk, jittered: needs 3 ms", "disk: up to 1 ms random is best", "gaussian: same", "all is well"]
    (disk, gaussian), general = arranged(replace(study(), sentences=sentences))
    assert disk.lead == ["Up to 1 ms random is best"]
    assert disk.details == ["jittered: needs 3 ms"]
    assert gaussian.lead == ["Same"]
    assert general == ["all is well"]


def test_a_scene_whose_name_begins_another_keeps_its_own_sentences(study):
    results = replace(study(scenes=("disk", "disk:radius=0.1")), sentences=["disk:radius=0.1: all alike"])
    (disk, small), _ = arranged(results)
    assert disk.lead == []
    assert small.lead == ["All alike"]


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
