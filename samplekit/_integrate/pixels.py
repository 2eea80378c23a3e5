"""The pixels of a window of an image: their edges, which of them are sampled, their realisations and boxes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations, seed_words
from samplekit._integrate.loop import mean_of_constant
from samplekit.kernels import kernel, pixel_key

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._configured.scene import ConfiguredScene


@dataclass(frozen=True)
class Pixels:
    """The pixels of a window of an image of a scene.

    Parameters
    ----------
    scene
        What the image shows.
    size
        Width and height of the whole image, in pixels.
    window
        x, y, width, height of the part that is looked at.
    full
        Sample pixels in which the scene is constant as well.
    """

    scene: ConfiguredScene
    size: tuple[int, int]
    window: tuple[int, int, int, int]
    full: bool = False

    @classmethod
    def whole(cls, scene: ConfiguredScene, size: tuple[int, int]) -> Pixels:
        """Return all pixels of an image."""
        return cls(scene, size, (0, 0, *size))

    def __len__(self) -> int:
        return self.window[2] * self.window[3]

    @property
    def cropped(self) -> bool:
        """True if the window is not the whole image."""
        return self.window != (0, 0, *self.size)

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the window, as arrays have them."""
        return self.window[3], self.window[2]

    @cached_property
    def x_edges(self) -> NDArray[np.float64]:
        """Left edges of the window's columns and the right edge of the last: i / width, float64[w + 1]."""
        x, _, w, _ = self.window
        return np.arange(x, x + w + 1) / self.size[0]

    @cached_property
    def y_edges(self) -> NDArray[np.float64]:
        """Top edges of the window's rows and the bottom edge of the last: j / height, float64[h + 1]."""
        _, y, _, h = self.window
        return np.arange(y, y + h + 1) / self.size[1]

    @cached_property
    def constant(self) -> NDArray[np.float64]:
        """The value of each constant pixel, NaN where samples are needed: float64[P], row by row."""
        if self.full:
            return np.full(len(self), np.nan)
        return self.scene.constant(self.x_edges, self.y_edges).ravel()

    @cached_property
    def sampled(self) -> NDArray[np.int64]:
        """Flat indices, row by row, of the pixels that are sampled."""
        return np.flatnonzero(np.isnan(self.constant))

    def constant_means(self, count: int) -> NDArray[np.float64]:
        """Return the image float64[P] that ``count`` samples give in constant pixels; NaN in all others."""
        means = np.full(len(self), np.nan)
        if self.sampled.size == len(self):
            return means
        rest = np.flatnonzero(~np.isnan(self.constant))
        constant = self.constant[rest]
        # Neighbours are mostly equal: a run of them counts once, which is many times as fast as sorting all pixels.
        starts = np.flatnonzero(np.concatenate([[True], constant[1:] != constant[:-1]]))
        values, place = np.unique(constant[starts], return_inverse=True)
        distinct = np.array([mean_of_constant(float(value), count) for value in values])
        means[rest] = np.repeat(distinct[place], np.diff(starts, append=rest.size))
        return means

    def locate(self, indices: NDArray[np.int64], seed: int) -> tuple[Realizations, NDArray[np.float64]]:
        """Return the realisations and boxes float64[4, P] of some pixels, given by their flat indices int64[P]."""
        count = indices.size
        keys, xs, ys = np.empty(count, np.uint64), np.empty(count, np.int64), np.empty(count, np.int64)
        boxes = np.empty((4, count))
        x, y, width, _ = self.window
        _locate(indices, x, y, width, *seed_words(seed), self.x_edges, self.y_edges, keys, xs, ys, boxes)
        return Realizations(keys, xs, ys, seed, self.scene.blocks), boxes


@kernel(
    "void(int64[::1], int64, int64, int64, uint64, uint64, float64[::1], float64[::1],"
    " uint64[::1], int64[::1], int64[::1], float64[:,::1])"
)
def _locate(
    indices: NDArray[np.int64],
    x_first: int,
    y_first: int,
    width: int,
    word: np.uint64,
    offset: np.uint64,
    x_edges: NDArray[np.float64],
    y_edges: NDArray[np.float64],
    keys: NDArray[np.uint64],
    xs: NDArray[np.int64],
    ys: NDArray[np.int64],
    boxes: NDArray[np.float64],
) -> None:
    previous, row, column = -2, 0, 0
    for i in range(indices.size):
        # Mostly neighbours: a division is needed only behind a gap or at the end of a row.
        column += 1
        if indices[i] != previous + 1 or column >= width:
            row = indices[i] // width
            column = indices[i] - row * width
        previous = indices[i]
        x, y = x_first + column, y_first + row
        xs[i] = x
        ys[i] = y
        keys[i] = pixel_key(x, y, word, offset)
        boxes[0, i] = x_edges[column]
        boxes[1, i] = x_edges[column + 1] - x_edges[column]
        boxes[2, i] = y_edges[row]
        boxes[3, i] = y_edges[row + 1] - y_edges[row]
