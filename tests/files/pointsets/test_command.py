import json
import subprocess
import sys

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import samplekit
from samplekit._cli.points import points
from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images.png import read_png


def run(*arguments, wrong=None):
    app = typer.Typer()
    app.command()(points)
    result = CliRunner().invoke(app, [*map(str, arguments)])
    if wrong is None:
        assert result.exception is None, result.exception
        return result.stdout
    assert isinstance(result.exception, wrong), result.output
    return str(result.exception)


def test_points_go_to_standard_output_as_csv():
    lines = run("--sampler", "hammersley", "--count", "2^2").splitlines()
    assert lines == ["realisation,index,x0,x1", "0,0,0.0,0.0", "0,1,0.25,0.5", "0,2,0.5,0.25", "0,3,0.75,0.75"]


def test_json_holds_every_bit():
    arguments = ["--sampler", "random", "--count", 8, "--dims", 3, "--realizations", 2, "--seed", 2**64 - 1]
    report = json.loads(run(*arguments, "--json"))
    expected = samplekit.points("random", count=8, dims=3, realizations=2, seed=2**64 - 1)
    assert np.array_equal(np.array(report.pop("points")), expected)
    assert report == {
        "schema": "samplekit.points/1",
        "sampler": "random",
        "count": 8,
        "dims": 3,
        "realizations": 2,
        "seed": 2**64 - 1,
        "files": [],
    }


def test_a_file_is_named_and_its_points_are_not_repeated(tmp_path):
    path = tmp_path / "points.npy"
    report = json.loads(run("--sampler", "jittered", "--count", 96, "--output", path, "--json"))
    assert report["files"] == [str(path)]
    assert "points" not in report
    assert np.array_equal(np.load(path), samplekit.points("jittered", count=96))
    assert run("--sampler", "jittered", "--count", 96, "--output", path).strip() == str(path)


@pytest.mark.parametrize(
    ("ending", "begins"), [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF"), ("PDF", b"%PDF")]
)
def test_the_ending_chooses_the_kind_of_picture(tmp_path, ending, begins):
    path = tmp_path / f"points.{ending}"
    assert run("--sampler", "jittered", "--count", 96, "--output", path).strip() == str(path)
    written = path.read_bytes()
    assert written.startswith(begins)
    run("--sampler", "jittered", "--count", 96, "--output", path)
    assert path.read_bytes() == written


def test_a_picture_says_how_to_make_it_again(tmp_path):
    path = tmp_path / "points.png"
    run("--sampler", "sobol+owen", "--count", 16, "--seed", 5, "--output", path)
    metadata = read_png(path)[1]
    assert metadata["command"] == "samplekit points --sampler sobol+owen --count 16 --dims 2 --seed 5"
    assert metadata["seed"] == "5"
    assert metadata["versions"]["samplekit"] == samplekit.__version__


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--count", "0"], "count 0"),
        (["--count", "4", "--dims", "0"], "dims 0"),
        (["--count", "4", "--realizations", "0"], "realizations 0"),
        (["--count", "4", "--seed", "-1"], "seed -1"),
        (["--count", "97"], "nearest"),
        (["--count", "96", "--output", "a.jpg"], ".dat, .bin, .svg, .png or .pdf"),
        (["--count", "96", "--output", "a.svg", "--realizations", "2"], "one realisation"),
        (["--count", "1", "--output", "a.svg", "--dims", "17"], "at most 16"),
        (["--count", "1", "--output", "a.pdf", "--dims", "17"], "at most 16"),
    ],
)
def test_wrong_use_says_what_would_be_right(tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    assert message in run("--sampler", "jittered", *arguments, wrong=UsageError)
    assert not list(tmp_path.iterdir())


def test_more_points_than_memory_is_a_clear_line():
    assert "GiB" in run("--sampler", "random", "--count", "2^50", wrong=SamplekitError)


def test_the_command_line_imports_nothing_heavy():
    code = "import sys, samplekit._cli.points; print(sorted({'numpy', 'numba', 'OpenImageIO'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
