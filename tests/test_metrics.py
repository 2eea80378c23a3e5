import math
import subprocess
import sys
from fractions import Fraction

import mpmath
import numpy as np
import OpenImageIO as oiio
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import gaussian_filter
from skimage.metrics import structural_similarity

from samplekit._errors import UsageError
from samplekit._metrics import BLUR_RADIUS, BLUR_SIGMA, check_ssim, metrics

NAMES = {"mse", "rmse", "mae", "max_error", "bias", "psnr", "relative_mse", "blurred_mse", "invalid_pixels"}


def images(height=12, width=17, seed=0):
    generator = np.random.default_rng(seed)
    reference = generator.random((height, width))
    return reference + 0.1 * generator.normal(size=reference.shape), reference


def exactly(image, reference):
    """mse, mae, max_error, bias, relative_mse as fractions."""
    pairs = [(Fraction(a), Fraction(b)) for a, b in zip(np.ravel(image), np.ravel(reference), strict=True)]
    errors = [a - b for a, b in pairs]
    n = len(errors)
    return {
        "mse": sum(e * e for e in errors) / n,
        "mae": sum(abs(e) for e in errors) / n,
        "max_error": max(abs(e) for e in errors),
        "bias": sum(errors) / n,
        "relative_mse": sum((a - b) ** 2 / (b * b + Fraction(1, 100)) for a, b in pairs) / n,
    }


def test_names():
    image, reference = images()
    assert set(metrics(image, reference)) == NAMES
    assert set(metrics(image, reference, ssim=True, flip=True)) == NAMES | {"ssim", "flip"}
    assert all(type(value) in (int, float) for value in metrics(image, reference, ssim=True, flip=True).values())


def test_against_exact_arithmetic():
    image, reference = images()
    found = metrics(image, reference)
    for name, value in exactly(image, reference).items():
        assert found[name] == pytest.approx(float(value), rel=1e-14, abs=1e-17), name
    mse = mpmath.mpf(exactly(image, reference)["mse"].numerator) / exactly(image, reference)["mse"].denominator
    assert found["rmse"] == pytest.approx(float(mpmath.sqrt(mse)), rel=1e-15)
    assert found["psnr"] == pytest.approx(float(-10 * mpmath.log10(mse)), rel=1e-15)
    assert found["invalid_pixels"] == 0


finite = st.floats(-1e6, 1e6, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-6)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(finite, finite), min_size=1, max_size=9))
def test_against_exact_arithmetic_anywhere(pairs):
    image, reference = np.array(pairs).T[:, None, :]
    found = metrics(image, reference)
    error = image - reference
    exact = exactly(error, np.zeros_like(error))
    for name in ("mse", "mae", "max_error"):
        assert found[name] == pytest.approx(float(exact[name]), rel=1e-14)
    assert found["bias"] == float(exact["bias"]) or found["bias"] == pytest.approx(float(exact["bias"]), rel=1e-15)


def test_no_error():
    _, reference = images()
    found = metrics(reference, reference, ssim=True, flip=True)
    assert {name for name, value in found.items() if value == 0} == NAMES - {"psnr"} | {"flip"}
    assert found["psnr"] == math.inf
    assert found["ssim"] == 1.0


@pytest.mark.parametrize("error", [0.1, -0.25, 1.0, 3e-9])
def test_constant_error(error):
    found = metrics(np.full((20, 30), error), np.zeros((20, 30)))
    assert found["mse"] == pytest.approx(error**2, rel=1e-14)
    assert found["rmse"] == pytest.approx(abs(error), rel=1e-14)
    assert found["mae"] == pytest.approx(abs(error), rel=1e-14)
    assert found["max_error"] == abs(error)
    assert found["bias"] == pytest.approx(error, rel=1e-15)
    assert found["psnr"] == pytest.approx(-20 * math.log10(abs(error)), rel=1e-13)
    assert found["relative_mse"] == pytest.approx(error**2 / 0.01, rel=1e-14)
    assert found["blurred_mse"] == pytest.approx(error**2, rel=1e-13)


def test_one_pixel():
    found = metrics([[0.75]], [[0.5]])
    assert (found["mse"], found["bias"], found["max_error"]) == (0.0625, 0.25, 0.25)
    assert found["blurred_mse"] == pytest.approx(0.0625, rel=1e-14)
    assert found["relative_mse"] == pytest.approx(0.0625 / 0.26, rel=1e-14)


