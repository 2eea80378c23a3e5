import base64
import zlib

import numpy as np
import pytest

from samplekit._errors import SamplekitError
from samplekit._report.pixels import STEPS, pack_error, pack_reference, packed
from samplekit.files import parts_writer, write_group


def planes(text, number):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).reshape(number, -1).astype(np.uint32)


def unpacked_error(text, step):
    low, middle, high = planes(text, 3)
    codes = low | middle << 8 | high << 16
    steps = np.where(codes & 1, -((codes.astype(np.int64) + 1) // 2), codes.astype(np.int64) // 2)
    return np.where(codes == 0xFFFFFF, np.nan, steps * step)


@pytest.mark.parametrize("scale", [1e-40, 1e-12, 1.0, 1e30])
def test_an_error_comes_back_within_half_a_step_and_its_mean_square_within_a_thousandth(scale):
    error = scale * np.random.default_rng(0).standard_normal((40, 60))
    text, step = pack_error(error)
    rms = np.sqrt(np.mean(np.square(error)))
    assert rms / (2 * STEPS) < step <= rms / STEPS
    back = unpacked_error(text, step)
    assert np.abs(back - error.ravel()).max() <= step / 2
    assert np.mean(np.square(back / scale)) == pytest.approx(np.mean(np.square(error / scale)), rel=1e-3)


def test_one_pixel_that_is_far_off_among_many_that_are_right_comes_back_too():
    error = np.zeros((512, 512))
    error[3, 5] = -7.0
    text, step = pack_error(error)
    back = unpacked_error(text, step).reshape(512, 512)
    assert back[3, 5] == pytest.approx(-7.0, abs=step / 2)
    assert np.count_nonzero(back) == 1


def test_pixels_without_a_value_stay_without_one_and_do_not_touch_the_others():
    error = np.array([[0.5, np.nan], [np.inf, -0.25]])
    back = unpacked_error(*pack_error(error))
    assert np.isnan(back).tolist() == [False, True, True, False]
    assert back[[0, 3]] == pytest.approx([0.5, -0.25], abs=1e-2)


def test_an_image_without_any_error_has_none_after_packing():
    assert not unpacked_error(*pack_error(np.zeros((4, 4)))).any()


def test_the_reference_keeps_all_bits_of_float32():
    reference = np.random.default_rng(1).standard_normal((7, 9)).astype(np.float32)
    a, b, c, d = planes(pack_reference(reference.astype(np.float64)), 4)
    words = (a | b << 8 | c << 16 | d << 24).astype(np.uint32)
    assert np.array_equal(words.view(np.float32), reference.ravel())


def test_each_image_is_there_with_the_mean_square_of_its_file(study, tmp_path):
    results = study(size=(20, 12), folder=tmp_path)
    scenes, blobs = packed(results, tmp_path)
    assert [one["scene"] for one in scenes] == results.scenes
    items = [item for one in scenes for item in one["items"]]
    assert [item["row"] for item in items] == list(range(len(results.rows)))
    for item in items:
        error = unpacked_error(blobs[item["pixels"]], item["step"])
        assert np.mean(np.square(error)) == pytest.approx(item["mse"], rel=1e-3)


def test_past_the_budget_each_scene_keeps_the_window_with_the_largest_errors(study, tmp_path):
    results = study(scenes=("disk",), size=(64, 48), folder=tmp_path)
    for row in results.rows:
        error = np.random.default_rng(row.count).standard_normal((48, 64)) * 1e-3
        error[30:40, 10:20] *= 100.0
        write_group(
            [(tmp_path / row.pictures.exr, parts_writer({"reference": np.zeros((48, 64)), "error": error}, {}))]
        )
    (scene,), blobs = packed(results, tmp_path)
    assert not scene["windowed"]
    budget = sum(map(len, blobs.values())) // 3
    (scene,), blobs = packed(results, tmp_path, budget)
    assert sum(map(len, blobs.values())) <= budget
    assert scene["windowed"]
    left, top = scene["window"]
    assert left <= 10
    assert top <= 30
    assert left + scene["width"] >= 20
    assert top + scene["height"] >= 40


def test_an_image_of_another_size_is_refused_by_name(study, tmp_path):
    results = study(scenes=("disk",), size=(8, 8), folder=tmp_path)
    path = tmp_path / results.rows[5].pictures.exr
    write_group([(path, parts_writer({"reference": np.zeros((4, 4)), "error": np.zeros((4, 4))}, {}))])
    with pytest.raises(SamplekitError, match=path.name):
        packed(results, tmp_path)
