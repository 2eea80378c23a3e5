"""Rendering: the pixels of a plan, in tiles and on threads, into an image with its reference and error."""

from __future__ import annotations

import math
import os
import time
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import scene as configured_scene
from samplekit._errors import UsageError
from samplekit._integrate.loop import Clock, count_invalid_samples, integrate, pixels_per_tile
from samplekit._integrate.plan import Plan, make_plan
from samplekit._provenance import versions
from samplekit._threads import check_threads, on_threads, requesting

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene
    from samplekit._specs import SamplerSpec, SceneSpec
    from samplekit.plots import RenderingDisplay

    Progress = Callable[[int, int], None]

SCHEMA = "samplekit.rendering/1"
_JOBS_PER_THREAD = 8


@dataclass(frozen=True)
class Rendering:
    """A rendered image.

    Attributes
    ----------
    image
        float64[h, w].
    reference, error
        float64[h, w], the exact image and image - reference; None when they were left out.
    metrics
        Names of ``--json`` to numbers.
    seconds
        By the wall clock. ``setup``: what the sets share, and one first call of sampler and scene, which may compile
        kernels or load them. ``points`` and ``scene``: sums over all threads, each of which adds its own seconds, so
        that they may exceed ``total``. ``reference``, and ``total`` of it all.
    threads
        Number of threads that drew the samples.
    plan
        What was rendered.
    reference_kind
        How exact the reference is, in words; empty when it was left out.
    files
        The files that were written.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.render("disk", "jittered", spp=4, size=(8, 8)).error.shape
    (8, 8)
    """

    image: NDArray[np.float64]
    reference: NDArray[np.float64] | None
    error: NDArray[np.float64] | None
    metrics: dict[str, float]
    seconds: dict[str, float]
    threads: int
    plan: Plan = field(repr=False)
    reference_kind: str = ""
    files: tuple[Path, ...] = ()

    def describe(self) -> dict[str, Any]:
        """Return how the image was made; the same for the same request, so without times and paths."""
        plan, pixels, scene = self.plan, self.plan.pixels, self.plan.pixels.scene
        return {
            "schema": SCHEMA,
            "command": plan.command(self.metrics),
            "versions": versions(),
            "seed": str(plan.seed),
            "sampler": plan.sampler.text,
            "sampler_plugin": str(plan.sampler.plugin),
            "sampler_notes": plan.sampler.notes(plan.count, scene.dims),
            "scene": scene.text,
            "scene_plugin": str(scene.plugin),
            "scene_notes": scene.notes(),
            "spp": plan.count,
            "dimensions": dict(scene.needs),
            "size": list(pixels.size),
            "window": list(pixels.window),
            "reference": self.reference_kind,
            "metrics": _finite(self.metrics),
        }

    def as_json(self) -> dict[str, Any]:
        """Return what ``samplekit render --json`` prints."""
        plan, pixels = self.plan, self.plan.pixels
        return {
            "schema": SCHEMA,
            "sampler": plan.sampler.text,
            "scene": pixels.scene.text,
            "spp": plan.count,
            "size": list(pixels.size),
            "window": list(pixels.window),
            "seed": plan.seed,
            **_finite(self.metrics),
            "reference": self.reference_kind,
            "threads": self.threads,
            "seconds": self.seconds,
            "files": [str(file) for file in self.files],
        }

    def plot(
        self,
        part: Literal["image", "reference", "error"] | None = None,
        *,
        ax: Axes | None = None,
        axes: Any = None,
        scale: float | None = None,
    ) -> RenderingDisplay:
        """Draw the image, the reference and the error side by side, or one of them.

        Parameters
        ----------
        part
            ``"image"``, ``"reference"`` or ``"error"``; None: all that there are.
        ax, axes
            The axes of matplotlib to draw on, of one part or of several; None: a new figure.
        scale
            The error that has the strongest colour; None: the largest error, rounded up.

        Returns
        -------
        samplekit.plots.RenderingDisplay

        Raises
        ------
        UsageError
            An unknown part, one that was left out, or another number of axes.
        """
        from samplekit.plots import RenderingDisplay

        return RenderingDisplay(self, part, scale).plot(ax, axes=axes)

    def save(self, output: str | os.PathLike[str] = "", *, scale: float | None = None) -> Rendering:
        """Write STEM.exr, STEM.png and, where there is an error, STEM.error.png: all of them or none.

        Parameters
        ----------
        output
            A folder, or ``STEM.exr``; by default the current folder.
        scale
            The error that has the strongest colour; None: the largest error, rounded up.

        Returns
        -------
        The same rendering with its ``files``.

        Raises
        ------
        UsageError
            There can be no such files.
        SamplekitError
            A file cannot be written.
        """
        from samplekit.files import RENDERING_ENDINGS, check_stem, write_rendering

        pixels = self.plan.pixels
        stem = check_stem(os.fspath(output), self.plan.file_stem, RENDERING_ENDINGS)
        window = (*pixels.window[:2], *pixels.size)
        files = write_rendering(
            stem, self.image, self.reference, self.error, self.describe(), window=window, scale=scale
        )
        return replace(self, files=tuple(files))


