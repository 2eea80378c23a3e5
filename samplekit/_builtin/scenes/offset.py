"""Any scene on a pedestal: how many digits of a scene are left if a large number is added to every value.

The spacing of float64 numbers is 1.5e-8 at 1e8 and 0.125 at 1e15. The values are rounded to that before they are
summed, and no way of summing brings the lost digits back.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

import samplekit
from samplekit import Scene, UsageError
from samplekit.kernels import row_sums

Array = NDArray[np.float64]


class Offset(Scene):
    """The pedestal plus another scene, rounded at every sample.

    Parameters
    ----------
    scene
        The other scene as on the command line, its options joined by ``+``: ``disk``, ``disk:radius=0.2+cx=0.5``.
    pedestal
        The number that is added, -1e290 to 1e290.

    Raises
    ------
    UsageError
        The scene is unknown, is itself an offset, or is sampled at the centres of pixels.
    """

    def __init__(self, scene: str = "gaussian", pedestal: float = 1e8) -> None:
        if scene.partition(":")[0].rpartition("/")[2] == "offset":
            raise UsageError(f"offset: scene={scene}: expected no other offset: add the two pedestals")
        self.scene = samplekit.scene(re.sub(r"\+(?=[A-Za-z])", ",", scene))
        if self.scene.at_centre:
            raise UsageError(
                f"offset: scene={scene}: give pixel-filter=center to offset itself, not to the scene inside it"
            )
        self.pedestal = float(pedestal)
        self.finite_variance = self.scene.finite_variance
        self.finite_kurtosis = self.scene.finite_kurtosis
        if self.scene.value_range is not None:
            least, most = self.scene.value_range
            self.value_range = (least + self.pedestal, most + self.pedestal)

    def notes(self) -> list[str]:
        """Return the notes of the scene, and one on the spacing of numbers at the pedestal."""
        spacing = float(np.spacing(abs(self.pedestal)))
        return [
            *self.scene.notes(),
            f"on a pedestal of {self.pedestal:g} values are rounded to multiples of {spacing:.2g}",
        ]

    def dimensions(self) -> dict[str, int]:
        """Return the dimensions of the scene."""
        return dict(self.scene.needs)

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the rounded values over each pixel's samples: see :meth:`Scene.sums`."""
        row_sums(self.scene.values(tile, boxes) + self.pedestal, out)

    def parts(self, tile: Array, boxes: Array) -> tuple[Array, Array]:
        """Return the scene's own values and the pedestal, whose sum is the value before it is rounded."""
        values = self.scene.values(tile, boxes)
        return values, np.full_like(values, self.pedestal)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the scene's own reference plus the pedestal, rounded once: float64[h, w]."""
        reference = self.scene.reference(x_edges, y_edges)
        self.reference_error = reference.error
        return self.pedestal + reference.image

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the scene's means at points plus the pedestal, rounded once: float64[h, w]."""
        return self.pedestal + self.scene.reference_at(x, y).image

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value where the scene itself is constant, NaN elsewhere: float64[h, w]."""
        return self.scene.constant(x_edges, y_edges) + self.pedestal
