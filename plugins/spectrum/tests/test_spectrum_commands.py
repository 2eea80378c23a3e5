"""The commands: files, tables, JSON, exit statuses; nothing half-written."""

import csv
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from samplekit_spectrum import power

from samplekit._cli import run
from samplekit.files import read_parts, read_png


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def spectrum(capsys, *arguments):
    status = run(["spectrum", *arguments, "--json"])
    captured = capsys.readouterr()
    return status, json.loads(captured.out), captured.err


def test_the_files_hold_the_raw_power(here, capsys):
    status, report, _ = spectrum(capsys, "-s", "jittered", "-n", "2^6", "-r", "20", "-f", "16", "--seed", "3")
    assert status == 0
    stem = "spectrum-jittered-64"
    assert sorted(path.name for path in here.iterdir()) == sorted(
        stem + ending for ending in (".exr", ".png", ".radial.csv", ".radial.png", ".radial.svg")
    )
    wanted = power("jittered", 64, realizations=20, max_frequency=16, seed=3)
    contents = read_parts(here / f"{stem}.exr")
    assert np.array_equal(contents.parts["mean"], wanted.mean.astype(np.float32))
    assert np.array_equal(contents.parts["standard-error"], wanted.standard_error.astype(np.float32))
    assert contents.parts["mean"][16, 16] == 1.0
    assert contents.metadata["command"].startswith("samplekit spectrum --sampler jittered --count 64 --realizations 20")
    assert contents.metadata["interrupted"] is False
    _, metadata = read_png(here / f"{stem}.png")
    assert metadata["picture"]["scale"] == 2.0
    rows = list(csv.DictReader((here / f"{stem}.radial.csv").read_text().splitlines()))
    assert [float(row["power"]) for row in rows] == wanted.radial.power.tolist()
    ElementTree.parse(here / f"{stem}.radial.svg")
    assert report["schema"] == "samplekit.spectrum/1"
    assert contents.metadata["quantity"].startswith(report["quantity"])
    assert report["quantity"] == "E|S(m)|^2 with S(m) = (1/N) sum exp(-2 pi i m.x)"
    assert report["spectra"][0]["radial"]["power"] == wanted.radial.power.tolist()
    assert report["spectra"][0]["bias"]["verdict"] == "none found"
    assert report["spectra"][0]["dc"] == 1.0


def test_the_same_command_gives_the_same_bytes(here, capsys):
    def contents(threads):
        assert run(["spectrum", "-s", "random", "-n", "64", "-r", "150", "-f", "12", "--threads", threads]) == 0
        capsys.readouterr()
        return {path.name: path.read_bytes() for path in here.iterdir()}

    assert contents("1") == contents("2")


@pytest.mark.slow
def test_all_projections_and_three_dimensions(here, capsys):
    status, report, _ = spectrum(
        capsys, "-s", "sobol+owen", "-n", "16", "-r", "4", "-f", "8", "--dims", "4", "--project", "all"
    )
    assert status == 0
    assert [one["project"] for one in report["spectra"]] == [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]]
    assert set(read_parts(here / "spectrum-sobol+owen-16.exr").parts) >= {"mean.0-1", "standard-error.2-3"}
    assert spectrum(capsys, "-s", "random", "-n", "27", "-r", "4", "-f", "4", "--dims", "3")[0] == 0
    parts = read_parts(here / "spectrum-random-27.exr").parts
    assert len(parts) == 10
    assert parts["mean.slice0"][4, 4] == 1.0
    assert spectrum(capsys, "-s", "van-der-corput", "-n", "27", "-f", "40", "--dims", "1")[0] == 0
    assert not (here / "spectrum-van-der-corput-27.png").exists()


def test_listed_frequencies(here, capsys):
    status, report, _ = spectrum(capsys, "-s", "jittered", "-n", "16", "-r", "32", "--frequencies", "0.5,1;2^40,-3")
    assert status == 0
    assert report["spectra"][0]["frequencies"] == [[0.5, 1.0], [2.0**40, -3.0]]
    assert (here / "spectrum-jittered-16.csv").read_text().startswith("m0,m1,power,standard_error\n")