def render(
    scene: str | SceneSpec | ConfiguredScene,
    sampler: str | SamplerSpec | ConfiguredSampler,
    spp: int,
    *,
    size: tuple[int, int] = (512, 512),
    crop: tuple[int, int, int, int] | None = None,
    seed: int = 0,
    threads: int | None = None,
    error: bool = True,
    full: bool = False,
    ssim: bool = False,
    flip: bool = False,
    output: str | os.PathLike[str] | None = None,
    explain: Callable[[str], None] | None = None,
    progress: Progress = lambda _, __: None,
    preparing: Progress = lambda _, __: None,
) -> Rendering:
    """Render a scene, integrating every pixel with samples.

    Parameters
    ----------
    scene, sampler
        As on the command line, or what :func:`samplekit.scene` and :func:`samplekit.sampler` returned.
    spp
        Samples per pixel.
    size
        (width, height) in pixels.
    crop
        (x, y, width, height) of the part that is rendered; equal to the same pixels of the whole.
    seed
        From 0 to 2^64 - 1.
    threads
        None: as many as there are processors. The image does not depend on it.
    error
        Compute the exact reference, the error and the metrics.
    full
        Sample pixels in which the scene is constant as well; the image is the same bit for bit.
    ssim, flip
        Compute these metrics as well.
    output
        Where the files are written, as in :meth:`Rendering.save`; None: no files. A place that takes no files is
        reported before anything is computed.
    explain
        Called with what is done and what is left out, line by line, before anything is computed.
    progress
        Called with the numbers of samples done and to do.
    preparing
        Called with the numbers of steps done and to do while the sampler makes what its sets share.

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        A plugin failed, or a file cannot be written.

    Examples
    --------
    >>> import samplekit
    >>> result = samplekit.render("disk:radius=0.25", "jittered", spp=16, size=(32, 32), seed=1)
    >>> result.image.shape, result.metrics["pixels_sampled"] < 200
    ((32, 32), True)
    """
    plan = make_plan(
        configured_scene(scene),
        configured_sampler(sampler),
        spp,
        size=size,
        crop=crop,
        seed=seed,
        full=full,
        reference=error,
    )
    if output is not None:
        from samplekit.files import RENDERING_ENDINGS, check_stem

        check_stem(os.fspath(output), plan.file_stem, RENDERING_ENDINGS)
    if explain is not None:
        for line in plan.explain():
            explain(line)
    rendering = render_plan(plan, threads=threads, progress=progress, preparing=preparing, ssim=ssim, flip=flip)
    return rendering if output is None else rendering.save(output)


