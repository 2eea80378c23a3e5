"""The plan: what a rendering needs and what it leaves out, decided before anything runs."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._arguments import check_crop, check_samples, check_size
from samplekit._bases.realizations import check_seed
from samplekit._errors import DimensionsError
from samplekit._integrate.pixels import Pixels
from samplekit._memory import check_memory
from samplekit._registry import registry

if TYPE_CHECKING:
    from collections.abc import Collection

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene
    from samplekit._specs import SamplerSpec

_BYTES_PER_PIXEL = 120
"""110 to 114 were measured on images of 2048 and 4096 pixels a side: reference, error, metrics and files included."""


@dataclass(frozen=True)
class Plan:
    """A rendering that can be carried out: the request is checked.

    Attributes
    ----------
    pixels
        The scene, the size of its image, and the window that is rendered.
    sampler, count
        The sampler, and the number of samples in each pixel.
    seed
        From 0 to 2^64 - 1.
    reference
        Whether the exact image and the error are computed.
    """

    pixels: Pixels
    sampler: ConfiguredSampler
    count: int
    seed: int
    reference: bool

    @property
    def file_stem(self) -> str:
        """Name of the rendering's files without an ending, as `check_stem` takes it; a crop has its own name."""
        pixels = self.pixels
        crop = "-crop-" + "-".join(map(str, pixels.window)) if pixels.cropped else ""
        return f"{pixels.scene.text}-{self.sampler.text}-{self.count}spp{crop}"

    def command(self, metrics: Collection[str]) -> str:
        """Return the command that makes the image, without options that the image does not depend on.

        Parameters
        ----------
        metrics
            Names of the metrics that were computed; some are computed only on request.
        """
        pixels = self.pixels
        words = ["samplekit", "render", "--scene", pixels.scene.text, "--sampler", self.sampler.text]
        words += ["--spp", str(self.count), "--size", f"{pixels.size[0]}x{pixels.size[1]}"]
        if pixels.cropped:
            words += ["--crop", ",".join(map(str, pixels.window))]
        words += ["--seed", str(self.seed)]
        words += ["--full"] if pixels.full else []
        words += [] if self.reference else ["--no-error"]
        words += [f"--{name}" for name in ("ssim", "flip") if name in metrics]
        return shlex.join(words)

    def explain(self) -> list[str]:
        """Say what is done and what is left out, one line each."""
        scene, pixels = self.pixels.scene, self.pixels
        sampled, left_out = pixels.sampled.size, len(pixels) - pixels.sampled.size
        unneeded = [purpose for purpose, _ in scene.spec.purposes if purpose not in scene.needs]
        lines = [f"dimensions: {scene.dims} ({_needs(scene)})"]
        if unneeded:
            lines.append(f"left out: the dimensions of {', '.join(unneeded)}: not needed with these options")
        if pixels.full:
            lines.append("pixels: all sampled (--full)")
        else:
            share = 100.0 * left_out / len(pixels)
            lines.append(
                f"left out: {left_out} of {len(pixels)} pixels ({share:.2f} %), in which the scene is proven constant"
            )
        lines.append(f"samples: {sampled} pixels x {self.count} = {sampled * self.count}")
        lines += [f"scene: {note}" for note in scene.notes()]
        lines += [f"sampler: {note}" for note in self.sampler.notes(self.count, scene.dims)]
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
    seed = check_seed(seed)
    size = check_size(size)
    window = (0, 0, *size) if crop is None else check_crop(crop, size)
    check_points(scene, sampler, count)
    pixels = Pixels(scene, size, window, full)
    check_samples(len(pixels), int(count), "one image")
    advice = ": render it in parts with --crop X,Y,W,H"
    check_memory(len(pixels) * _BYTES_PER_PIXEL, f"images of {len(pixels)} pixels", advice)
    return Plan(pixels, sampler, int(count), seed, reference)


def check_points(scene: ConfiguredScene, sampler: ConfiguredSampler, count: int) -> None:
    """Raise unless the sampler gives the points that the scene needs.

    Raises
    ------
    DimensionsError
        The message names the samplers that make points in so many dimensions.
    UsageError
        The sampler does not make so many points.
    """
    try:
        sampler.check(count, scene.dims, scene.blocks)
    except DimensionsError as error:
        able = [
            name
            for name, registration in registry().all("sampler").items()
            if _makes(registration.spec, count, scene.dims) and not registration.spec.required_options
        ]
        error.args = (f"{error}: {scene.text} needs {_needs(scene)}; {', '.join(able)} can",)
        raise


def _makes(spec: SamplerSpec, count: int, dims: int) -> bool:
    least, most = spec.dimensions
    return least <= dims and (most is None or dims <= most) and spec.counts.allows(count, dims)


def _needs(scene: ConfiguredScene) -> str:
    return ", ".join(f"{purpose} {number}" for purpose, number in scene.needs.items())
