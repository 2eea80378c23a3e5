"""Any scene on a pedestal: what is left of its digits when every value has a large number added to it.

The spacing of float64 numbers is 1.5e-8 at 1e8 and 0.125 at 1e15: the values are rounded to that before anything is
summed, and no sum can bring back what they lost.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit import Scene, UsageError
from samplekit.kernels import row_sums

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

LARGEST = 1e290


class Offset(Scene):
    """The pedestal plus another scene, rounded at every sample.

    Parameters
    ----------
    scene
        As on the command line, its options joined by ``+``: ``disk``, ``disk:radius=0.2+cx=0.5``.
    pedestal
        -1e290 to 1e290.

    Raises
    ------
    UsageError
        A parameter outside its range, or NaN; a scene that is unknown, or itself an offset, or seen at its centres.
    """

    def __init__(self, scene: str = "gaussian", pedestal: float = 1e8) -> None:
        if not abs(pedestal) <= LARGEST:
            raise UsageError(f"offset: pedestal={pedestal} must be from {-LARGEST:g} to {LARGEST:g}")
        if scene.partition(":")[0].rpartition("/")[2] == "offset":
            raise UsageError(f"offset: scene={scene}: two pedestals are one, their sum")
        self.scene = samplekit.scene(re.sub(r"\+(?=[A-Za-z])", ",", scene))
        if self.scene.at_centre:
            raise UsageError(
                f"offset: scene={scene}: write pixel-filter=center for the whole, not for the scene within"
            )
        self.pedestal = float(pedestal)
        self.finite_variance = self.scene.finite_variance

    def notes(self) -> list[str]:
        """What the scene says, and how coarse the numbers are on the pedestal."""
        spacing = float(np.spacing(abs(self.pedestal)))
        return [
            *self.scene.notes(),
            f"on a pedestal of {self.pedestal:g} values are rounded to multiples of {spacing:.2g}",
        ]

    def dimensions(self) -> dict[str, int]:
        """Those of the scene."""
        return dict(self.scene.needs)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the rounded values over each pixel's samples: see :meth:`Scene.sums`."""
        row_sums(self.scene.values(tile, boxes) + self.pedestal, out)

    def parts(self, tile: Array, boxes: Array) -> Sequence[Array]:
        """The scene's own values and the pedestal: their sum before it is rounded."""
        values = self.scene.values(tile, boxes)
        return values, np.full_like(values, self.pedestal)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """The scene's own reference on the pedestal, rounded once: float64[h, w]."""
        reference = self.scene.reference(x_edges, y_edges)
        self.reference_error = reference.error
        return self.pedestal + reference.image

    def exact_at(self, x: Array, y: Array) -> Array:
        """The scene's means at points on the pedestal, rounded once: float64[h, w]."""
        return self.pedestal + self.scene.reference_at(x, y).image

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Where the scene is constant it is so on the pedestal as well."""
        return self.scene.constant(x_edges, y_edges) + self.pedestal
