"""Values that are not finite, through every command: counted, shown, with an exit status of their own, never in JSON.

Unscrambled Sobol points begin at the origin, where a power is infinite.
"""

import numpy as np
import pytest

import samplekit
from samplekit.files._images.exr import read_parts
from samplekit.files._images.png import RESERVED, read_png

INFINITE = ("--scene", "power", "--sampler", "sobol")


def test_a_rendering_counts_and_shows_them(command, tmp_path):
    done = command("render", *INFINITE, "--spp", "4", "--size", "4", "--json", "--explain")
    assert done.status == 1
    assert done.report["invalid_samples"] == done.report["invalid_pixels"] == 4
    assert np.isfinite(done.report["mse"])
    assert "magenta" in done.err
    pixels, _ = read_png(tmp_path / "power-sobol-4spp.png")
    assert ((pixels == RESERVED).all(axis=2) == (np.arange(4) == 0)).all()
    parts = read_parts(tmp_path / "power-sobol-4spp.exr").parts
    assert np.isinf(np.asarray(parts["image"])).sum() == 4
    assert np.isfinite(np.asarray(parts["reference"])).all()


def test_a_sweep_counts_them(command):
    done = command("stability", *INFINITE, "--count", "4", "--realizations", "2", "--json")
    assert done.report["verdicts"]["invalid"] > 0
    assert {cell["estimate"] for cell in done.report["cells"] if cell["verdict"] == "invalid"} == {None}


def test_a_study_leaves_them_out_and_says_so(command):
    done = command("compare", *INFINITE, "--spp", "4", "--trials", "4", "--size", "1", "--no-time", "--json")
    assert done.status == 1
    assert done.report["rows"][0]["mse"]["estimate"] is None
    assert "not finite" in done.err


@pytest.mark.slow
def test_a_prediction_is_refused(command):
    done = command("predict", *INFINITE, "--count", "16", "--json")
    assert done.status == 1
    assert "not finite" in done.error
    assert done.report["error"] == done.error


def test_an_estimate_is_what_it_is():
    assert samplekit.estimate("power", "sobol", 16)[0] == np.inf


@pytest.mark.parametrize("peak", ["1e200", "1e290"])
def test_values_whose_squares_overflow_have_finite_estimates(command, tmp_path, peak):
    scene = f"spike:peak={peak},area=1e-2"
    rendering = samplekit.render(scene, "random", 64, size=(8, 8))
    assert np.isfinite(rendering.image).all()
    assert rendering.metrics["mse"] == np.inf
    assert 1e190 < rendering.metrics["rmse"] < np.inf
    done = command("stability", "--scene", scene, "-s", "random", "-n", "4096", "--json")
    assert done.report["verdicts"]["right"] == 1
    assert done.report["cells"][0]["standard_error"] > 1e190
    # A picture of them is refused: float32 has no such numbers.
    done = command("render", "--scene", scene, "-s", "random", "-n", "64", "--size", "8")
    assert done.status == 1
    assert "beyond float32" in done.error
    assert not list(tmp_path.iterdir())
