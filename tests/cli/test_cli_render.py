"""``samplekit render``: its files, what it prints where, and how it ends."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import samplekit
from samplekit._cli import run
from samplekit._integrate import rendering
from samplekit.files._images.exr import read_parts
from samplekit.files._images.png import read_png
from samplekit.files._images.reading import read_info

SMALL = ("--sampler", "hammersley", "--spp", "4", "--size", "8")
CONTRACT = ["mse", "rmse", "mae", "max_error", "bias", "psnr", "samples", "dims", "pixels_sampled", "pixels_left_out"]
SECONDS = {"points", "scene", "reference", "total"}


def names(folder):
    return sorted(path.name for path in Path(folder).iterdir())


def three(stem):
    return sorted([f"{stem}.exr", f"{stem}.png", f"{stem}.error.png"])


def contents(folder):
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def test_with_nothing_else_it_renders_the_zone_plate_here(command, tmp_path):
    done = command("render", "--sampler", "hammersley", "--spp", "16")
    assert done.status == 0
    assert done.err == ""
    assert names(tmp_path) == three("zoneplate-hammersley-16spp")
    assert "zoneplate, hammersley, 16 spp, 512x512, seed 0" in done.out
    for name in (*CONTRACT, *names(tmp_path)):
        assert name in done.out
    parts = read_parts(tmp_path / "zoneplate-hammersley-16spp.exr").parts
    assert {name: values.shape for name, values in parts.items()} == dict.fromkeys(parts, (512, 512))
    assert list(parts) == ["image", "reference", "error"]


def test_json_is_one_object_with_the_names_of_the_contract(command, tmp_path):
    done = command("render", *SMALL, "--scene", "disk", "--seed", str(2**64 - 1), "--json")
    assert done.status == 0
    assert done.err == ""
    report = done.report
    assert set(CONTRACT) | {"schema", "seconds", "files"} <= set(report)
    assert set(report["seconds"]) >= SECONDS
    assert report["files"] == ["disk-hammersley-4spp.exr", "disk-hammersley-4spp.png", "disk-hammersley-4spp.error.png"]
    assert names(tmp_path) == sorted(report["files"])
    expected = samplekit.render("disk", "hammersley", 4, size=(8, 8), seed=2**64 - 1).metrics
    assert {name: report[name] for name in CONTRACT} == {name: expected[name] for name in CONTRACT}
    assert report["seed"] == 2**64 - 1
    assert (report["scene"], report["sampler"], report["spp"], report["size"]) == ("disk", "hammersley", 4, [8, 8])


def test_what_json_cannot_hold_is_null(command):
    report = command("render", *SMALL, "--scene", "disk:radius=0", "--json").report
    assert report["psnr"] is None
    assert report["mse"] == 0
    assert report["samples"] == report["pixels_sampled"] == 0


def test_the_files_hold_the_image_that_python_gives(command, tmp_path):
    arguments = ("--scene", "gaussian:sigma=0.2", "--sampler", "sobol+owen", "--spp", "8", "--size", "20x12")
    assert command("render", *arguments, "--seed", "3", "--output", "a.exr").status == 0
    expected = samplekit.render("gaussian:sigma=0.2", "sobol+owen", 8, size=(20, 12), seed=3)
    parts, metadata, window = read_parts(tmp_path / "a.exr")
    for name in ("image", "reference", "error"):
        assert np.array_equal(parts[name], getattr(expected, name).astype(np.float32))
    assert window == (0, 0, 20, 12)
    assert metadata["metrics"]["mse"] == expected.metrics["mse"]
    assert metadata["seed"] == "3"
    assert read_png(tmp_path / "a.png")[0].shape[:2] == (12, 20)
    for name in ("a.png", "a.error.png"):
        assert read_info(tmp_path / name)["metadata"]["command"] == metadata["command"]


def test_the_same_command_writes_the_same_bytes(command, tmp_path, monkeypatch):
    written = []
    for folder, threads in (("a", "1"), ("b", "3")):
        (tmp_path / folder).mkdir()
        monkeypatch.chdir(tmp_path / folder)
        arguments = ("--sampler", "jittered", "--scene", "disk", "--spp", "6", "--size", "40", "--ssim", "--flip")
        assert command("render", *arguments, "--threads", threads).status == 0
        written.append(contents("."))
    assert len(written[0]) == 3
    assert written[0] == written[1]


def test_the_command_in_the_file_makes_the_file_again(command, tmp_path):
    arguments = ("--scene", "disk:radius=0.25,cx=0.5", "--sampler", "random", "--spp", "3", "--size", "30x20")
    assert command("render", *arguments, "--crop", "3,4,20,10", "--seed", "7", "--full", "-o", "a.exr").status == 0
    first = contents(tmp_path)
    program, name, *again = shlex.split(read_info(tmp_path / "a.exr")["metadata"]["command"])
    assert (program, name) == ("samplekit", "render")
    assert command("render", *again, "--output", "a.exr").status == 0
    assert contents(tmp_path) == first


def test_the_command_in_the_file_has_its_metrics_plugins_and_quotes(command, plugins, tmp_path):
    for name in ("blocks", "cars"):
        plugins.offer(name, "sampler", 'SamplerSpec("toy", "toy_points:Toy", "", options=(Option("text", ""),))')
    plugins.module(
        "toy_points",
        """
        from samplekit import Sampler

        class Toy(Sampler):
            def __init__(self, text):
                self.seed = len(text)

            def draw(self, count, dims, rng):
                return rng.random((count + self.seed, dims))[self.seed :]
        """,
    )
    arguments = ("--sampler", "cars/toy:text=a 'b' $c", "--spp", "4", "--size", "8", "--ssim", "--flip")
    assert command("render", *arguments, "-o", "a.exr").status == 0
    first = contents(tmp_path)
    again = shlex.split(read_info(tmp_path / "a.exr")["metadata"]["command"])
    assert command(*again[1:], "--output", "a.exr").status == 0
    assert contents(tmp_path) == first
    assert {"cars/toy:text=a 'b' $c", "--ssim", "--flip"} <= set(again)


def test_an_error_picture_that_is_left_from_before_is_told(command, tmp_path):
    assert command("render", *SMALL, "-o", "a.exr").err == ""
    done = command("render", *SMALL, "-o", "a.exr", "--no-error")
    assert done.status == 0
    assert done.error == "a.error.png is of an earlier rendering: this one has no error (--no-error)"
    assert (tmp_path / "a.error.png").exists()


def test_without_error_there_is_neither_reference_nor_metric(command, tmp_path):
    report = command("render", *SMALL, "--no-error", "--json").report
    assert report["files"] == ["zoneplate-hammersley-4spp.exr", "zoneplate-hammersley-4spp.png"] == names(tmp_path)
    assert list(read_parts(tmp_path / report["files"][0]).parts) == ["image"]
    assert not {"mse", "psnr", "bias", "ssim"} & set(report)
    assert report["samples"] == 256


def test_a_crop_has_the_pixels_and_knows_its_place(command, tmp_path):
    arguments = ("--sampler", "random", "--spp", "2", "--size", "30x20")
    command("render", *arguments, "-o", "whole.exr")
    report = command("render", *arguments, "--crop", "5,6,10,3", "-o", "part.exr", "--json").report
    assert report["window"] == [5, 6, 10, 3]
    whole, part = read_parts(tmp_path / "whole.exr"), read_parts(tmp_path / "part.exr")
    assert part.window == (5, 6, 30, 20)
    for name in ("image", "reference", "error"):
        assert np.array_equal(part.parts[name], whole.parts[name][6:9, 5:15])


def test_full_samples_all_pixels_for_the_same_image(command, tmp_path):
    arguments = ("--sampler", "random", "--spp", "3", "--size", "32", "--scene", "disk", "--json")
    some = command("render", *arguments, "-o", "some.exr").report
    every = command("render", *arguments, "--full", "-o", "every.exr").report
    assert some["pixels_left_out"] > 0
    assert every["pixels_left_out"] == 0
    assert every["samples"] == 3 * 32 * 32
    assert {name: some[name] for name in ("mse", "bias")} == {name: every[name] for name in ("mse", "bias")}
    for name in ("image", "error"):
        assert np.array_equal(read_parts(Path("some.exr")).parts[name], read_parts(Path("every.exr")).parts[name])


def test_sums_over_threads_are_called_so(command):
    many = command("render", *SMALL, "--threads", "2")
    assert re.search(
        r"points [\d.]+ and scene [\d.]+ \(each summed over 2 threads\), reference [\d.]+, total", many.out
    )
    alone = command("render", *SMALL, "--threads", "1")
    assert re.search(r"setup [\d.]+, points [\d.]+ and scene [\d.]+, reference [\d.]+, total", alone.out)


def test_explanations_go_to_standard_error(command):
    silent = command("render", *SMALL, "--scene", "disk", "--json").report
    done = command("render", *SMALL, "--scene", "disk", "--json", "--explain")
    assert {**done.report, "seconds": None} == {**silent, "seconds": None}
    assert "dimensions: 2 (pixel 2)" in done.err
    assert "left out: " in done.err


def test_more_metrics_when_they_are_asked_for(command):
    report = command("render", *SMALL, "--ssim", "--flip", "--json").report
    assert -1 <= report["ssim"] <= 1
    assert 0 <= report["flip"] <= 1


# --- where the files go ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("output", "stem"),
    [
        ("folder", "folder/zoneplate-hammersley-4spp"),
        ("folder/", "folder/zoneplate-hammersley-4spp"),
        (".", "zoneplate-hammersley-4spp"),
        ("folder/..", "zoneplate-hammersley-4spp"),
        ("a.exr", "a"),
        ("folder/a.exr", "folder/a"),
        ("folder/../a.exr", "a"),
        ("a.b.c.exr", "a.b.c"),
        ("with space.exr", "with space"),
        ("größe 日本.exr", "größe 日本"),
        ("-a.exr", "-a"),
        ("folder.exr", "folder.exr/zoneplate-hammersley-4spp"),
    ],
)
def test_output_is_a_folder_or_a_stem(command, tmp_path, output, stem):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder.exr").mkdir()
    done = command("render", *SMALL, f"--output={output}", "--json")
    assert done.status == 0, done.err
    found = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file())
    assert found == sorted(f"{stem}{ending}" for ending in (".exr", ".png", ".error.png"))
    assert all((tmp_path / file).is_file() for file in done.report["files"])


def test_options_of_a_scene_are_part_of_the_name(command, tmp_path):
    command("render", *SMALL[2:], "--sampler", "halton+shift", "--scene", "disk:radius=0.25,cx=0.5")
    assert names(tmp_path) == three("disk-radius=0.25,cx=0.5-halton+shift-4spp")


def test_an_absolute_path_is_taken_and_named(command, tmp_path):
    report = command("render", *SMALL, "--output", tmp_path / "a.exr", "--json").report
    assert report["files"] == [str(tmp_path / f"a{ending}") for ending in (".exr", ".png", ".error.png")]


def test_old_files_are_replaced(command, tmp_path):
    command("render", *SMALL, "--output", "a.exr")
    first = contents(tmp_path)
    command("render", *SMALL[2:], "--output", "a.exr", "--seed", "1", "--sampler", "random")
    second = contents(tmp_path)
    assert set(first) == set(second)
    assert all(first[name] != second[name] for name in first)


@pytest.mark.skipif(not hasattr(os, "symlink") or os.name == "nt", reason="needs symbolic links")
def test_links_are_followed_and_stay(command, tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to("folder")
    (tmp_path / "b.exr").symlink_to("folder/target.exr")
    assert command("render", *SMALL, "--output", "link/a.exr").status == 0
    assert command("render", *SMALL, "--output", "b.exr").status == 0
    assert names(tmp_path / "folder") == sorted([*three("a"), "target.exr"])
    assert (tmp_path / "b.exr").is_symlink()
    assert read_info(tmp_path / "folder" / "target.exr")["metadata"]["spp"] == 4


# --- plugins ---------------------------------------------------------------------------------------------------------

TOY_SCENE = """
import numpy as np
from samplekit import Scene

