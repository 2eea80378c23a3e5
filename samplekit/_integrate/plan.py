"""The plan: what a rendering needs and what it leaves out, decided before anything runs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit._memory import check_memory
from samplekit._parsing import check_crop, check_size

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit._chosen.sampler import ConfiguredSampler
    from samplekit._chosen.scene import ConfiguredScene
    from samplekit._specs import SamplerSpec

MOST_SAMPLES = 2**48
"""Samples of one rendering: weeks of work; a larger request is a slip of the keyboard."""
_BYTES_PER_PIXEL = 120
"""110 to 114 were measured on images of 2048 and 4096 pixels a side: reference, error, metrics and files included."""


@dataclass(frozen=True)
class Plan:
    """A rendering that can be carried out: checked, and with its pixels sorted into sampled and constant.

    Parameters
    ----------
    scene, sampler, count
        What is integrated, with which points, how many in each pixel.
    size
        Width and height of the whole image, in pixels.
    window
        x, y, width, height of the part that is rendered.
    seed
        From 0 to 2^64 - 1.
    full
        Sample constant pixels as well.
    reference
        Compute the exact image and the error.
    """

    scene: ConfiguredScene
    sampler: ConfiguredSampler
    count: int
    size: tuple[int, int]
    window: tuple[int, int, int, int]
    seed: int
    full: bool
    reference: bool

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
        """The value of each constant pixel, NaN where samples are needed: float64[h, w]."""
        if self.full:
            return np.full((self.window[3], self.window[2]), np.nan)
        return self.scene.constant(self.x_edges, self.y_edges)

    @cached_property
    def sampled(self) -> NDArray[np.int64]:
        """Flat indices, row by row, of the window's pixels that are sampled."""
        return np.flatnonzero(np.isnan(self.constant.ravel()))

    @property
    def pixels(self) -> int:
        """Number of pixels in the window."""
        return self.window[2] * self.window[3]

    def explain(self) -> list[str]:
        """What is done and what is left out, one line each."""
        left_out = self.pixels - self.sampled.size
        unneeded = [purpose for purpose, _ in self.scene.spec.purposes if purpose not in self.scene.needs]
        lines = [f"dimensions: {self.scene.dims} ({_needs(self.scene)})"]
        if unneeded:
            lines.append(f"left out: the dimensions of {', '.join(unneeded)}: not needed with these options")
        if self.full:
            lines.append("pixels: all sampled (--full)")
        else:
            share = 100.0 * left_out / self.pixels
            lines.append(
                f"left out: {left_out} of {self.pixels} pixels ({share:.2f} %), in which the scene is proven constant"
            )
        lines.append(f"samples: {self.sampled.size} pixels x {self.count} = {self.sampled.size * self.count}")
        lines += [f"scene: {note}" for note in self.scene.notes()]
        lines += [f"sampler: {note}" for note in self.sampler.notes(self.count, self.scene.dims)]
        if not self.reference:
            lines.append("left out: the reference, the error and the metrics (--no-error)")
        return lines


def make_plan(
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    *,
    size: tuple[int, int],
    crop: tuple[int, int, int, int] | None = None,
    seed: int = 0,
    full: bool = False,
    reference: bool = True,
) -> Plan:
    """Check a request and plan it.

    Raises
    ------
    UsageError
        The sampler cannot give the points, the window is not inside the image, or there is not the memory or the time.
    """
    from samplekit._bases.realizations import check_seed

    seed = check_seed(seed)
    width, height = check_size(size)
    window = check_crop(crop, (width, height)) if crop is not None else (0, 0, width, height)
    check_points(scene, sampler, count)
    count = int(count)
    pixels = window[2] * window[3]
    if pixels * count > MOST_SAMPLES:
        raise UsageError(
            f"{pixels} pixels x {count} samples = {pixels * count:.3g}: at most {MOST_SAMPLES:.3g} in one image"
        )
    check_memory(pixels * _BYTES_PER_PIXEL, f"images of {pixels} pixels", ": render it in parts with --crop X,Y,W,H")
    return Plan(scene, sampler, count, (width, height), window, seed, full, reference)


def check_points(scene: ConfiguredScene, sampler: ConfiguredSampler, count: int) -> None:
    """Raise unless the sampler gives the points that the scene needs.

    Raises
    ------
    UsageError
        Where the dimensions are at fault it names the samplers that make them.
    """
    try:
        sampler.check(count, scene.dims, scene.blocks)
    except UsageError as error:
        if _reaches(sampler.spec, scene.dims):
            raise
        from samplekit._registry import registry

        able = [
            name
            for name, offer in registry().all("sampler").items()
            if _reaches(offer.spec, scene.dims)
            and offer.spec.counts.allows(count, scene.dims)
            and not offer.spec.required_options
        ]
        raise UsageError(f"{error}: {scene.text} needs {_needs(scene)}; {', '.join(able)} can") from None


def _reaches(spec: SamplerSpec, dims: int) -> bool:
    least, most = spec.dimensions
    return least <= dims and (most is None or dims <= most)


def _needs(scene: ConfiguredScene) -> str:
    return ", ".join(f"{purpose} {number}" for purpose, number in scene.needs.items())
