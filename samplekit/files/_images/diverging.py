"""A diverging colour map for signed errors: blue below zero, white at zero, red above.

Each half is a straight line in CIELAB from white to its end: equal steps of error are equal steps of colour to the
eye, errors of equal size are equally dark whatever their sign (Moreland 2009, "Diverging Color Maps for Scientific
Visualization"), and the signs differ along blue and yellow, which all but the rarest colour vision deficiencies tell
apart.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np

from samplekit.files._images.png import encode_srgb

if TYPE_CHECKING:
    from numpy.typing import NDArray

STEPS = 255
"""Number of colours on either side of zero."""

_WHITE = np.array([100.0, 0.0, 0.0])
# Lightness, chroma and hue (degrees) of the ends: the strongest colours of one lightness whose lines to white stay
# within sRGB.
_NEGATIVE = (35.0, 62.0, 290.0)
_POSITIVE = (35.0, 75.0, 40.0)

_D65 = np.array([0.95047, 1.0, 1.08883])
_XYZ_TO_LINEAR = np.array(
    [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]
)


@functools.cache
def table() -> NDArray[np.uint8]:
    """Return the colours uint8[2 * STEPS + 1, 3] as sRGB, from the most negative error to the most positive."""
    far = np.linspace(1.0, 0.0, STEPS + 1)[:, None]
    negative = _WHITE + far * (_cartesian(_NEGATIVE) - _WHITE)
    positive = _WHITE + far[-2::-1] * (_cartesian(_POSITIVE) - _WHITE)
    result: NDArray[np.uint8] = encode_srgb(_linear(np.concatenate([negative, positive]))[None])[0]
    result.flags.writeable = False
    return result


def colours(error: NDArray[np.float64], scale: float) -> NDArray[np.uint8]:
    """Return the colours uint8[h, w, 3] of finite errors float64[h, w]; beyond ±scale they are those of the ends."""
    with np.errstate(over="ignore"):
        relative = np.clip(error / scale, -1.0, 1.0)
    indices = np.rint(relative * STEPS).astype(np.int16) + np.int16(STEPS)
    return np.asarray(table()[indices], np.uint8)


def _cartesian(lightness_chroma_hue: tuple[float, float, float]) -> NDArray[np.float64]:
    lightness, chroma, hue = lightness_chroma_hue
    return np.array([lightness, chroma * np.cos(np.radians(hue)), chroma * np.sin(np.radians(hue))])


def _linear(lab: NDArray[np.float64]) -> NDArray[np.float64]:
    """Convert CIELAB [n, 3] to linear Rec. 709."""
    y = (lab[:, 0] + 16.0) / 116.0
    f = np.stack([y + lab[:, 1] / 500.0, y, y - lab[:, 2] / 200.0], axis=1)
    delta = 6.0 / 29.0
    xyz = _D65 * np.where(f > delta, f**3, 3.0 * delta**2 * (f - 4.0 / 29.0))
    return np.asarray(xyz @ _XYZ_TO_LINEAR.T)
