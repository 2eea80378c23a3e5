import numpy as np
import OpenImageIO as oiio
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._images.exr import read_parts
from samplekit.files._images.png import encode_srgb, read_png
from samplekit.files._images.reading import read_info
from samplekit.files._images.rendering import write_rendering

NAMES = ["a.error.png", "a.exr", "a.png"]


@pytest.fixture
def rendering():
    generator = np.random.default_rng(0)
    reference = generator.random((20, 30))
    image = reference + 0.1 * generator.normal(size=reference.shape)
    return image, reference, image - reference


def listed(folder):
    return sorted(path.name for path in folder.iterdir())


def test_three_files(tmp_path, rendering):
    image, reference, error = rendering
    files = write_rendering(tmp_path / "a", image, reference, error, {"seed": "0"}, (5, 6, 100, 200))
    assert files == [tmp_path / "a.exr", tmp_path / "a.png", tmp_path / "a.error.png"]
    assert listed(tmp_path) == NAMES
    contents = read_parts(files[0])
    assert list(contents.parts) == ["image", "reference", "error"]
    assert contents.window == (5, 6, 100, 200)
    # The error is that of float64, not the difference of what the file holds of the other two.
    for name, values in zip(contents.parts, rendering, strict=True):
        assert np.array_equal(contents.parts[name], values.astype(np.float32))
    pixels, metadata = read_png(files[1])
    assert np.array_equal(pixels, encode_srgb(image))
    assert metadata == contents.metadata == {"seed": "0"}
    assert read_info(files[2])["metadata"] == {"seed": "0", "error_scale": 0.5}


def test_without_a_reference(tmp_path, rendering):
    files = write_rendering(tmp_path / "a", rendering[0], None, None, {})
    assert listed(tmp_path) == ["a.exr", "a.png"]
    assert list(read_parts(files[0]).parts) == ["image"]


def test_a_stem_with_a_dot(tmp_path, rendering):
    write_rendering(tmp_path / "zoneplate-k0.5", *rendering, {})
    assert listed(tmp_path) == ["zoneplate-k0.5.error.png", "zoneplate-k0.5.exr", "zoneplate-k0.5.png"]


def test_colour_and_pixels_that_are_not_finite(tmp_path):
    image = np.full((4, 5, 3), 0.25)
    image[0, 0, 0] = np.nan
    files = write_rendering(tmp_path / "a", image, image * 0, image, {})
    assert read_parts(files[0]).parts["image"].shape == (4, 5, 3)
    for path in files[1:]:
        assert oiio.ImageInput.open(str(path)).read_image(oiio.UINT8)[0, 0].tolist() == [255, 0, 255]


def test_shapes_must_agree(tmp_path, rendering):
    image, reference, error = rendering
    for reference_, error_ in ((reference[:5], error), (reference, error[:, :5])):
        with pytest.raises(UsageError, match="shape"):
            write_rendering(tmp_path / "a", image, reference_, error_, {})
    assert not listed(tmp_path)


@pytest.mark.parametrize("shape", [(), (3,), (3, 4, 1), (3, 4, 4), (0, 4), (4, 0), (0, 4, 3)])
def test_other_shapes_are_refused(tmp_path, shape):
    with pytest.raises(UsageError, match="shape"):
        write_rendering(tmp_path / "a", *[np.zeros(shape)] * 3, {})
    assert not listed(tmp_path)


def test_a_failure_changes_no_file(tmp_path, rendering):
    image, reference, error = rendering
    write_rendering(tmp_path / "a", image, reference, error, {})
    old = {name: (tmp_path / name).read_bytes() for name in NAMES}
    (tmp_path / "b.error.png").mkdir()
    with pytest.raises(SamplekitError):
        write_rendering(tmp_path / "a", image * 1e300, reference, error, {})
    with pytest.raises(SamplekitError):
        write_rendering(tmp_path / "a", image, reference, error, {"a": float("nan")})
    with pytest.raises(UsageError, match="folder"):
        write_rendering(tmp_path / "b", image, reference, error, {})
    assert listed(tmp_path) == [*NAMES, "b.error.png"]
    assert {name: (tmp_path / name).read_bytes() for name in NAMES} == old


def test_an_interrupt_changes_no_file(tmp_path, rendering, monkeypatch):
    from samplekit.files._images import png

    def interrupt(path):
        raise KeyboardInterrupt

    write_rendering(tmp_path / "a", *rendering, {})
    old = {name: (tmp_path / name).read_bytes() for name in NAMES}
    monkeypatch.setattr(png, "read_png", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_rendering(tmp_path / "a", *rendering, {"other": 1})
    assert {name: (tmp_path / name).read_bytes() for name in NAMES} == old
    assert listed(tmp_path) == NAMES


def test_a_disk_that_fills_up_at_any_file(small_disk):
    generator = np.random.default_rng(0)
    small = generator.random((4, 4))
    write_rendering(small_disk / "a", small, small, small * 0, {})
    old = {name: (small_disk / name).read_bytes() for name in NAMES}
    outcomes = set()
    for side in range(10, 120, 6):
        image = generator.random((side, side))
        try:
            written = write_rendering(small_disk / "a", image, image * 0.9, image * 0.1, {})
        except SamplekitError as error:
            outcomes.add(str(error).split(":")[0].rpartition("/")[2])
            assert {name: (small_disk / name).read_bytes() for name in NAMES} == old
        else:
            outcomes.add("written")
            assert read_parts(written[0]).parts["image"].shape == (side, side)
            old = {name: (small_disk / name).read_bytes() for name in NAMES}
        assert listed(small_disk) == NAMES
    assert {"written", "a.exr"} < outcomes  # and one of the PNG files


def test_same_input_same_bytes(tmp_path, rendering):
    for name in ("a", "b"):
        write_rendering(tmp_path / name, *rendering, {"seed": "1"})
    for ending in (".exr", ".png", ".error.png"):
        assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()
