from dataclasses import replace

import pytest

from samplekit._report.answers import answers, budgets
from samplekit._study.results import Choice, Interval, ToTarget

NOTHING = Interval(None)


def test_sentences_stand_with_their_scene_and_those_about_one_sampler_apart(study):
    needs = [
        ToTarget("disk", "jittered", 1e-3, Interval(40.0, 36.0, 44.0), Interval(3e-3, 2.5e-3, 3.5e-3)),
        ToTarget("disk", "random", 1e-3, Interval(None, 64.0), Interval(None, 4e-3)),
        ToTarget("gaussian", "random", 1e-3, Interval(None, 64.0), NOTHING),
    ]
    disk, gaussian = answers(replace(study(scenes=("disk", "gaussian")), to_target=needs, front=[]))
    assert disk.lead == ["The target is an mse of 0.001; jittered needs the fewest samples and the least time."]
    assert disk.details == [
        "jittered: needs 40 samples (36 to 44) and 3 ms (2.5 ms to 3.5 ms); its mse falls as N^-1.50 (-1.54 to -1.46).",
        "random: needs more than 64 samples; its mse falls as N^-1.00 (-1.03 to -0.97; theory: N^-1).",
    ]
    assert gaussian.lead == ["The target is an mse of 0.001."]


def test_a_scene_whose_name_begins_another_keeps_its_own_sentences(study):
    needs = [ToTarget("disk:radius=0.1", "jittered", 1e-3, Interval(40.0), NOTHING)]
    results = replace(study(scenes=("disk", "disk:radius=0.1")), to_target=needs, target={"disk:radius=0.1": 1e-3})
    disk, small = answers(results)
    assert disk.lead == []
    assert small.details[0].startswith("jittered: needs 40 samples (without an interval)")


def test_ranges_fill_the_strip():
    front = [
        Choice("disk", ["random"], 1e-6, 1e-5),
        Choice("disk", ["random", "sobol+owen"], 1e-5, 1e-4),
        Choice("disk", ["sobol+owen"], 1e-4, None),
    ]
    first, second, third = budgets(front)
    assert first.words == "from 1.0 µs to 10 µs: random"
    assert second.words == "from 10 µs to 100 µs: random or sobol+owen"
    assert first.start == 0.0
    assert second.start == pytest.approx(first.width)
    assert third.start + third.width == pytest.approx(100.0)
    assert first.width > third.width > 5.0


def test_a_single_choice_and_none():
    (only,) = budgets([Choice("disk", ["random"], 1e-6, None)])
    assert (only.start, only.width) == (0.0, 100.0)
    assert budgets([]) == []
