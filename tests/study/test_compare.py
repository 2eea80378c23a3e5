"""Whole studies by ``samplekit.compare``: known exponents, and the same errors however they are computed."""

import csv
import json
import signal
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

import samplekit
from samplekit._errors import UsageError
from samplekit.files._images.exr import read_parts

COURSE = {
    ("random", "disk"): -1.0,
    ("random", "gaussian"): -1.0,
    ("jittered", "disk"): -1.5,
    ("jittered", "gaussian"): -2.0,
}


def errors_alone(results):
    return [replace(row, times=None, time=None, efficiency=None, pictures=None) for row in results.rows]


@pytest.mark.slow
def test_exponents_of_the_course():
    found = samplekit.compare(
        ["random", "jittered", "poisson-disk"], ["disk", "gaussian"], [4**k for k in range(2, 6)], trials=1500,
        size=(1, 1), times=False,
    )  # fmt: skip
    slopes = {(fit.sampler, fit.scene): fit for fit in found.fits}
    for key, exponent in COURSE.items():
        tolerance = 0.05 if key[0] == "random" else 0.12
        assert slopes[key].theory == exponent
        assert slopes[key].slope.estimate == pytest.approx(exponent, abs=tolerance)
        assert key[0] != "random" or slopes[key].slope.low < exponent < slopes[key].slope.high
    # Poisson disks fall faster at few samples than in the limit, where their spectrum's plateau takes over.
    assert slopes["poisson-disk", "disk"].slope.estimate == pytest.approx(-1.2, abs=0.12)
    crossed = [c for c in found.crossings if set(c.samplers) == {"poisson-disk", "jittered"}]
    assert [c.scene for c in crossed] == ["disk", "gaussian"]
    for crossing in crossed:
        few, many = crossing.leads
        assert (few.sampler, many.sampler) == ("poisson-disk", "jittered")
        assert few.last <= 256 <= 4 * many.first


def test_exact_rows_and_those_below_the_reference_are_left_out_of_the_fit():
    found = samplekit.compare(["jittered", "random"], "step:offset=0.5", [4, 16, 64], trials=32, size=(1, 1))
    exact = [row for row in found.rows if row.sampler == "jittered"]
    assert all(row.mse.estimate == 0.0 and not row.fitted and "exact" in row.left_out for row in exact)
    assert all(row.efficiency is None for row in exact)
    assert [fit.sampler for fit in found.fits] == ["random"]
    narrow = "gaussian:sigma=0.05,cx=0.5,cy=0.5"
    smooth = samplekit.compare("regular+shift", narrow, [16, 64, 1024], trials=32, size=(1, 1), times=False)
    assert ["reference's own error" in row.left_out for row in smooth.rows] == [False, False, True]
    assert smooth.fits[0].counts == [16, 64]


def test_fit_over_a_range():
    found = samplekit.compare("random", "disk", [4, 16, 64], trials=50, size=(1, 1), times=False, fit=(16, 64))
    (fit,) = found.fits
    assert (fit.first, fit.last, fit.counts) == (16, 64, [16, 64])
    assert "range" in fit.left_out[4]


@pytest.mark.slow
def test_results_do_not_depend_on_threads_and_blocks():
    ask = {"trials": 40, "size": (24, 16), "seed": 9, "times": False}
    one = samplekit.compare(["random", "sobol+owen", "z-sobol"], ["disk", "zoneplate:k=60"], [4, 16], threads=1, **ask)
    two = samplekit.compare(["random", "sobol+owen", "z-sobol"], ["disk", "zoneplate:k=60"], [4, 16], threads=2, **ask)
    assert errors_alone(one) == errors_alone(two)
    assert one.fits == two.fits
    other = samplekit.compare("random", "disk", [4, 16], threads=1, **(ask | {"seed": 10}))
    assert other.rows[0].mse != one.rows[0].mse


def test_times_are_taken_apart_and_cost_is_added():
    found = samplekit.compare(
        ["random", "sobol+owen"], "gaussian", [16, 256], trials=32, size=(1, 1), cost=1000.0, budget=0.0
    )
    for row in found.rows:
        times = row.times
        assert times.laps >= times.rounds >= 6
        assert times.seconds.low <= times.seconds.estimate <= times.seconds.high
        assert times.points.cpu.lower <= times.points.cpu.median <= times.points.cpu.upper
        assert times.total.wall.median >= max(times.points.wall.median, times.scene.wall.median) > 0.0
        assert row.time.estimate == pytest.approx(times.seconds.estimate + row.count * 1e-6)
        assert times.total.cpu.lower / 2 <= times.seconds.estimate <= times.total.cpu.upper * 2
    assert found.front
    assert all(need.seconds.estimate for need in found.to_target if need.count.estimate)


