"""``samplekit.testing.check`` does in Python what the command does."""

import pytest

from samplekit import SamplerSpec, UsageError
from samplekit._registry import registry
from samplekit.testing import check


@pytest.fixture
def faulty(installed, monkeypatch):
    """The registry where the faulty plugins are installed."""
    monkeypatch.syspath_prepend(installed)
    registry.cache_clear()
    yield
    registry.cache_clear()


def test_the_report_has_what_the_command_prints():
    seen = []
    report = check(["jittered", "disk"], quick=True, only=["strata", "purity"], report=seen.append)
    assert [subject.name for subject in report.subjects] == ["jittered", "disk"]
    assert seen == report.subjects
    assert report.failed == []
    assert [(outcome.check, outcome.status) for outcome in report.outcomes] == [
        ("strata", "passed"),
        ("purity", "passed"),
        ("purity", "passed"),
    ]
    data = report.as_json()
    assert data["schema"] == "samplekit.check/1"
    assert data["conform"]
    assert data["subjects"][0]["checks"] == [outcome.as_json() for outcome in report.subjects[0].outcomes]
    assert "jittered: 2 passed" in report.page()


def test_a_failure_is_in_the_report(faulty):
    report = check(["not-latin", "jittered"], quick=True, only=["strata"])
    assert report.failed == ["not-latin"]
    assert report.outcomes[0].example.count == 2
    assert "1 of 2 conform" in report.summary
    assert "<svg" in report.page()


def test_a_declaration_is_checked_without_being_installed():
    spec = SamplerSpec("mine", "faulty_samplers:Plain", "mine")
    report = check(spec, quick=True, only=["seed", "light-import"])
    assert [(outcome.subject, outcome.status) for outcome in report.outcomes] == [
        ("mine", "passed"),
        ("mine", "not applicable"),
    ]


def test_a_name_that_a_sampler_and_a_scene_share_is_judged_as_both(faulty):
    report = check("twofold", quick=True, only=["purity"])
    assert [subject.name for subject in report.subjects] == ["sampler twofold", "scene twofold"]
    assert not report.failed
    # Only a sampler takes a randomizer.
    report = check("twofold+shift", quick=True, only=["seed"])
    assert [subject.name for subject in report.subjects] == ["twofold+shift"]


def test_names_are_judged_once_and_in_their_order():
    names = [subject.name for subject in check(["disk", "r2", "disk"], quick=True, only=["seed"]).subjects]
    assert names == ["disk", "r2"]


def test_several_are_judged_at_a_time():
    progress = []
    report = check(
        ["r2", "random"], quick=True, only=["seed"], jobs=2, progress=lambda done, total: progress.append((done, total))
    )
    assert [outcome.status for outcome in report.outcomes] == ["passed", "passed"]
    assert progress == [(1, 2), (2, 2)]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"names": ["r2", "sobool"]}, "did you mean sobol .*; and no scene has that name"),
        ({"names": ["r2", "disk:radius=far"]}, "radius"),
        ({"names": "r2", "only": ["prefixes"]}, "unknown check 'prefixes'"),
        ({"names": []}, "expected NAME"),
        ({"names": "r2", "jobs": 0}, "jobs 0"),
    ],
)
def test_wrong_requests_are_found_before_anything_is_judged(arguments, says):
    seen = []
    with pytest.raises(UsageError, match=says):
        check(**arguments, quick=True, report=seen.append)
    assert seen == []