def test_bias_cancels():
    values = np.random.default_rng(0).normal(size=100_000) * 1e15
    error = np.concatenate([values, [1.0, 2.0, 5.0], -values])[None]
    assert metrics(error, np.zeros_like(error))["bias"] == 8.0 / error.size


@pytest.mark.parametrize("power", [-1070, -600, -560, -300, 0, 300, 500, 520, 900])
def test_scaling_by_powers_of_two_is_exact(power):
    image, reference = np.ldexp(np.random.default_rng(0).integers(-99, 99, (2, 9, 11)).astype(float), 0)
    base, scaled = metrics(image, reference), metrics(np.ldexp(image, power), np.ldexp(reference, power))
    for name in ("mae", "max_error", "bias", "rmse"):
        # Below 2^-1022 floats have fewer digits.
        tolerance = 0 if power > -1000 else 0.02
        assert scaled[name] == pytest.approx(math.ldexp(base[name], power), rel=tolerance, abs=0), name
    with np.errstate(over="ignore", under="ignore"):
        assert scaled["mse"] == pytest.approx(float(np.ldexp(base["mse"], 2 * power)), rel=1e-15)
        assert scaled["blurred_mse"] == pytest.approx(float(np.ldexp(base["blurred_mse"], 2 * power)), rel=1e-12)
    assert scaled["psnr"] == pytest.approx(base["psnr"] - 20 * power * math.log10(2), rel=1e-12)


@pytest.mark.parametrize("size", [1e-320, 1e-170, 1e-160, 1e155, 1e300])
def test_root_mean_square_where_the_mean_square_is_out_of_range(size):
    found = metrics([[3 * size, -4 * size]], [[0.0, 0.0]])
    expected = mpmath.sqrt((mpmath.mpf(3 * size) ** 2 + mpmath.mpf(4 * size) ** 2) / 2)
    assert found["rmse"] == pytest.approx(float(expected), rel=1e-14 if size > 1e-300 else 1e-3, abs=0)
    assert found["psnr"] == pytest.approx(float(-20 * mpmath.log10(expected)), rel=1e-5)
    assert found["mse"] == (pytest.approx(float(expected**2), abs=1e-323) if size < 1 else math.inf)


def test_differences_beyond_the_largest_float():
    largest = sys.float_info.max
    found = metrics([[largest, 0.0]], [[-largest, 0.0]])
    assert found["max_error"] == math.inf
    assert found["mae"] == pytest.approx(largest, rel=1e-15)
    assert found["bias"] == pytest.approx(largest, rel=1e-15)
    assert found["relative_mse"] == pytest.approx(2.0, rel=1e-14)
    assert metrics([[largest]], [[0.0]])["relative_mse"] == math.inf
    assert metrics([[largest]], [[0.0]])["rmse"] == largest


def test_relative_error_of_huge_values():
    found = metrics([[1.5e300, 1e200]], [[1e300, 2e200]])
    assert found["relative_mse"] == pytest.approx((0.25 + 0.25) / 2, rel=1e-14)


@pytest.mark.parametrize("shape", [(1, 1), (1, 40), (3, 5), (40, 7), (33, 64)])
def test_blur_is_that_of_scipy(shape):
    error = np.random.default_rng(0).normal(size=shape)
    blurred = gaussian_filter(error, BLUR_SIGMA, mode="reflect", truncate=BLUR_RADIUS / BLUR_SIGMA)
    assert metrics(error, np.zeros(shape))["blurred_mse"] == pytest.approx(np.mean(blurred**2), rel=1e-12)


@pytest.mark.parametrize(("k", "axis"), [(0, 0), (1, 0), (3, 1), (7, 1), (31, 0)])
def test_blur_of_a_cosine(k, axis):
    """Cosines of the DCT are eigenvectors of a symmetric kernel with reflected edges."""
    n = 32
    wave = np.cos(math.pi * (np.arange(n) + 0.5) * k / n)
    error = np.broadcast_to(wave[:, None] if axis == 0 else wave[None, :], (n, n))
    offsets = range(-BLUR_RADIUS, BLUR_RADIUS + 1)
    kernel = [mpmath.exp(-(mpmath.mpf(j) ** 2) / (2 * BLUR_SIGMA**2)) for j in offsets]
    gain = sum(w * mpmath.cos(mpmath.pi * k * j / n) for w, j in zip(kernel, offsets, strict=True)) / sum(kernel)
    found = metrics(error, np.zeros((n, n)))
    assert found["blurred_mse"] == pytest.approx(found["mse"] * float(gain) ** 2, rel=1e-9, abs=1e-20)


