"""A scene under judgement: what is asked of it, and what was drawn for that."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._configured.scene import scene as configured_scene
from samplekit._specs import SceneSpec

if TYPE_CHECKING:
    from numpy.typing import NDArray

SceneRecipe = str | SceneSpec
"""What a user writes (``"disk:radius=0.4"``), or the declaration of a scene that is not installed."""


class SceneSubject:
    """A scene under judgement."""

    def __init__(self, recipe: SceneRecipe, *, quick: bool = False) -> None:
        self.recipe = recipe
        self.scene = configured_scene(recipe)
        self.spec = self.scene.spec
        self.text = self.scene.text
        self.dims = self.scene.dims
        self.quick = quick
        self.drawn = 0
        self.hints: list[str] = []
        self.notes: list[str] = []

    def values(self, u: NDArray[np.float64], box: NDArray[np.float64]) -> NDArray[np.float64]:
        """The integrand float64[M] at samples ``u`` float64[D, M] of the pixel ``box`` (left, width, top, height).

        Each sample is a pixel of one sample: a sum of one value is that value.
        """
        self.drawn += u.shape[1]
        tile = np.ascontiguousarray(u.T[:, :, None])
        out = np.full(u.shape[1], np.nan)
        self.scene.sums(tile, np.repeat(box[:, None], u.shape[1], axis=1), out)
        return out

    def mean(self, u: NDArray[np.float64], box: NDArray[np.float64]) -> float:
        """The mean over samples, summed exactly rounded."""
        return math.fsum(self.values(u, box).tolist()) / int(u.shape[1])

    def note(self, text: str) -> None:
        """What a reader should know of how the judgement was made."""
        self.notes.append(text)
