"""Files that are missing, damaged, or somebody else's."""

import os
import random

import numpy as np
import OpenImageIO as oiio
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files import parts_writer, read_info, read_parts, read_png, write_group, write_png

READERS = [read_parts, read_png, read_info]


@pytest.fixture
def pictures(tmp_path):
    values = np.random.default_rng(0).random((20, 13))
    writer = parts_writer({"image": values, "error": values * 0.1}, {"a": "x" * 200}, window=(1, 2, 30, 40))
    write_group([(tmp_path / "a.exr", writer)])
    write_png(tmp_path / "a.png", np.random.default_rng(1).integers(0, 256, (20, 13, 3), np.uint8), {"b": 2})
    return tmp_path


def test_info(pictures):
    assert read_info(pictures / "a.exr") == {
        "format": "openexr",
        "width": 13,
        "height": 20,
        "window": [1, 2, 30, 40],
        "parts": [
            {"name": "image", "channels": ["Y"], "type": "float"},
            {"name": "error", "channels": ["Y"], "type": "float"},
        ],
        "metadata": {"a": "x" * 200},
    }
    assert read_info(pictures / "a.png") == {
        "format": "png",
        "width": 13,
        "height": 20,
        "window": [0, 0, 13, 20],
        "parts": [{"name": "", "channels": ["R", "G", "B"], "type": "uint8"}],
        "metadata": {"b": 2},
    }


def test_the_content_decides_and_not_the_ending(pictures):
    (pictures / "a.exr").rename(pictures / "b.png")
    (pictures / "a.png").rename(pictures / "c")
    assert read_info(pictures / "b.png")["format"] == "openexr"
    assert read_info(pictures / "c")["format"] == "png"
    with pytest.raises(UsageError, match="not PNG"):
        read_png(pictures / "b.png")
    with pytest.raises(UsageError, match="not EXR"):
        read_parts(pictures / "c")


@pytest.mark.parametrize("read", READERS)
def test_files_that_are_none(tmp_path, read):
    (tmp_path / "text.exr").write_text("hello")
    (tmp_path / "empty.png").touch()
    (tmp_path / "folder").mkdir()
    for name in ("none.exr", "text.exr", "empty.png", "folder", "text.exr/a", "new\nline", "nul\0", "n" * 300):
        with pytest.raises(UsageError) as caught:
            read(tmp_path / name)
        assert str(caught.value).startswith("cannot read ")
        assert "\n" not in str(caught.value)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders here")
@pytest.mark.parametrize("read", READERS)
def test_a_pipe_is_not_waited_for(tmp_path, read):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(UsageError, match="regular"):
        read(tmp_path / "pipe")


def test_images_of_others(tmp_path):
    for name, kind in (("a.exr", "float"), ("a.png", "uint8")):
        assert oiio.ImageBuf(np.zeros((4, 4, 3), np.float32)).write(str(tmp_path / name), kind)
    for read, name in ((read_parts, "a.exr"), (read_png, "a.png"), (read_info, "a.exr"), (read_info, "a.png")):
        with pytest.raises(UsageError, match="not made by samplekit"):
            read(tmp_path / name)


@pytest.mark.parametrize(("text", "reason"), [("{", "damaged"), ("[1]", "no JSON object"), ("\\", "damaged")])
def test_metadata_of_others(tmp_path, text, reason):
    picture = oiio.ImageBuf(np.zeros((4, 4, 3), np.float32))
    picture.specmod().attribute("samplekit", text)
    assert picture.write(str(tmp_path / "a.png"), "uint8")
    with pytest.raises(SamplekitError, match=reason):
        read_info(tmp_path / "a.png")


def message_of(read, path):
    try:
        read(path)
    except SamplekitError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_a_file_cut_short(pictures, name, capfd):
    whole = (pictures / name).read_bytes()
    read = read_parts if name == "a.exr" else read_png
    for length in {*range(0, len(whole), 97), 8, len(whole) - 1}:
        (pictures / name).write_bytes(whole[:length])
        with pytest.raises(SamplekitError) as caught:
            read(pictures / name)
        assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_a_png_with_any_byte_changed(pictures, capfd):
    whole = (pictures / "a.png").read_bytes()
    for position in range(0, len(whole), 7):
        damaged = bytearray(whole)
        damaged[position] ^= 0x80
        (pictures / "a.png").write_bytes(damaged)
        with pytest.raises(SamplekitError):
            read_png(pictures / "a.png")
    assert capfd.readouterr() == ("", "")


@pytest.mark.slow
def test_an_exr_with_a_damaged_header_ends_in_one_line_or_can_be_read(pictures, capfd):
    # EXR has no checksum of its header: some changes are other files, none may be a crash or a page of text.
    whole = (pictures / "a.exr").read_bytes()
    generator = random.Random(0)
    refused = 0
    for _ in range(300):
        damaged = bytearray(whole)
        damaged[generator.randrange(600)] = generator.choice((0, 127, 128, 255, generator.randrange(256)))
        (pictures / "a.exr").write_bytes(damaged)
        for read in (read_parts, read_info):
            message = message_of(read, pictures / "a.exr")
            assert "\n" not in message
            refused += bool(message)
    assert refused > 100
    assert capfd.readouterr() == ("", "")