def test_pixels_that_are_not_finite_are_left_out_and_counted():
    image, reference = images()
    image[2, 3], image[4, 5], reference[6, 7] = np.nan, np.inf, -np.inf
    image[8, 9] = reference[8, 9] = np.nan
    valid = np.isfinite(image) & np.isfinite(reference)
    found = metrics(image, reference)
    assert found["invalid_pixels"] == 4
    for name, value in exactly(image[valid], reference[valid]).items():
        assert found[name] == pytest.approx(float(value), rel=1e-13), name
    assert all(math.isfinite(value) for value in found.values())


def test_blur_around_invalid_pixels():
    error = np.random.default_rng(0).normal(size=(9, 10))
    image = error.copy()
    image[3, 4] = image[0, 0] = np.nan
    valid = np.isfinite(image)
    weights = gaussian_filter(valid.astype(float), BLUR_SIGMA, mode="reflect")
    blurred = gaussian_filter(np.where(valid, error, 0.0), BLUR_SIGMA, mode="reflect") / weights
    assert metrics(image, np.zeros((9, 10)))["blurred_mse"] == pytest.approx(np.mean(blurred[valid] ** 2), rel=1e-12)


def test_no_pixel_is_finite():
    found = metrics(np.full((8, 8), np.nan), np.zeros((8, 8)), ssim=True, flip=True)
    assert found.pop("invalid_pixels") == 64
    assert all(math.isnan(value) for value in found.values())


def test_ssim():
    image, reference = images(20, 30)
    expected = structural_similarity(image, reference, data_range=1.0)
    assert metrics(image, reference, ssim=True)["ssim"] == expected


def test_ssim_leaves_out_windows_with_invalid_pixels():
    image, reference = images(20, 30)
    image[10, 4] = np.nan
    _, local = structural_similarity(
        np.nan_to_num(image), np.where(np.isnan(image), 0, reference), data_range=1.0, full=True
    )
    inside = [local[y, x] for y in range(3, 17) for x in range(3, 27) if max(abs(y - 10), abs(x - 4)) > 3]
    assert metrics(image, reference, ssim=True)["ssim"] == pytest.approx(np.mean(inside), rel=1e-12)


def test_ssim_of_small_images():
    assert metrics(*images(7, 7), ssim=True)["ssim"] < 1
    for height, width in ((6, 30), (30, 6), (1, 1)):
        with pytest.raises(UsageError, match="7 x 7"):
            check_ssim((width, height))


def test_flip():
    image, reference = images(40, 50)
    buffers = [
        oiio.ImageBuf(np.repeat(np.clip(v, 0, 1)[:, :, None], 3, 2).astype(np.float32)) for v in (reference, image)
    ]
    expected = oiio.ImageBufAlgo.FLIP_diff(*buffers, hdr=0).get_pixels(oiio.FLOAT)
    assert metrics(image, reference, flip=True)["flip"] == pytest.approx(float(expected.mean()), rel=1e-6)


def test_flip_is_of_what_a_display_shows():
    black, white = np.zeros((9, 9)), np.ones((9, 9))
    assert metrics(white, black, flip=True)["flip"] > 0.9
    assert metrics(7 * white, white, flip=True)["flip"] == 0
    assert metrics(1e300 * white, -white, flip=True)["flip"] == metrics(white, black, flip=True)["flip"]
    broken = white.copy()
    broken[0, 0] = np.nan
    assert metrics(broken, white, flip=True)["flip"] == 0
    assert metrics([[1.0]], [[0.0]], flip=True)["flip"] > 0.5


def test_input_is_not_changed():
    image, reference = images()
    image[0, 0] = np.nan
    before = image.copy(), reference.copy()
    metrics(image, reference)
    assert np.array_equal(image, before[0], equal_nan=True)
    assert np.array_equal(reference, before[1])


def test_layouts_of_memory_do_not_matter():
    image, reference = images()
    expected = metrics(image, reference)
    assert metrics(np.asfortranarray(image), reference.tolist()) == pytest.approx(expected, rel=1e-14)


def test_imports_no_more_than_it_needs():
    script = (
        "import sys; from samplekit._metrics import metrics; metrics([[1.0]], [[0.0]])\n"
        "print(sorted({'OpenImageIO', 'scipy', 'skimage'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
