"""``samplekit stability``: tables, files and exit status."""

import csv

import pytest

from samplekit.files._images.png import read_png


def test_the_command_prints_a_table_and_what_the_words_mean(command):
    done = command("stability", "--scene", "gaussian", "--sampler", "random", "--count", "16,64", "--realizations", "8")
    assert done.status == 0
    assert "gaussian, random" in done.out
    assert "sigma=1e-12" in done.out
    assert "no hits: all samples, or all estimates, are equal" in done.out
    assert "16 cells" in done.out


def test_the_command_writes_heat_maps_and_all_numbers(command, tmp_path):
    arguments = [
        "--scene",
        "offset",
        "--scene",
        "power:a=0.9",
        "-s",
        "random",
        "-s",
        "sobol",
        "-n",
        "16",
        "--seed",
        "3",
    ]
    done = command("stability", *arguments, "--realizations", "4", "--output", tmp_path, "--json")
    assert done.status == 0
    report = done.report
    assert report["schema"] == "samplekit.stability/1"
    assert len(report["cells"]) == 12
    assert sum(report["verdicts"].values()) == 12
    assert report["verdicts"]["invalid"] == 1
    assert {path.name for path in tmp_path.iterdir()} == {"stability.csv", "offset.png", "power.png"}
    rows = list(csv.DictReader((tmp_path / "stability.csv").read_text(encoding="utf-8").splitlines()))
    assert [float(row["estimate"]) for row in rows if row["estimate"]] == [
        cell["estimate"] for cell in report["cells"] if cell["estimate"] is not None
    ]
    pixels, facts = read_png(tmp_path / "power.png")
    assert pixels.shape[0] > 150
    assert facts["cells"] == [cell for cell in report["cells"] if cell["scene"].startswith("power")]
    # The cell that is not finite has the reserved colour.
    assert (pixels == (255, 0, 255)).all(axis=2).any()


@pytest.mark.parametrize(
    "arguments",
    [
        ["--scene", "nothing"],
        ["--sampler", "nothing"],
        ["--count", "0"],
        ["--realizations", "-1"],
        ["--seed", "x"],
        ["--output", "nowhere"],
        ["--scene", "gaussian:sigma=0"],
    ],
)
def test_wrong_use_ends_in_one_line(command, tmp_path, arguments):
    done = command("stability", *arguments)
    assert done.status == 2
    assert done.error
    assert not list(tmp_path.iterdir())
