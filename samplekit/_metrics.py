"""Metrics: numbers that tell how far an image is from its reference.

Differences are scaled by a power of two before they are squared, and scaled back after the square root. So root mean
squares are right for any finite input, even if the mean square itself is beyond the range of float64; it is then 0 or
infinity.
"""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from samplekit._errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

Array = NDArray[np.float64]

BLUR_SIGMA = 2.0
"""Standard deviation in pixels of the Gaussian of ``blurred_mse``."""
BLUR_RADIUS = 8
"""Pixels after which that Gaussian is cut off: four standard deviations."""
BLUR_WEIGHTS = np.exp(-0.5 * np.square(np.arange(BLUR_RADIUS + 1) / BLUR_SIGMA))
"""float64[9]: weights of that Gaussian at 0 to 8 pixels; with those to the other side their sum is 1."""
BLUR_WEIGHTS /= BLUR_WEIGHTS[0] + 2.0 * BLUR_WEIGHTS[1:].sum()


def metrics(image: ArrayLike, reference: ArrayLike, *, ssim: bool = False, flip: bool = False) -> dict[str, float]:
    """Compute metrics of an image against its reference, over all pixels in which both are finite.

    Parameters
    ----------
    image, reference
        float64[h, w], linear; both of one shape, with at least one pixel.
    ssim, flip
        Whether to compute these metrics as well; SSIM of an image that `check_ssim` accepts.

    Returns
    -------
    dict
        With e = image - reference:

        ``mse``, ``rmse``, ``mae``, ``max_error``
            Mean of e², its square root, mean of the magnitude of e, its maximum.
        ``bias``
            Mean of e, from an exactly rounded sum, so that errors of both signs cancel exactly.
        ``psnr``
            10 log10(1 / mse), in decibels, for a peak of 1; infinity where every e is 0.
        ``relative_mse``
            Mean of e² / (reference² + 0.01).
        ``blurred_mse``
            Mean square of e after a Gaussian blur of sigma 2 pixels (cut off at 8 pixels, normalised to 1, the image
            reflected at its edges, the edge pixel repeated). It is small for errors that are blue noise. Around pixels
            that are not finite the kernel is normalised over the others.
        ``invalid_pixels``
            Number of pixels that are NaN or infinite in the image or the reference. All metrics leave them out, and are
            NaN if no pixel is left.
        ``ssim``
            Mean structural similarity (Wang et al. 2004) for a data range of 1, in windows of 7 x 7 pixels, as
            ``skimage.metrics.structural_similarity`` computes it; windows with an invalid pixel are left out. NaN if
            squares of the values themselves overflow.
        ``flip``
            Mean FLIP error (Andersson et al. 2020), values clamped to [0, 1]; invalid pixels are black in both images,
            and left out of the mean.

    Raises
    ------
    SamplekitError
        FLIP is asked for, and this OpenImageIO does not have it.
    """
    image, reference = np.asarray(image, np.float64), np.asarray(reference, np.float64)
    valid = np.isfinite(image) & np.isfinite(reference)
    if not valid.all():
        image, reference = np.where(valid, image, 0.0), np.where(valid, reference, 0.0)
    result = _errors(image, reference, valid)
    result["invalid_pixels"] = int(valid.size - np.count_nonzero(valid))
    if ssim:
        result["ssim"] = _ssim(image, reference, valid)
    if flip:
        from samplekit.files._images.flip import flip_map

        result["flip"] = _mean(flip_map(image, reference)[valid])
    return result


def _errors(image: Array, reference: Array, valid: NDArray[np.bool_]) -> dict[str, float]:
    # Only values near the largest float are divided: the smallest would lose digits.
    shrink = 8 if max(np.abs(image).max(), np.abs(reference).max()) > 2.0**1000 else 0
    error = _times_power_of_two(image, -shrink) - _times_power_of_two(reference, -shrink)
    scaled, power = _scaled(error)
    power += shrink
    mean_square = _mean(np.square(scaled[valid]))
    relative, relative_power = _scaled(error / _floored(reference))
    blurred, blurred_power = _scaled(blur(scaled, valid))
    return {
        "mse": _times_power(mean_square, 2 * power),
        "rmse": _times_power(math.sqrt(mean_square), power),
        "mae": _times_power(_mean(np.abs(scaled[valid])), power),
        "max_error": _times_power(float(np.abs(scaled).max()) if valid.any() else math.nan, power),
        "bias": _times_power(_exact_mean(scaled[valid]), power),
        "psnr": math.inf if mean_square == 0.0 else -10.0 * (math.log10(mean_square) + 2 * power * math.log10(2.0)),
        "relative_mse": _times_power(_mean(np.square(relative[valid])), 2 * (relative_power + shrink)),
        "blurred_mse": _times_power(_mean(np.square(blurred[valid])), 2 * (blurred_power + power)),
    }


