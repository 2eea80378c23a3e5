"""The value of a scene at each sample alone, where elsewhere only sums over a pixel are formed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class Summed(Protocol):
    """A scene, or a scene as it was chosen."""

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the integrand over the samples of each pixel; see :meth:`Scene.sums`."""


def sample_values(scene: Summed, tile: Array, boxes: Array) -> Array:
    """Evaluate a scene at each sample.

    Parameters
    ----------
    scene
        What gives sums over pixels: each sample is a pixel of its own, and a sum of one value is that value.
    tile, boxes
        Samples float64[P, D, n] and pixels float64[4, P], as in :meth:`Scene.sums`.

    Returns
    -------
    float64[P, n]
    """
    pixels, dims, count = tile.shape
    single = np.ascontiguousarray(tile.transpose(0, 2, 1)).reshape(pixels * count, dims, 1)
    values = np.empty(pixels * count)
    scene.sums(single, np.repeat(boxes, count, axis=1), values)
    return values.reshape(pixels, count)