def test_files_of_a_study(tmp_path):
    ask = (["random", "jittered"], ["disk", "zoneplate:k=40"], [4, 5])
    found = samplekit.compare(*ask, trials=3, size=(20, 12), seed=4, budget=0.0, output=tmp_path / "out")
    folder = tmp_path / "out"
    written = json.loads((folder / "results.json").read_text(encoding="utf-8"), parse_constant=pytest.fail)
    assert written == json.loads(json.dumps(found.as_json()))
    with (folder / "results.csv").open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    assert [(line["scene"], line["sampler"], int(line["count"])) for line in lines] == [
        (row.scene, row.sampler, row.count) for row in found.rows
    ]
    assert [float(line["mse"]) for line in lines] == [row.mse.estimate for row in found.rows]
    assert lines[2]["asked"] == "4 5"
    assert (folder / "report.html").stat().st_size > 1000
    assert sorted(path.suffix for path in folder.joinpath("plots").iterdir()) == [".png"] * 4 + [".svg"] * 4
    assert {str(path.relative_to(folder)) for path in folder.joinpath("plots").iterdir()} == set(found.plots)
    rendering = samplekit.render("disk", "random", 5, size=(20, 12), seed=4)
    pictures = found.rows[1].pictures
    image = read_parts(folder / pictures.exr)[0]["error"]
    assert np.array_equal(image, rendering.error.astype(np.float32))
    assert (folder / pictures.png).exists()
    assert (folder / pictures.error_png).exists()
    scales = {(row.scene, row.count): row.pictures.error_scale for row in found.rows}
    assert all(row.pictures.error_scale == scales[row.scene, row.count] for row in found.rows)


PROGRAM = """
import samplekit, sys
samplekit.compare(["random", "jittered", "sobol+owen"], ["disk", "gaussian"], [16, 250, 1000], trials=20_000,
                  size=(1, 1), times=False, output=sys.argv[1], resume=True, processes=int(sys.argv[2]))
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no kill -9 here")
def test_killed_study_goes_on_to_the_same_results(tmp_path):
    folder = tmp_path / "study"
    # Two processes, of which nothing is left when the first is killed.
    running = subprocess.Popen([sys.executable, "-c", PROGRAM, str(folder), "2"], stderr=subprocess.DEVNULL)
    log = folder / "study.sqlite-wal"
    until = time.monotonic() + 60
    while not (log.exists() and log.stat().st_size > 150_000) and running.poll() is None and time.monotonic() < until:
        time.sleep(0.002)
    running.send_signal(signal.SIGKILL)
    running.wait()
    assert not (folder / "results.json").exists()
    ask = (["random", "jittered", "sobol+owen"], ["disk", "gaussian"], [16, 250, 1000])
    with pytest.raises(UsageError, match="--resume"):
        samplekit.compare(*ask, trials=20_000, size=(1, 1), times=False, output=folder)
    began = []
    resumed = samplekit.compare(
        *ask, trials=20_000, size=(1, 1), times=False, output=folder, resume=True,
        progress=lambda what, _, total: began.append(total) if what == "computing errors" else None,
    )  # fmt: skip
    whole = samplekit.compare(*ask, trials=20_000, size=(1, 1), times=False)
    assert began[0] < 0.99 * 20_000 * 2 * 3 * 1266
    assert errors_alone(resumed) == errors_alone(whole)
    assert resumed.fits == whole.fits
    assert json.loads((folder / "results.json").read_text(encoding="utf-8"))["complete"] is True


def test_rows_that_somebody_took_out_of_the_file_are_computed_anew(tmp_path):
    """Those of a smaller count as well, whose larger ones from the same draw are there."""
    ask = (["random"], ["disk"], [1, 4, 16])
    whole = samplekit.compare(*ask, trials=64, size=(1, 1), times=False, output=tmp_path)
    with sqlite3.connect(tmp_path / "study.sqlite") as database:
        database.execute("DELETE FROM sums WHERE count = 4")
    database.close()
    resumed = samplekit.compare(*ask, trials=64, size=(1, 1), times=False, output=tmp_path, resume=True)
    assert resumed.complete
    assert errors_alone(resumed) == errors_alone(whole)


@pytest.mark.slow
def test_the_unit_square_is_studied_with_fresh_sets():
    found = samplekit.compare(["lloyd:steps=2", "random"], "disk", 16, trials=4, size=(1, 1), times=False)
    assert found.samplers == ["lloyd:steps=2,bank=0", "random"]
    assert [row.sampler for row in found.rows] == found.samplers
    found = samplekit.compare("lloyd:steps=2", "disk", 16, trials=4, size=(4, 4), times=False)
    assert found.samplers == ["lloyd:steps=2"]
