import struct
import time
import zlib

import mpmath
import numpy as np
import OpenImageIO as oiio
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images.png import RESERVED, encode_srgb, read_png, write_png


def pixels(*shape, seed=0):
    return np.random.default_rng(seed).integers(0, 256, shape, np.uint8)


def decoded(level):
    """The linear value of an sRGB level, by the definition's inverse."""
    encoded = mpmath.mpf(level) / 255
    return encoded / mpmath.mpf("12.92") if encoded <= mpmath.mpf("0.04045") else ((encoded + 0.055) / 1.055) ** 2.4


def test_every_level_comes_back():
    linear = np.array([[float(decoded(level)) for level in range(256)]])
    assert np.array_equal(encode_srgb(linear)[0, :, 0], np.arange(256))


def test_rounds_to_nearest_half_way_between_levels():
    half_way = [float(decoded(mpmath.mpf(level) + 0.5)) for level in range(255)]
    below, above = np.array([half_way]) * (1 - 1e-9), np.array([half_way]) * (1 + 1e-9)
    # Level 10 and 11 meet where the definition's two pieces do, which fit to seven digits only.
    assert np.array_equal(encode_srgb(below)[0, :, 0], np.arange(255))
    assert np.array_equal(encode_srgb(above)[0, :, 0], np.arange(1, 256))


def test_agrees_with_openimageio():
    values = np.linspace(0, 1, 999).reshape(27, 37)
    buffer = oiio.ImageBuf(np.ascontiguousarray(values[:, :, None], np.float32))
    theirs = oiio.ImageBufAlgo.colorconvert(buffer, "lin_rec709_scene", "srgb_rec709_scene").get_pixels(oiio.FLOAT)
    assert np.abs(encode_srgb(values)[:, :, 0] - 255.0 * theirs[:, :, 0]).max() < 0.501


def test_clamps():
    assert encode_srgb([[-1e300, -1e-9, 0.0, 1.0, 1.0001, 1e300]])[0, :, 0].tolist() == [0, 0, 0, 255, 255, 255]


def test_grey_has_three_equal_channels():
    encoded = encode_srgb(np.random.default_rng(0).random((5, 6)))
    assert encoded.shape == (5, 6, 3)
    assert encoded.dtype == np.uint8
    assert np.array_equal(encoded[:, :, 0], encoded[:, :, 1])
    assert np.array_equal(encoded[:, :, 0], encoded[:, :, 2])


def test_pixels_that_are_not_finite():
    assert [tuple(pixel) for pixel in encode_srgb([[np.nan, np.inf, -np.inf]])[0]] == [RESERVED] * 3
    colour = np.full((1, 2, 3), 0.5)
    colour[0, 1, 2] = np.nan
    assert encode_srgb(colour)[0].tolist() == [[188, 188, 188], list(RESERVED)]


def test_colour():
    assert encode_srgb([[[0.0, 0.5, 1.0]]]).tolist() == [[[0, 188, 255]]]


def test_what_is_written(tmp_path):
    picture = pixels(9, 13, 3)
    metadata = {"command": "«ü» \n", "seed": "3"}
    write_png(tmp_path / "a.png", picture, metadata)
    file = oiio.ImageInput.open(str(tmp_path / "a.png"))
    assert np.array_equal(file.read_image(oiio.UINT8), picture)
    assert file.spec().get_string_attribute("samplekit") == '{"command": "\\u00ab\\u00fc\\u00bb \\n", "seed": "3"}'
    assert oiio.is_colorspace_srgb(file.spec(), False)
    file.close()
    stored, described = read_png(tmp_path / "a.png")
    assert np.array_equal(stored, picture)
    assert described == metadata


def test_readable_without_openimageio(tmp_path):
    """The chunks as the PNG standard has them: eight bits, colour, our text."""
    picture = pixels(4, 5, 3)
    write_png(tmp_path / "a.png", picture, {"a": 1})
    data = (tmp_path / "a.png").read_bytes()[8:]
    chunks = {}
    while data:
        (length,) = struct.unpack(">I", data[:4])
        chunks.setdefault(data[4:8], b"")
        chunks[data[4:8]] += data[8 : 8 + length]
        data = data[12 + length :]
    assert struct.unpack(">IIBB", chunks[b"IHDR"][:10]) == (5, 4, 8, 2)
    assert chunks[b"tEXt"] == b'samplekit\0{"a": 1}'
    assert b"tIME" not in chunks
    assert len(zlib.decompress(chunks[b"IDAT"])) == 4 * (1 + 15)


def test_same_input_same_bytes(tmp_path):
    picture = pixels(30, 40, 3)
    write_png(tmp_path / "a.png", picture, {"a": 1, "b": 2})
    time.sleep(1.1)
    write_png(tmp_path / "b.png", np.asfortranarray(picture), {"b": 2, "a": 1})
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize("wrong", [np.zeros((2, 2, 3)), pixels(2, 2), pixels(2, 2, 4), pixels(0, 2, 3)])
def test_other_pixels(tmp_path, wrong):
    with pytest.raises(UsageError, match="uint8"):
        write_png(tmp_path / "a.png", wrong, {})


def test_metadata_that_png_cannot_keep_is_an_error(tmp_path):
    write_png(tmp_path / "a.png", pixels(2, 2, 3), {"a": "x" * 1_000_000})
    assert len(read_png(tmp_path / "a.png")[1]["a"]) == 1_000_000
    with pytest.raises(SamplekitError):
        write_png(tmp_path / "b.png", pixels(2, 2, 3), {"a": "x" * 9_000_000})
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


def test_a_full_disk_leaves_the_old_file(small_disk, capfd):
    target = small_disk / "a.png"
    write_png(target, pixels(4, 4, 3), {})
    old = target.read_bytes()
    for side in (146, 147, 148, 150, 300):
        with pytest.raises(SamplekitError, match="no space left") as caught:
            write_png(target, pixels(side, side, 3), {})
        assert "\n" not in str(caught.value)
        assert target.read_bytes() == old
        assert list(small_disk.iterdir()) == [target]
    assert capfd.readouterr() == ("", "")