def test_tables(here, capsys):
    assert run(["spectrum", "-s", "regular", "-n", "16", "-f", "8"]) == 0
    shown = capsys.readouterr().out
    assert "one set: it is not random" in shown
    assert re.search(r"bias +biased", shown)
    assert run(["predict", "-s", "jittered", "--scene", "disk", "-n", "4,16", "--trials", "500", "-r", "50"]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert len(shown) == 4
    assert "native" in shown[1]


def test_what_one_realization_does_not_tell_is_left_out(here, capsys):
    for more in (["-f", "8"], ["--frequencies", "1,0;0,1"]):
        assert run(["spectrum", "-s", "jittered", "-n", "16", "-r", "1", *more, "--output", "one.exr"]) == 0
        out = capsys.readouterr().out
        assert "1 realization, " in out
        assert not {"nan", "inf"} & set(out.replace("dB", "").split())
        for path in here.glob("one*.csv"):
            assert "nan" not in path.read_text()
            assert "inf" not in path.read_text()


def test_of_two_zeros_there_is_no_ratio(here, capsys):
    assert run(["predict", "-s", "sobol+xor", "--scene", "step", "-n", "16", "--trials", "100"]) == 0
    row = capsys.readouterr().out.splitlines()[-1].split()
    assert row[2:5] == ["-", "-", "-"]
    assert row[6:8] == ["-", "-"]
    assert row[-1] == "exact"


def test_prediction_as_json(here, capsys):
    assert (
        run(["predict", "-s", "random", "--scene", "step", "-n", "4^1..4^2", "--trials", "500", "-r", "50", "--json"])
        == 0
    )
    report = json.loads(capsys.readouterr().out)
    assert report["schema"] == "samplekit.prediction/1"
    assert [row["count"] for row in report["rows"]] == [4, 16]
    assert report["rows"][0]["native"] is None
    assert report["integrand"]["variance"] == 0.25


def test_the_error_of_a_rendering(here, capsys):
    assert run(["render", "-s", "random", "-n", "4", "--scene", "zoneplate:k=40", "--size", "48", "--json"]) == 0
    (name,) = [path for path in here.iterdir() if path.suffix == ".exr"]
    capsys.readouterr()
    status, report, _ = spectrum(capsys, "--image", name.name)
    assert (status, report["verdict"]) == (0, "white")
    assert (here / f"spectrum-{name.stem}.radial.svg").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        [], ["-s", "random"], ["-n", "4"], ["-s", "randm", "-n", "4"], ["-s", "random", "-n", "0"],
        ["-s", "random", "-n", "4", "-f", "0"], ["-s", "random", "-n", "4", "-r", "x"], ["-s", "jittered", "-n", "7"],
        ["-s", "random", "-n", "4", "--project", "0;1"], ["-s", "random", "-n", "4", "--dims", "5"],
        ["-s", "random", "-n", "4", "--frequencies", "a,b"], ["-s", "random", "-n", "4", "--step", "nan"],
        ["-s", "random", "-n", "4", "-o", "missing/x.exr"], ["-s", "random", "-n", "4", "-o", "x.png"],
        ["--image", "missing.exr"], ["--image", "missing.exr", "-s", "random"],
        ["-s", "random", "-n", "4", "--seed", "-1"],
        ["-s", "random", "-n", "4", "--scale", "0"], ["-s", "random", "-n", "4", "--project", "all", "--dims", "99"],
    ],
)  # fmt: skip
def test_wrong_use_has_status_2_one_line_and_no_files(arguments, here, capsys):
    assert run(["spectrum", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert list(here.iterdir()) == []


def test_an_interrupt_writes_what_is_done_if_an_output_was_given(here, capsys, monkeypatch):
    from samplekit.commands import Progress

    def interrupt(self, done, total):
        if done >= 100:
            raise KeyboardInterrupt

    monkeypatch.setattr(Progress, "__call__", interrupt)
    arguments = ["spectrum", "-s", "random", "-n", "64", "-r", "10^6", "-f", "16"]
    assert run(arguments) == 130
    assert list(here.iterdir()) == []
    assert run([*arguments, "--output", "kept.exr"]) == 130
    metadata = read_parts(here / "kept.exr").metadata
    assert metadata["interrupted"] is True
    assert 100 <= metadata["realizations"] < metadata["requested"] == 10**6
    assert "are kept" in capsys.readouterr().err


def test_declaring_imports_no_numpy():
    code = "import sys, samplekit_spectrum; assert 'numpy' not in sys.modules and 'ducc0' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("command", ["spectrum", "predict"])
def test_without_the_plugin_the_command_says_where_it_is(command):
    """In another process: the registry of this one has it already."""
    code = f"from samplekit._cli import run; raise SystemExit(run(['{command}']))"
    environment = {**os.environ, "SAMPLEKIT_PLUGINS": ""}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 2
    assert "samplekit-spectrum" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_notebook_shows_it():
    for dims in (1, 2, 3):
        spectrum = power("random", 16, realizations=2, max_frequency=8, dims=dims)
        assert spectrum._repr_png_().startswith(b"\x89PNG")
        assert spectrum._repr_html_() is None
    listed = power("jittered", 16, realizations=2, frequencies=[[1.0, 2.0], [2.0**40, 0.5]])
    assert listed._repr_png_() is None
    table = ElementTree.fromstring(listed._repr_html_())
    cells = [[float(cell.text) for cell in row] for row in table[1:]]
    assert [row[:2] for row in cells] == [[1.0, 2.0], [pytest.approx(2.0**40), 0.5]]
    assert cells[0][2] == pytest.approx(listed.mean[0], rel=1e-9)
