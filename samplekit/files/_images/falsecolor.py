"""The signed error in false colour, with its scale drawn and stated below."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images import diverging
from samplekit.files._images.legend import BACKGROUND, number, pixel_count, strip
from samplekit.files._images.png import RESERVED

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_NARROW = 192
_WIDE = 256
_TALL = 4096
"""Pixels: an image less wide than the first is enlarged to the second, unless it would be taller than the third."""


def error_picture(
    error: ArrayLike, scale: float | None = None, title: str | None = None
) -> tuple[NDArray[np.uint8], float]:
    """Draw a signed error: blue below zero, white at zero, red above; a strip below states the scale.

    Parameters
    ----------
    error
        float64[h, w]; or float64[h, w, 3], of which each pixel shows its channel of largest magnitude. Pixels that
        are NaN or infinite have the colour `samplekit.files._images.png.RESERVED`, which no error has.
    scale
        The error at the ends of the colour bar, finite and above 0; errors beyond it have the colour of the end and
        are counted in the strip. None: the largest |error| rounded up to 1, 2 or 5 times a power of ten.
    title
        First line of the strip, cut short if need be.

    Returns
    -------
    pixels : uint8[H, W, 3]
        Encoded as sRGB. The picture begins at the top left, enlarged by a whole factor, which the strip states, where
        it is narrower than 192 pixels; the strip is at least 256 wide, and beside a narrower picture is a margin.
    scale : float
        The scale used; 0 where none was given and no error is finite and other than 0.

    Raises
    ------
    UsageError
        The scale is not finite and above 0.
    """
    if scale is not None and not 0.0 < scale < math.inf:
        raise UsageError(f"the scale of an error image must be finite and above 0, not {scale}")
    values = np.asarray(error, np.float64)
    finite: NDArray[np.bool_] = np.isfinite(values)
    values = np.where(finite, values, 0.0)
    if values.ndim == 3:
        finite = np.asarray(finite.all(axis=2))
        strongest = np.abs(values).argmax(axis=2)[:, :, None]
        values = np.where(finite, np.take_along_axis(values, strongest, axis=2)[:, :, 0], 0.0)
    if scale is None:
        scale = rounded_up(float(np.abs(values).max()))
    # A scale of 0 means that every error is 0.
    picture = diverging.colours(values, scale or 1.0)
    picture[~finite] = RESERVED
    height, width = values.shape
    factor = enlargement(width, height)
    phrases = _phrases(np.abs(values), finite, scale, factor)
    above = np.full((height * factor, max(width * factor, _WIDE), 3), BACKGROUND, np.uint8)
    above[:, : width * factor] = picture.repeat(factor, axis=0).repeat(factor, axis=1)
    below = strip(title or "", phrases, int((~finite).sum()), scale, above.shape[1])
    return np.concatenate([above, below]), scale


def _phrases(magnitude: NDArray[np.float64], finite: NDArray[np.bool_], scale: float, factor: int) -> list[str]:
    """State in words what the picture shows; the strip itself states the number of pixels that are not finite."""
    largest = float(magnitude.max())
    phrases = ["error = image - reference"]
    if not finite.any():
        phrases.append("scale 0: no finite error")
    elif largest == 0.0:
        phrases.append(f"exact: {'every error' if finite.all() else 'every finite error'} is 0")
        phrases.append(f"scale ±{number(scale)}" if scale > 0.0 else "scale 0")
    else:
        phrases += [f"scale ±{number(scale)}", f"largest |error| {number(largest)}"]
    beyond = int((magnitude > scale).sum())
    if beyond:
        phrases.append(f"{pixel_count(beyond)} beyond the scale")
    if factor > 1:
        phrases.append(f"1 pixel shown as {factor} x {factor}")
    return phrases


def rounded_up(value: float) -> float:
    """Return the least of 1, 2 and 5 times a power of ten that is not below ``value`` >= 0; 0 for 0; never infinity."""
    if value == 0.0:
        return 0.0
    exponent = math.floor(math.log10(value))
    candidates = [float(f"{digit}e{power}") for power in range(exponent - 1, exponent + 2) for digit in (1, 2, 5)]
    return min(min(candidate for candidate in candidates if candidate >= value), sys.float_info.max)


def enlargement(width: int, height: int) -> int:
    """Choose the factor that brings a narrow image to 256 pixels or a little more, unless that makes it very tall."""
    if width >= _NARROW:
        return 1
    return max(1, min(-(-_WIDE // width), _TALL // height))
