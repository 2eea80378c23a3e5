import os
import subprocess
import sys
import time

import numpy as np
import OpenImageIO as oiio
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files import parts_writer, read_parts, write_group


def write_parts(path, parts, metadata, window=None):
    write_group([(path, parts_writer(parts, metadata, window))])


def random(*shape, seed=0):
    return np.random.default_rng(seed).normal(size=shape)


def read_directly(path):
    """Parts by name as (pixels, spec), by OpenImageIO alone."""
    found = {}
    file = oiio.ImageInput.open(str(path))
    while file.seek_subimage(len(found), 0):
        spec = file.spec()
        pixels = file.read_image(len(found), 0, 0, spec.nchannels, oiio.FLOAT)
        found[spec.get_string_attribute("oiio:subimagename")] = (pixels, spec)
    file.geterror()
    file.close()
    return found


def same_bits(a, b):
    return a.shape == b.shape and np.array_equal(a.view(np.uint32), b.view(np.uint32))


def test_parts_are_float32_with_names_and_channels(tmp_path):
    parts = {"image": random(5, 7), "reference": random(5, 7, seed=1), "colour": random(5, 7, 3, seed=2)}
    write_parts(tmp_path / "a.exr", parts, {"seed": "1"})
    found = read_directly(tmp_path / "a.exr")
    assert list(found) == list(parts)
    for name, values in parts.items():
        pixels, spec = found[name]
        assert same_bits(pixels, values.astype(np.float32).reshape(5, 7, -1))
        assert spec.channelnames == (("R", "G", "B") if name == "colour" else ("Y",))
        assert str(spec.format) == "float"
        assert spec.get_string_attribute("compression") == "zip"
        assert spec.get_string_attribute("samplekit") == '{"seed": "1"}'
        assert spec.get("DateTime") is None


def test_reading_gives_back_what_was_written(tmp_path):
    parts = {"image": random(4, 6), "error": random(4, 6, 3)}
    metadata = {
        "command": "samplekit «ü»\n\t\"'",
        "seed": str(2**64 - 1),
        "list": [1, 2.5, None, True],
        "nested": {"a": {}},
    }
    write_parts(tmp_path / "a.exr", parts, metadata, window=(3, 4, 20, 30))
    contents = read_parts(tmp_path / "a.exr")
    assert contents.metadata == metadata
    assert contents.window == (3, 4, 20, 30)
    assert list(contents.parts) == ["image", "error"]
    for name, values in parts.items():
        assert contents.parts[name].dtype == np.float64
        assert np.array_equal(contents.parts[name], values.astype(np.float32))


def test_special_values_keep_their_bits(tmp_path):
    largest = float(np.finfo(np.float32).max)
    values = np.array([[np.nan, np.inf, -np.inf, -0.0], [largest, -largest, 1e-45, 1.2e-38]])
    write_parts(tmp_path / "a.exr", {"image": values}, {})
    assert same_bits(read_directly(tmp_path / "a.exr")["image"][0][:, :, 0], values.astype(np.float32))


def test_signalling_nan_does_not_warn(tmp_path):
    values = np.array([[0x7FF0000000000001, 0]], np.uint64).view(np.float64)
    write_parts(tmp_path / "a.exr", {"image": values}, {})
    assert np.isnan(read_parts(tmp_path / "a.exr").parts["image"][0, 0])


@pytest.mark.parametrize("value", [3.5e38, -1e300, float(np.finfo(np.float32).max) * (1 + 1e-7)])
def test_values_beyond_float32_are_refused(tmp_path, value):
    with pytest.raises(SamplekitError) as caught:
        write_parts(tmp_path / "a.exr", {"image": [[0.0, np.inf, value, np.nan]]}, {})
    assert f"{value:.6g}" in str(caught.value)
    assert "image" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not list(tmp_path.iterdir())


def test_a_crop_knows_its_place(tmp_path):
    write_parts(tmp_path / "a.exr", {"image": random(3, 5)}, {}, window=(10, 20, 100, 50))
    spec = read_directly(tmp_path / "a.exr")["image"][1]
    assert (spec.x, spec.y, spec.width, spec.height) == (10, 20, 5, 3)
    assert (spec.full_x, spec.full_y, spec.full_width, spec.full_height) == (0, 0, 100, 50)


def test_without_a_window_the_pixels_are_the_whole(tmp_path):
    write_parts(tmp_path / "a.exr", {"image": random(3, 5)}, {})
    assert read_parts(tmp_path / "a.exr").window == (0, 0, 5, 3)


@pytest.mark.parametrize("window", [(-1, 0, 10, 10), (0, -1, 10, 10), (6, 0, 10, 10), (0, 8, 10, 10), (0, 0, 4, 3)])
def test_a_window_that_does_not_hold_the_pixels(tmp_path, window):
    with pytest.raises(UsageError, match="not within"):
        write_parts(tmp_path / "a.exr", {"image": random(3, 5)}, {}, window=window)


@pytest.mark.parametrize("shape", [(), (3,), (3, 4, 1), (3, 4, 4), (2, 3, 4, 3), (0, 4), (4, 0), (0, 4, 3)])
def test_other_shapes_are_refused(tmp_path, shape):
    with pytest.raises(UsageError, match="shape"):
        write_parts(tmp_path / "a.exr", {"image": np.zeros(shape)}, {})


