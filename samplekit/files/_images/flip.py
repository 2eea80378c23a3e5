"""FLIP, the difference that an eye sees when two images alternate (Andersson et al. 2020), by OpenImageIO."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import SamplekitError
from samplekit.files._images.library import oiio, one_line

if TYPE_CHECKING:
    from numpy.typing import NDArray


def flip_map(image: NDArray[np.float64], reference: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the low-dynamic-range FLIP error of every pixel, in [0, 1], for a display of 67 pixels per degree.

    Parameters
    ----------
    image, reference
        Linear grey float64[h, w], finite; clamped to [0, 1], which is what a display shows.

    Raises
    ------
    SamplekitError
        This OpenImageIO has no FLIP.
    """
    if not hasattr(oiio.ImageBufAlgo, "FLIP_diff"):
        raise SamplekitError(f"OpenImageIO {oiio.__version__} has no FLIP: version 3.2 does")
    result = oiio.ImageBufAlgo.FLIP_diff(_colour(reference), _colour(image), hdr=0)
    pixels = result.get_pixels(oiio.FLOAT)
    if result.has_error or pixels is None or pixels.shape[:2] != image.shape:
        raise SamplekitError(f"OpenImageIO cannot compute FLIP: {one_line(result.geterror())}")
    return np.asarray(pixels, np.float64)[:, :, 0]


def _colour(grey: NDArray[np.float64]) -> oiio.ImageBuf:
    """FLIP takes three channels."""
    shown = np.clip(grey, 0.0, 1.0).astype(np.float32)
    buffer = oiio.ImageBuf(np.ascontiguousarray(np.repeat(shown[:, :, None], 3, axis=2)))
    oiio.set_colorspace(buffer.specmod(), "lin_rec709_scene")
    return buffer
