"""The signed error in false colour, with its scale drawn and stated below."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images import diverging
from samplekit.files._images.legend import BACKGROUND, Facts, strip
from samplekit.files._images.png import RESERVED

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_NARROW = 192
_WIDE = 256
_TALL = 4096


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
        Another shape, no pixels, or a scale that is not finite and above 0.
    """
    values = np.asarray(error, np.float64)
    if not (values.ndim == 2 or (values.ndim == 3 and values.shape[2] == 3)) or values.size == 0:
        raise UsageError(f"an error image must have shape [h, w] or [h, w, 3], not {list(values.shape)}")
    if scale is not None and not (math.isfinite(scale) and scale > 0.0):
        raise UsageError(f"the scale of an error image must be finite and above 0, not {scale}")
    finite: NDArray[np.bool_] = np.isfinite(values)
    values = np.where(finite, values, 0.0)
    if values.ndim == 3:
        finite = np.asarray(finite.all(axis=2))
        strongest = np.abs(values).argmax(axis=2)[:, :, None]
        values = np.where(finite, np.take_along_axis(values, strongest, axis=2)[:, :, 0], 0.0)
    magnitude = np.abs(values)
    largest = float(magnitude.max())
    if scale is None:
        scale = rounded_up(largest)
    picture = diverging.colours(values, scale)
    picture[~finite] = RESERVED
    factor = enlargement(values.shape[1], values.shape[0])
    facts = Facts(
        title=title or "",
        scale=scale,
        largest=largest,
        beyond=int((magnitude > scale).sum()),
        invalid=int((~finite).sum()),
        pixels=finite.size,
        enlarged=factor,
    )
    return _assembled(np.repeat(np.repeat(picture, factor, axis=0), factor, axis=1), facts), scale


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


def _assembled(picture: NDArray[np.uint8], facts: Facts) -> NDArray[np.uint8]:
    height, width, _ = picture.shape
    room = max(width, _WIDE)
    above = np.full((height, room, 3), BACKGROUND, np.uint8)
    above[:, :width] = picture
    return np.concatenate([above, strip(facts, room)])
