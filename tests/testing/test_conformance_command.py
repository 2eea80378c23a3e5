"""``samplekit check`` as a user runs it: statuses, streams, pages, wrong names; plugins that misbehave are named."""

import json
import re

import pytest

from samplekit._cli import run

QUICK = ("--quick", "--only", "strata", "--only", "seed")


def lines_of(result):
    assert result.stderr == ""
    return {line.split()[0]: line for line in result.stdout.splitlines() if line.startswith("  ")}


def test_a_sampler_that_conforms(capsys):
    assert run(["check", "jittered", *QUICK]) == 0
    out = capsys.readouterr().out
    assert "jittered: 2 passed" in out
    assert "1 of 1 conform" in out
    assert "probability at most 1.6e-05" in out


def test_json_is_one_object(capsys):
    assert run(["check", "sobol", "disk", "--quick", "--only", "strata", "--only", "purity", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["schema"] == "samplekit.check/1"
    assert report["conform"]
    assert [subject["name"] for subject in report["subjects"]] == ["sobol", "disk"]
    strata, purity = report["subjects"][0]["checks"]
    assert (strata["status"], strata["message"]) == ("not applicable", "it promises no strata")
    assert purity["points"] > 0


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["sobool"], "did you mean sobol"),
        ([], "expected NAME..., or --all"),
        (["sobol", "--only", "prefixes"], "unknown check 'prefixes'"),
        (["sobol:seed=3"], "has no option 'seed'"),
        (["sobol", "--html", "no/such/folder/page.html"], "there is no folder"),
    ],
)
def test_wrong_use_is_one_line(arguments, says, capsys):
    assert run(["check", *arguments]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1


def width_of(name, text):
    """Width of the path of an element of the picture, in points."""
    path = re.search(rf'<g id="{name}">\s*<path d="([^"]*)"', text)[1]
    across = [float(number) for number in re.findall(r"[ML] ([\d.]+) ", path)]
    return max(across) - min(across)


def test_a_broken_promise_is_status_3_with_a_page(samplekit_here, tmp_path):
    page = tmp_path / "page.html"
    result = samplekit_here("check", "not-latin", *QUICK, "--html", str(page))
    assert result.returncode == 3
    strata = lines_of(result)["strata"]
    assert "failed" in strata
    assert "[0/2, 1/2) of dimension 0 holds 2 points, expected 1" in strata
    assert re.search(r"sampler not-latin, count 2, dims 1, seed 0, realisation \d+: point 0 at \(", strata)
    text = page.read_text()
    assert "<svg" in text
    # The cell [0, 1/2), shaded.
    assert width_of("cell", text) == pytest.approx(width_of("patch_2", text) / 2, rel=1e-3)
    assert "holds 2 points" in text


def test_expected_failures_are_strict(samplekit_here):
    result = samplekit_here("check", "known", "pessimist", "--quick", "--only", "strata", "--only", "range")
    assert result.returncode == 3
    assert "expected failure  a first try (" in result.stdout
    assert "unexpected pass   declared to fail (might reach 1), but it passed" in result.stdout
    assert "1 of 2 conform" in result.stdout
    result = samplekit_here("check", "misspelt", "--quick")
    assert result.returncode == 2
    assert "unknown check 'rnage': did you mean range?" in result.stderr


def test_heavy_declarations_are_found(samplekit_here):
    result = samplekit_here("check", "heavy", "--quick", "--only", "light-import")
    assert result.returncode == 3
    assert "listing the names of plugin heavy imports numpy" in result.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("hangs", "hangs: no answer in 4 s during shape"),
        ("crashes", "crashes the interpreter"),
        ("exits", "ends the interpreter (status 7) during shape"),
        ("eats-memory", "takes more than 0.5 GiB of memory during shape"),
    ],
)
def test_what_misbehaves_is_named_when_isolated(name, says, samplekit_here):
    limits = ("--time-limit", "4" if name == "hangs" else "60", "--memory-limit", "0.5")
    # After an end another process goes on with what is left: once is enough to see it.
    more = ("--only", "seed") if name == "crashes" else ()
    arguments = (name, "--quick", "--only", "shape", *more, "--isolated", *limits)
    result = samplekit_here("check", *arguments)
    assert result.returncode == 3
    lines = lines_of(result)
    assert says in lines["shape"]
    assert not more or "passed" in lines["seed"]


def test_printing_past_python_is_found_when_isolated(samplekit_here):
    result = samplekit_here("check", "prints", "--quick", "--only", "purity", "--isolated", "--json")
    assert result.returncode == 3
    outcome = json.loads(result.stdout)["subjects"][0]["checks"][0]
    assert outcome["message"].startswith("prints to standard output: 'drawing")