class Holes(Scene):
    def value(self, points):
        return np.where(points[0] < 0.25, np.nan, points[1])

    def exact(self, x_edges, y_edges):
        return np.multiply.outer(0.5 * (y_edges[1:] + y_edges[:-1]), np.ones(x_edges.size - 1))
"""


@pytest.mark.parametrize("more", [(), ("--no-error",)])
def test_samples_that_are_not_finite_are_reported_and_turn_the_status(command, plugins, tmp_path, more):
    plugins.offer("toys", "scene", 'SceneSpec("holes", "toy_scene:Holes", "")')
    plugins.module("toy_scene", TOY_SCENE)
    done = command("render", *SMALL, "--scene", "holes", "--json", *more)
    assert done.status == 1
    assert done.error == "64 samples of holes were not finite, in 16 pixels: shown in magenta"
    assert done.report["invalid_pixels"] == 16
    assert done.report["invalid_samples"] == 64
    assert names(tmp_path) == sorted(done.report["files"])
    plain = command("render", *SMALL, "--scene", "holes", *more)
    assert plain.status == 1
    assert plain.error == done.error
    assert "invalid_pixels  16" in plain.out


def test_a_sum_that_overflows_is_no_sample_that_is_not_finite(command, plugins):
    plugins.offer("toys", "scene", 'SceneSpec("huge", "toy_scene:Huge", "")')
    plugins.module(
        "toy_scene",
        """
        import numpy as np
        from samplekit import Scene

        class Huge(Scene):
            def value(self, points):
                return np.full(points.shape[1], 1e308)
        """,
    )
    done = command("render", *SMALL, "--scene", "huge", "--no-error")
    assert done.status == 1
    assert "not finite though all samples were, in 64 pixels" in done.error


def test_what_must_fail_fails_before_a_sample_is_drawn(command, plugins, monkeypatch, tmp_path):
    monkeypatch.setattr(rendering, "integrate", lambda *_, **__: pytest.fail("samples were drawn first"))
    plugins.offer("toys", "scene", 'SceneSpec("toy", "toy_scene:Toy", "")')
    plugins.module(
        "toy_scene",
        """
        from samplekit import Scene

        class Toy(Scene):
            def value(self, points):
                return points[0]

            def exact(self, x_edges, y_edges):
                raise ValueError("not today")
        """,
    )
    assert "cannot give its reference: ValueError: not today" in command("render", *SMALL, "--scene", "toy").error
    small = command("render", *SMALL[:-1], "6x20", "--ssim")
    assert "ssim needs at least 7 x 7 pixels, the image has 6 x 20" in small.error
    assert names(tmp_path) == []


def test_a_plugin_renders_as_ours_do(command, plugins, tmp_path):
    plugins.offer("toys", "sampler", 'SamplerSpec("toy", "toy_points:Toy", "")')
    plugins.module(
        "toy_points",
        """
        from samplekit import Sampler

        class Toy(Sampler):
            def draw(self, count, dims, rng):
                return rng.random((count, dims))
        """,
    )
    assert command("render", "--sampler", "toy", "--spp", "4", "--size", "8").status == 0
    metadata = read_info(tmp_path / "zoneplate-toy-4spp.exr")["metadata"]
    assert metadata["sampler_plugin"] == "toys (toys-distribution 1.0)"


def test_a_scene_needs_no_more_than_its_value(command, plugins, tmp_path):
    plugins.offer("toys", "scene", 'SceneSpec("ramp", "toy_scene:Ramp", "")')
    plugins.module(
        "toy_scene",
        """
        from samplekit import Scene

        class Ramp(Scene):
            def value(self, points):
                return points[0]
        """,
    )
    report = command("render", "--scene", "ramp", "--sampler", "regular", "--spp", "4", "--size", "8", "--json").report
    # The centres of a grid integrate a ramp without error, and so does a quadrature.
    assert report["max_error"] < 1e-12
    assert report["reference"]
    report = command("render", *SMALL, "--scene", "ramp", "--no-error", "--json").report
    assert len(report["files"]) == 2
    assert report["seconds"]["reference"] == 0


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise ValueError('two\\nlines')", "ValueError: two lines"),
        ("return rng.random((count, dims)) + 1", "expected values in [0, 1)"),
        ("return rng.random((count, dims)) * float('nan')", "NaN"),
        ("return rng.random((dims, count + 1))", "shape"),
    ],
)
@pytest.mark.parametrize("more", [(), ("--json",), ("--threads", "1")])
def test_a_sampler_that_fails_ends_in_one_line_and_no_file(command, plugins, tmp_path, body, reason, more):
    plugins.offer("toys", "sampler", 'SamplerSpec("toy", "toy_points:Toy", "")')
    plugins.module(
        "toy_points",
        "from samplekit import Sampler\n\nclass Toy(Sampler):\n"
        f"    def draw(self, count, dims, rng):\n        {body!s}\n".replace("\nlines", "\\nlines"),
    )
    done = command("render", "--sampler", "toy", "--spp", "4", "--size", "64", *more)
    assert done.status == 1
    assert "sampler toy of plugin toys (toys-distribution 1.0)" in done.error
    assert reason in done.error
    assert names(tmp_path) == []
    if "--json" in more:
        assert done.report == {"schema": "samplekit.error/1", "error": done.error}
    else:
        assert done.out == ""


def test_a_command_of_a_plugin_runs_with_its_status_and_help(command, plugins):
    plugins.offer("toys", "command", 'CommandSpec("juggle", "toy_command:juggle", "Throw balls.")')
    plugins.module(
        "toy_command",
        '''
        import typer

        def juggle(balls: int, fail: bool = False, status: int = 0) -> int:
            """Throw balls into the air."""
            if fail:
                raise ValueError("dropped\\n" + "one")
            typer.echo(f"{balls} balls")
            return status
        ''',
    )
    assert command("juggle", "3") == (0, "3 balls\n", "")
    assert command("juggle", "3", "--status", "3").status == 3
    assert "balls" in command("juggle", "--help").out.lower()
    assert "Throw balls." in command("--help").out
    wrong = command("juggle", "three")
    assert (wrong.status, wrong.out) == (2, "")
    assert "balls" in wrong.error
    assert command("juggle").status == 2
    failed = command("juggle", "3", "--fail")
    assert failed.status == 1
    assert "command juggle of plugin toys (toys-distribution 1.0) failed: ValueError: dropped one" in failed.error
    assert "did you mean juggle" in command("jugle", "3").error


def test_a_command_that_cannot_be_imported_harms_no_other(command, plugins):
    plugins.offer("toys", "command", 'CommandSpec("juggle", "toy_command:juggle", "Throw balls.")')
    plugins.module("toy_command", "raise SystemExit(0)")
    done = command("juggle")
    assert done.status == 1
    assert "juggle: cannot import toy_command:juggle: SystemExit" in done.error
    assert "Throw balls." in command("--help").out
    assert command("render", *SMALL).status == 0


# --- processes -------------------------------------------------------------------------------------------------------


def test_a_process_writes_what_this_one_writes(process, command, tmp_path):
    done = process("render", *SMALL, "--json", environment={"PYTHONHASHSEED": "7"})
    assert (done.status, done.err) == (0, "")
    first = contents(tmp_path)
    assert sorted(first) == sorted(done.report["files"])
    assert command("render", *SMALL).status == 0
    assert contents(tmp_path) == first


def test_warnings_may_be_errors(process):
    done = process("render", *SMALL, "--ssim", "--json", environment={"PYTHONWARNINGS": "error"})
    assert (done.status, done.err) == (0, "")
    assert done.report["samples"] == 256


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere file names are Unicode")
def test_names_beyond_ascii_in_a_terminal_without(process, tmp_path):
    environment = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"}
    done = process("render", *SMALL, "--scene", "größe", environment=environment)
    assert done.status == 2
    assert done.error.isascii()
    done = process("render", *SMALL, "--output", "größe.exr", "--json", environment=environment)
    assert (done.status, done.err) == (0, "")
    assert done.out.isascii()
    assert names(tmp_path) == three("größe")


def test_a_reader_that_leaves_is_no_reason_to_complain(tmp_path):
    with subprocess.Popen(
        [sys.executable, "-m", "samplekit", "list"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path
    ) as running:
        running.stdout.close()
        assert running.stderr.read() == b""
        assert running.wait(60) == 1


@pytest.mark.skipif(os.name == "nt", reason="Windows has no interrupt for one process")
@pytest.mark.parametrize("more", [(), ("--json", "--threads", "1")])
def test_an_interrupt_leaves_nothing_behind(tmp_path, more):
    arguments = ("render", "--sampler", "random", "--spp", "2^24", "--size", "256", "--explain", *more)
    with subprocess.Popen(
        [sys.executable, "-m", "samplekit", *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=tmp_path,
        # A shell starts what runs in its background with interrupts ignored, and its children inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as running:
        line = ""
        while not line.startswith("samples: "):
            line = running.stderr.readline()
            assert line, "it ended before it began"
        time.sleep(0.5)
        running.send_signal(signal.SIGINT)
        try:
            out, err = running.communicate(timeout=60)
        finally:
            running.kill()
    assert running.returncode == 130
    assert out == ""
    assert "Traceback" not in err
    assert len(err.splitlines()) <= 1
    assert names(tmp_path) == []


@pytest.mark.slow
def test_kernels_are_announced_on_standard_error_when_they_are_compiled(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "samplekit", "render", *SMALL, "--scene", "bilinear", "--no-error", "--json"],
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr.startswith("samplekit: compiling kernels for this machine")
    assert done.stderr.count("\n") == 1
    assert json.loads(done.stdout)["samples"] == 256


def test_a_crop_does_not_take_the_place_of_the_whole(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    arguments = ["render", "--sampler", "random", "--spp", "1", "--scene", "disk", "--size", "32"]
    assert run(arguments) == 0
    whole = (tmp_path / "disk-random-1spp.exr").read_bytes()
    assert run([*arguments, "--crop", "8,4,16,16"]) == 0
    assert (tmp_path / "disk-random-1spp.exr").read_bytes() == whole
    assert (tmp_path / "disk-random-1spp-crop-8-4-16-16.exr").exists()