def render_plan(
    plan: Plan,
    *,
    threads: int | None = None,
    progress: Progress = lambda _, __: None,
    preparing: Progress = lambda _, __: None,
    ssim: bool = False,
    flip: bool = False,
) -> Rendering:
    """Carry out a plan.

    Parameters
    ----------
    plan
        From :func:`make_plan`.
    threads, progress, ssim, flip
        As in :func:`render`.
    preparing
        Called with the numbers of steps done and to do while the sampler makes what its sets share.

    Raises
    ------
    UsageError
        Fewer than one thread; metrics without a reference, or SSIM of an image that is too small for it.
    SamplekitError
        A plugin failed.
    """
    threads = check_threads(threads)
    pixels, scene = plan.pixels, plan.pixels.scene
    _check_metrics(plan, ssim, flip)
    if plan.reference:
        # A reference that the scene cannot give is reported before the samples are drawn, not after.
        scene.check_reference(pixels.x_edges[:2], pixels.y_edges[:2])
    began = time.perf_counter()
    plan.sampler.prepare(plan.count, scene.dims, preparing)
    if pixels.sampled.size:
        _make_first_calls(plan)
    seconds = {"setup": time.perf_counter() - began}
    image, points, evaluation = _render_samples(plan, threads, progress)
    seconds |= {"points": points, "scene": evaluation}
    metrics: dict[str, float] = {}
    if not np.isfinite(image).all():
        invalid = pixels.sampled[~np.isfinite(image[pixels.sampled])]
        located = pixels.locate(invalid, plan.seed)
        metrics["invalid_samples"] = count_invalid_samples(scene, plan.sampler, plan.count, *located)
        metrics["invalid_pixels"] = int(np.count_nonzero(~np.isfinite(image)))
    image = image.reshape(pixels.shape)
    reference = error = None
    reference_kind = ""
    reference_began = time.perf_counter()
    seconds["reference"] = 0.0
    if plan.reference:
        from samplekit._metrics import metrics as image_metrics

        with requesting(threads):
            exact = scene.reference(pixels.x_edges, pixels.y_edges)
        reference, reference_kind = exact.image, exact.kind
        seconds["reference"] = time.perf_counter() - reference_began
        error = image - reference
        metrics |= image_metrics(image, reference, ssim=ssim, flip=flip)
        if exact.error > 0.0:
            metrics["reference_error"] = exact.error
    sampled = int(pixels.sampled.size)
    metrics |= {
        "samples": sampled * plan.count,
        "dims": scene.dims,
        "pixels_sampled": sampled,
        "pixels_left_out": len(pixels) - sampled,
    }
    seconds["total"] = time.perf_counter() - began
    return Rendering(image, reference, error, metrics, seconds, threads, plan, reference_kind)


def _finite(numbers: Mapping[str, float]) -> dict[str, float | None]:
    """Return the numbers for JSON, which has no infinity: numbers that are not finite become None."""
    return {name: number if math.isfinite(number) else None for name, number in numbers.items()}


def _check_metrics(plan: Plan, ssim: bool, flip: bool) -> None:
    if (ssim or flip) and not plan.reference:
        raise UsageError("--ssim and --flip compare with the reference, which --no-error leaves out")
    if ssim:
        from samplekit._metrics import check_ssim

        check_ssim(plan.pixels.window[2:])


def _make_first_calls(plan: Plan) -> None:
    """Call sampler and scene once and drop the result: kernels are compiled before samples are drawn and timed."""
    pixels, scene, sampler = plan.pixels, plan.pixels.scene, plan.sampler
    realizations, boxes = pixels.locate(pixels.sampled[:1], plan.seed)
    points = np.empty((1, scene.dims, 1 if sampler.streams else plan.count))
    sampler.fill(points, realizations, plan.count, 0)
    scene.sums(np.ascontiguousarray(points[:, :, :1]), boxes, np.empty(1))


def _render_samples(plan: Plan, threads: int, progress: Progress) -> tuple[NDArray[np.float64], float, float]:
    """Return the image float64[P], row by row, and the seconds that all threads spent on points and on the scene."""
    pixels, scene, sampler = plan.pixels, plan.pixels.scene, plan.sampler
    at_once = pixels_per_tile(scene, sampler, plan.count)
    share = math.ceil(pixels.sampled.size / (threads * _JOBS_PER_THREAD))
    job_pixels = max(1, math.ceil(share / at_once) * at_once)
    starts = range(0, pixels.sampled.size, job_pixels)
    done, total = 0, pixels.sampled.size * plan.count

    def work(start: int, tick: Callable[[int], None]) -> tuple[NDArray[np.float64], Clock]:
        clock = Clock()
        realizations, boxes = pixels.locate(pixels.sampled[start : start + job_pixels], plan.seed)
        means = integrate(scene, sampler, (plan.count,), realizations, boxes, clock=clock, tick=tick)
        return means[0], clock

    def tick(samples: int) -> None:
        nonlocal done
        done += samples
        progress(done, total)

    image, points, evaluation = pixels.constant_means(plan.count), 0.0, 0.0
    for start, (means, clock) in on_threads(work, starts, threads, tick):
        image[pixels.sampled[start : start + job_pixels]] = means
        points, evaluation = points + clock.points[0], evaluation + clock.scene[0]
    return image, points, evaluation