def test_parts_of_two_sizes_no_parts_no_name(tmp_path):
    for parts in ({"a": random(2, 3), "b": random(3, 2)}, {}, {"": random(2, 3)}):
        with pytest.raises(UsageError):
            write_parts(tmp_path / "a.exr", parts, {})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("metadata", [{"a": float("nan")}, {"a": float("inf")}, {"a": object()}, {"a": 1, 2: 3}])
def test_metadata_that_is_no_json(tmp_path, metadata):
    with pytest.raises(SamplekitError, match="JSON"):
        write_parts(tmp_path / "a.exr", {"a": random(2, 2)}, metadata)
    assert not list(tmp_path.iterdir())


def test_same_input_same_bytes(tmp_path):
    parts = {"image": random(40, 30), "error": random(40, 30, 3)}
    write_parts(tmp_path / "a.exr", parts, {"b": 1, "a": 2})
    time.sleep(1.1)  # OpenImageIO dates a file to the second
    write_parts(tmp_path / "b.exr", {name: values.copy(order="F") for name, values in parts.items()}, {"a": 2, "b": 1})
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


def test_layouts_of_memory_do_not_matter(tmp_path):
    values = random(6, 8)
    strided = np.zeros((12, 8))
    strided[::2] = values
    read_only = values.copy()
    read_only.flags.writeable = False
    for view in (strided[::2], np.asfortranarray(values), values.T.copy().T, read_only, values.tolist()):
        write_parts(tmp_path / "a.exr", {"image": view}, {})
        assert np.array_equal(read_parts(tmp_path / "a.exr").parts["image"], values.astype(np.float32))


@pytest.mark.parametrize("name", ["q?x=1.exr", "ü 漢.exr", "p%04d.exr", "h#1.exr", "noending", "a.png"])
def test_names_of_files(tmp_path, name):
    if os.name == "nt" and "?" in name:
        pytest.skip("no name on this system")
    values = random(2, 3)
    write_parts(tmp_path / name, {"image": values}, {"a": 1})
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert np.array_equal(read_parts(tmp_path / name).parts["image"], values.astype(np.float32))


def test_one_pixel_and_much_metadata(tmp_path):
    metadata = {"long": "x" * 300_000}
    write_parts(tmp_path / "a.exr", {"image": [[0.5]]}, metadata)
    assert read_parts(tmp_path / "a.exr").metadata == metadata


def test_a_full_disk_leaves_the_old_file(small_disk):
    target = small_disk / "a.exr"
    write_parts(target, {"image": random(4, 4)}, {})
    old = target.read_bytes()
    for side in (128, 130, 200):
        with pytest.raises(SamplekitError, match="no space left") as caught:
            write_parts(target, {"image": random(side, side)}, {})
        assert "\n" not in str(caught.value)
        assert target.read_bytes() == old
        assert list(small_disk.iterdir()) == [target]


def test_a_disk_that_takes_no_more_bytes(tmp_path):
    """As a full disk, for those who may not mount one: the system refuses to let files grow."""
    pytest.importorskip("resource")
    script = (
        "import resource, sys, numpy, pathlib; from samplekit._errors import SamplekitError\n"
        "from samplekit.files import parts_writer, write_group, write_png\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))\n"
        "noise = numpy.random.default_rng(0).random((100, 100))\n"
        "grey = (noise[:, :, None].repeat(3, 2) * 255).astype('uint8')\n"
        "for path, write in (('a.exr', lambda path: write_group([(path, parts_writer({'image': noise}, {}))])),\n"
        "                    ('a.png', lambda path: write_png(path, grey, {}))):\n"
        "    pathlib.Path(path).write_bytes(b'old')\n"
        "    try:\n        write(pathlib.Path(path))\n"
        "    except SamplekitError as error:\n        print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert [line.split(":")[0] for line in done.stdout.splitlines()] == ["cannot write a.exr", "cannot write a.png"]
    assert done.stderr == ""
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr", "a.png"]
    assert all(path.read_bytes() == b"old" for path in tmp_path.iterdir())


def test_what_is_read_back_is_compared(tmp_path, monkeypatch):
    from samplekit.files._images import reading

    pixels = reading.pixels

    def flip_a_bit(*arguments):
        values = pixels(*arguments).copy()
        values.view(np.uint32)[-1, -1, -1] ^= 1
        return values

    monkeypatch.setattr(reading, "pixels", flip_a_bit)
    with pytest.raises(SamplekitError, match="not what was written"):
        write_parts(tmp_path / "a.exr", {"image": random(3, 3)}, {})
    assert not list(tmp_path.iterdir())


def test_nothing_is_printed(tmp_path, capfd):
    write_parts(tmp_path / "a.exr", {"image": random(3, 3)}, {})
    read_parts(tmp_path / "a.exr")
    with pytest.raises(UsageError):
        write_parts(tmp_path / "none" / "a.exr", {"image": random(3, 3)}, {})
    assert capfd.readouterr() == ("", "")


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="no safe fork here")
def test_a_process_may_be_forked_after_writing(tmp_path):
    script = (
        "import os, pathlib; from samplekit.files import parts_writer, write_group\n"
        "writer = parts_writer({'image': [[1.0]]}, {})\n"
        "write_group([(pathlib.Path('a.exr'), writer)])\n"
        "child = os.fork()\n"
        "write_group([(pathlib.Path('a.exr' if child else 'b.exr'), writer)])\n"
        "if child: os.waitpid(child, 0)\n"
    )
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True, timeout=60)
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