def _scaled(values: Array) -> tuple[Array, int]:
    """Divide values by the power of two that brings the largest into [1/2, 1); return that power's exponent as well."""
    exponent = math.frexp(float(np.abs(values).max()))[1]
    return _times_power_of_two(values, -exponent), exponent


def _times_power_of_two(values: Array, exponent: int) -> Array:
    """Return ``values`` * 2^``exponent``."""
    # One multiplication is exact and ten times as fast as ldexp, while the factor itself is a normal number.
    return values * 2.0**exponent if abs(exponent) < 1000 else np.ldexp(values, exponent)


def _floored(reference: Array) -> Array:
    """Return sqrt(reference^2 + 1e-2), by which the error is divided for the relative error."""
    if np.abs(reference).max() > 2.0**500:
        return np.hypot(reference, 0.1)
    floored: Array = np.sqrt(reference * reference + 1e-2)
    return floored


def _times_power(value: float, exponent: int) -> float:
    """Return ``value`` * 2^``exponent``, infinity beyond the largest float."""
    with np.errstate(over="ignore", under="ignore"):
        return float(np.ldexp(value, exponent))


def _mean(values: Array) -> float:
    """Return the mean of float64[n], summed pairwise; NaN of nothing."""
    return float(values.mean()) if values.size else math.nan


def _exact_mean(values: Array) -> float:
    """Return the mean of float64[n] from a sum rounded once; NaN of nothing."""
    chunks = (values[start : start + 65536].tolist() for start in range(0, values.size, 65536))
    return math.fsum(itertools.chain.from_iterable(chunks)) / values.size if values.size else math.nan


def blur(error: Array, valid: NDArray[np.bool_]) -> Array:
    """Return the error after the Gaussian blur of ``blurred_mse``.

    Parameters
    ----------
    error
        float64[h, w], 0 where it is not valid.
    valid
        bool[h, w]. The kernel leaves out the pixels that are not valid.
    """
    # This takes as long as the blur of scipy.ndimage and saves its import, which takes longer than either.
    blurred = _convolved(_convolved(error).T).T
    if valid.all():
        return blurred
    weight = _convolved(_convolved(valid.astype(np.float64)).T).T
    return np.where(valid, blurred / np.where(valid, weight, 1.0), 0.0)


def _convolved(values: Array) -> Array:
    """Blur along the first axis."""
    length = len(values)
    padded = np.pad(values, ((BLUR_RADIUS, BLUR_RADIUS), (0, 0)), mode="symmetric")
    result: Array = padded[BLUR_RADIUS : BLUR_RADIUS + length] * BLUR_WEIGHTS[0]
    for offset in range(1, BLUR_RADIUS + 1):
        before, after = BLUR_RADIUS - offset, BLUR_RADIUS + offset
        pair = padded[before : before + length] + padded[after : after + length]
        pair *= BLUR_WEIGHTS[offset]
        result += pair
    return result


_SSIM_WINDOW = 7


def check_ssim(size: Sequence[int]) -> None:
    """Check that an image of ``size`` (width, height) is large enough for SSIM.

    Raises
    ------
    UsageError
        The image has fewer than 7 pixels along a side.
    """
    if min(size) < _SSIM_WINDOW:
        raise UsageError(f"ssim needs at least 7 x 7 pixels, the image has {size[0]} x {size[1]}: leave ssim out")


def _ssim(image: Array, reference: Array, valid: NDArray[np.bool_]) -> float:
    """Return the mean structural similarity over the windows whose pixels are all valid."""
    from skimage.metrics import structural_similarity

    with np.errstate(all="ignore"):
        mean, local = structural_similarity(image, reference, data_range=1.0, win_size=_SSIM_WINDOW, full=True)
    if valid.all():
        return float(mean)
    whole = np.lib.stride_tricks.sliding_window_view(valid, (_SSIM_WINDOW, _SSIM_WINDOW)).all(axis=(2, 3))
    edge = _SSIM_WINDOW // 2
    return _mean(local[edge:-edge, edge:-edge][whole])
