"""What samplekit writes opens in the programs that others have: oiiotool, idiff, the OpenEXR library, pandas."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenEXR
import pandas
import pytest

import samplekit
from samplekit._cli import run

pytestmark = pytest.mark.slow

BESIDE = Path(sys.executable).parent


def tool(name, *arguments):
    """Run a program of the OpenImageIO distribution."""
    path = shutil.which(name, path=str(BESIDE)) or shutil.which(name)
    assert path, f"{name} comes with OpenImageIO"
    return subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def rendering(tmp_path_factory):
    path = tmp_path_factory.mktemp("rendering") / "disk.exr"
    assert (
        run(["render", "--scene", "disk", "--sampler", "jittered", "--spp", "16", "--size", "48x40", "-o", str(path)])
        == 0
    )
    return path


@pytest.fixture(scope="module")
def result():
    return samplekit.render("disk", "jittered", 16, size=(48, 40))


def test_the_openexr_library_reads_every_part_to_the_last_bit(rendering, result):
    parts = {part.name(): part for part in OpenEXR.File(str(rendering)).parts}
    assert list(parts) == ["image", "reference", "error"]
    for name, part in parts.items():
        assert list(part.channels) == ["Y"]
        pixels = part.channels["Y"].pixels
        assert pixels.dtype == np.float32
        assert np.array_equal(pixels, getattr(result, name).astype(np.float32))
        assert "samplekit render --scene disk" in part.header["samplekit"]


def test_oiiotool_subtracts_the_parts(rendering, tmp_path):
    command = [rendering, "--subimage", 0, rendering, "--subimage", 1, "--sub", "-o", tmp_path / "difference.exr"]
    assert tool("oiiotool", *command).returncode == 0
    difference = OpenEXR.File(str(tmp_path / "difference.exr")).channels()["Y"].pixels
    error = OpenEXR.File(str(rendering)).parts[2].channels["Y"].pixels
    assert np.abs(difference - error).max() <= 2**-24


def test_idiff_tells_equal_images_from_others(rendering, tmp_path):
    other = tmp_path / "other.exr"
    assert (
        run(["render", "--scene", "disk", "--sampler", "random", "--spp", "16", "--size", "48x40", "-o", str(other)])
        == 0
    )
    assert tool("idiff", "-a", rendering, rendering).returncode == 0
    assert tool("idiff", "-a", rendering, other).returncode == 2


def test_pandas_reads_points(tmp_path):
    path = tmp_path / "points.csv"
    assert (
        run(
            [
                "points",
                "--sampler",
                "sobol+owen",
                "--count",
                "64",
                "--dims",
                "3",
                "--realizations",
                "2",
                "-o",
                str(path),
            ]
        )
        == 0
    )
    table = pandas.read_csv(path, comment="#")
    values = table.filter(regex=r"^x\d+$").to_numpy().reshape(2, 64, 3)
    # The default parser of some versions is off by a unit in the last place.
    assert np.abs(values - samplekit.points("sobol+owen", 64, 3, realizations=2)).max() <= 2**-53


def test_pandas_reads_a_radial_mean(tmp_path):
    command = ["spectrum", "--sampler", "jittered", "--count", "64", "--realizations", "20", "--max-frequency", "16"]
    assert run([*command, "-o", str(tmp_path / "s.exr")]) == 0
    table = pandas.read_csv(tmp_path / "s.radial.csv", comment="#")
    assert len(table) == 16
    assert np.isfinite(table.to_numpy(float)).all()


def test_columns_of_others_are_bare_numbers(tmp_path):
    expected = samplekit.points("halton", 50, 2)[0]
    for ending in ("plain.csv", "dat"):
        path = tmp_path / f"points.{ending}"
        assert run(["points", "--sampler", "halton", "--count", "50", "-o", str(path)]) == 0
        read = np.loadtxt(path, delimiter="," if ending == "plain.csv" else None)
        assert np.array_equal(read, expected)
