"""``samplekit info``: how an image was made, and files that tell nothing."""

import os
import struct
import zlib

import numpy as np
import OpenImageIO as oiio
import pytest


@pytest.fixture
def rendered(command):
    """A folder with an image and its companions."""
    done = command(
        "render", "--sampler", "sobol+owen", "--spp", "4", "--size", "12x9", "--crop", "1,2,10,5", "--seed", "5",
        "--output", "a.exr",
    )  # fmt: skip
    assert done.status == 0, done.err
    return command


def test_an_image_tells_how_it_was_made(rendered):
    done = rendered("info", "a.exr")
    assert (done.status, done.err) == (0, "")
    lines = [line.split() for line in done.out.splitlines()]
    for expected in (["format", "openexr"], ["width", "10"], ["height", "5"], ["window", "1,", "2,", "12,", "9"]):
        assert expected in lines
    assert (
        "samplekit render --scene zoneplate --sampler sobol+owen --spp 4 --size 12x9 --crop 1,2,10,5 --seed 5"
        in done.out
    )
    for name in ("numpy", "numba", "samplekit", "mse", "seed"):
        assert name in done.out


@pytest.mark.parametrize("name", ["a.exr", "a.png", "a.error.png"])
def test_json_is_one_object_for_every_file(rendered, name):
    done = rendered("info", name, "--json")
    assert (done.status, done.err) == (0, "")
    report = done.report
    assert report["schema"] == "samplekit.info/1"
    assert report["file"] == name
    metadata = report["metadata"]
    assert metadata["schema"] == "samplekit.rendering/1"
    assert metadata["seed"] == "5"
    assert metadata["sampler"] == "sobol+owen"
    assert metadata["spp"] == 4
    assert metadata["dimensions"] == {"pixel": 2}
    assert {"numpy", "numba", "scipy", "OpenImageIO", "python", "samplekit"} <= set(metadata["versions"])
    assert metadata["metrics"]["mse"] > 0
    if name == "a.exr":
        assert [part["name"] for part in report["parts"]] == ["image", "reference", "error"]


def test_nothing_in_it_depends_on_the_place_or_the_time(rendered, tmp_path):
    text = rendered("info", "a.exr").out
    assert str(tmp_path) not in text
    assert "seconds" not in text


def png(*chunks):
    pieces = [b"\x89PNG\r\n\x1a\n"]
    for kind, content in chunks:
        pieces.append(struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content)))
    return b"".join(pieces)


HEADER = (b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
PIXEL = (b"IDAT", zlib.compress(b"\0\0"))
END = (b"IEND", b"")


def failed(command, name, *, statuses=(1, 2)):
    done = command("info", name)
    assert done.status in statuses
    assert done.out == ""
    report = command("info", name, "--json").report
    assert report == {"schema": "samplekit.error/1", "error": done.error}
    return done.error


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "neither an EXR nor a PNG"),
        (b"hello\n", "neither an EXR nor a PNG"),
        (b"\0" * 100_000, "neither an EXR nor a PNG"),
        (b"\xff\xd8\xff\xe0" + b"\0" * 100, "neither an EXR nor a PNG"),
        (png(HEADER, PIXEL, END), "not made by samplekit"),
        (png(HEADER, (b"tEXt", b"samplekit\0no json"), PIXEL, END), "metadata is damaged"),
        (png(HEADER, (b"tEXt", b"samplekit\0[1, 2]"), PIXEL, END), "metadata is damaged"),
        (png(HEADER, (b"tEXt", b'samplekit\0{"a": NaN}'), PIXEL, END), "metadata is damaged: NaN is no JSON"),
        (png(HEADER, (b"tEXt", b'samplekit\0{"a": "\\ud800"}'), PIXEL, END), "metadata is damaged"),
        (png(HEADER, (b"tEXt", b"samplekit\0" + b"[" * 100_000), PIXEL, END), "metadata is damaged"),
        (png(HEADER, PIXEL), "damaged"),
        (png(HEADER), "damaged"),
        (png(), "damaged"),
        (png(HEADER, PIXEL, END)[:-1], "damaged"),
        (b"\x76\x2f\x31\x01", "damaged"),
        (b"\x76\x2f\x31\x01" + b"\2\0\0\0" + b"\0" * 100, "damaged"),
        (b"\x76\x2f\x31\x01" + b"\xff" * 1000, "damaged"),
    ],
)
def test_foreign_and_damaged_files_are_refused_in_one_line(command, tmp_path, content, reason):
    (tmp_path / "file").write_bytes(content)
    assert reason in failed(command, "file")


def test_a_foreign_image_of_the_right_format_is_refused(command, tmp_path):
    image = oiio.ImageBuf(np.zeros((4, 4, 3), np.float32))
    for name in ("foreign.exr", "foreign.png"):
        assert image.write(str(tmp_path / name))
        assert "not made by samplekit" in failed(command, name, statuses=(2,))


@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_an_image_cut_short_is_refused_or_told_of_but_nothing_else(rendered, tmp_path, name):
    whole = (tmp_path / name).read_bytes()
    for length in (*range(0, 64, 7), len(whole) // 2, len(whole) - 1):
        (tmp_path / "cut").write_bytes(whole[:length])
        done = rendered("info", "cut")
        if done.status:
            assert done.out == ""
            assert done.error
        else:
            # The header of an EXR file tells all, and stands before the pixels.
            assert name == "a.exr"
            assert done.err == ""


@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_an_image_with_wrong_bytes_is_refused_or_told_of_but_nothing_else(rendered, tmp_path, name):
    whole = (tmp_path / name).read_bytes()
    random = np.random.default_rng(0)
    for _ in range(60):
        damaged = bytearray(whole)
        for place in random.integers(0, min(len(whole), 3000), 3):
            damaged[place] = random.integers(0, 256)
        (tmp_path / "damaged").write_bytes(damaged)
        done = rendered("info", "damaged", "--json")
        assert done.status in (0, 1, 2)
        assert done.report["schema"] == ("samplekit.info/1" if done.status == 0 else "samplekit.error/1")
        assert done.err == "" if done.status == 0 else done.error
        assert "internal error" not in done.err


@pytest.mark.parametrize("name", ["missing.exr", "no/folder.exr", ".", "..", "", "a" * 300, "new\nline"])
def test_what_is_no_file_is_refused(command, name):
    failed(command, name, statuses=(2,))


@pytest.mark.skipif(os.name == "nt", reason="needs devices and pipes")
def test_devices_and_pipes_are_refused_without_waiting(command, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name in ("pipe", "/dev/null", "/dev/zero"):
        assert "not a regular file" in failed(command, name, statuses=(2,))


def test_links_are_followed(rendered, tmp_path):
    if os.name == "nt":
        pytest.skip("needs symbolic links")
    (tmp_path / "link").symlink_to("a.exr")
    (tmp_path / "loop").symlink_to("loop")
    assert rendered("info", "link").status == 0
    failed(rendered, "loop", statuses=(2,))


def test_no_file_or_two_are_wrong_use(command):
    assert command("info").status == 2
    assert command("info", "a", "b").status == 2
