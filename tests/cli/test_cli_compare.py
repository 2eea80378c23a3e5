"""``samplekit compare`` as a command: its streams, its refusals, and what an interrupt leaves."""

import json

import pytest

from samplekit._study import study
from samplekit._study.results import SCHEMA

ASK = ("compare", "-s", "random", "-s", "jittered", "--scene", "disk", "--spp", "4,13")
ASK += ("--trials", "32", "--size", "1", "--budget", "0")


def test_table(command):
    done = command(*ASK, "--no-time", "--threads", "1")
    assert done.status == 0
    lines = done.out.splitlines()
    assert lines[0] == "the unit square, 32 trials, seed 0, 95 % intervals"
    assert any(line.startswith("jittered         12") and "not 13" in line for line in lines)
    assert any("theory -1 (worst case)" in line for line in lines)
    assert done.err == ""


def test_json_and_files(command, tmp_path):
    done = command(*ASK, "--output", "out", "--json")
    assert done.status == 0
    assert done.report["schema"] == SCHEMA
    assert done.report == json.loads((tmp_path / "out" / "results.json").read_text(encoding="utf-8"))
    assert done.report["command"].startswith(
        "samplekit compare --scene disk --sampler random --sampler jittered --spp 4,13"
    )
    again = command(*ASK, "--output", "out")
    assert (again.status, "--resume" in again.error) == (2, True)
    resumed = command(*ASK, "--output", "out", "--resume", "--json")
    assert resumed.report["fits"] == done.report["fits"]
    other = command(*ASK, "--seed", "1", "--output", "out", "--resume")
    assert (other.status, "seed 0, not 1" in other.error) == (2, True)


def test_interrupt_leaves_what_is_there(command, tmp_path, monkeypatch):
    carried_out = study.carry_out
    jobs = []

    def interrupted(job, *arguments):
        if len(jobs) == 2:
            raise KeyboardInterrupt
        jobs.append(job)
        return carried_out(job, *arguments)

    monkeypatch.setattr(study, "carry_out", interrupted)
    done = command(*ASK, "--no-time", "--threads", "1", "--output", "out")
    assert done.status == 130
    assert "interrupted: this is what was done" in done.err
    assert "left out: disk, " in done.err
    assert not json.loads((tmp_path / "out" / "results.json").read_text(encoding="utf-8"))["complete"]
    assert (tmp_path / "out" / "report.html").exists()
    monkeypatch.setattr(study, "carry_out", carried_out)
    resumed = command(*ASK, "--no-time", "--output", "out", "--resume", "--json")
    assert (resumed.status, resumed.report["complete"], len(resumed.report["rows"])) == (0, True, 4)


def test_interrupt_before_anything_is_done(command, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(study, "carry_out", interrupted)
    done = command(*ASK, "--no-time", "--threads", "1", "--output", "out", "--json")
    assert (done.status, done.report["rows"]) == (130, [])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("-s", "rndom", "--scene", "disk", "--spp", "4"), "random"),
        (("-s", "random", "--scene", "disc", "--spp", "4"), "disk"),
        (("-s", "random", "--scene", "disk", "--spp", "4,"), "expected a positive integer"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--trials", "0"), "trials 0: expected a positive integer"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--cost", "-1"), "cost -1"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--budget", "much"), "budget much: expected seconds"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--target", "0"), "above 0"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--fit", "16"), "expected FIRST..LAST"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--resume"), "--resume needs --output"),
        (("-s", "random", "--scene", "disk", "--spp", "4", "--output", "no/where"), "does not exist"),
        (("-s", "random", "--scene", "disk", "--scene", "disk", "--spp", "4"), "given twice"),
        (("-s", "van-der-corput", "--scene", "disk", "--spp", "4"), "1 dimension"),
        (("--scene", "disk", "--spp", "4"), "--sampler"),
        (("-s", "random", "--spp", "4"), "--scene"),
    ],
)
def test_wrong_use_ends_in_one_line(command, tmp_path, arguments, message):
    done = command("compare", *arguments)
    assert (done.status, done.out) == (2, "")
    assert message in done.error
    assert list(tmp_path.iterdir()) == []


def test_folder_of_somebody_else(command, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("precious")
    done = command(*ASK, "--output", "mine")
    assert (done.status, "thesis.tex" in done.error) == (2, True)
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["thesis.tex"]


def test_trial_without_others_has_no_interval(command):
    done = command(
        "compare", "-s", "random", "--scene", "disk", "--spp", "4", "--trials", "1", "--size", "8", "--no-time"
    )
    assert done.status == 0
    assert "few trials" in done.out
    assert "1 trial, seed 0" in done.out
