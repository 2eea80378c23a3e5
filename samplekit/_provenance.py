"""How an image was made: the metadata from which ``samplekit info`` tells how to make it again."""

from __future__ import annotations

import math
import platform
import shlex
from functools import cache
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from samplekit._integrate.plan import Plan
    from samplekit._integrate.rendering import Rendering

SCHEMA = "samplekit.rendering/1"
_LIBRARIES = ("numpy", "numba", "scipy", "OpenImageIO")
_library_version = cache(version)


def versions() -> dict[str, str]:
    """Return the versions of samplekit, of Python and of the libraries that numbers depend on.

    Examples
    --------
    >>> import samplekit
    >>> sorted(samplekit.versions())
    ['OpenImageIO', 'numba', 'numpy', 'python', 'samplekit', 'scipy']
    """
    from samplekit import __version__

    libraries = {name: _library_version(name) for name in _LIBRARIES}
    return {"samplekit": __version__, "python": platform.python_version(), **libraries}


def command(plan: Plan, metrics: Collection[str] = ()) -> str:
    """Return the command that makes an image, without options that the image does not depend on (output, threads).

    Parameters
    ----------
    plan
        The plan of the rendering.
    metrics
        Names of the metrics that were computed; some are computed only on request.
    """
    pixels = plan.pixels
    words = ["samplekit", "render", "--scene", pixels.scene.text, "--sampler", plan.sampler.text]
    words += ["--spp", str(plan.count), "--size", f"{pixels.size[0]}x{pixels.size[1]}"]
    if pixels.window != (0, 0, *pixels.size):
        words += ["--crop", ",".join(str(number) for number in pixels.window)]
    words += ["--seed", str(plan.seed)]
    words += ["--full"] if pixels.full else []
    words += [] if plan.reference else ["--no-error"]
    words += [f"--{name}" for name in ("ssim", "flip") if name in metrics]
    return shlex.join(words)


def describe(rendering: Rendering) -> dict[str, Any]:
    """Return the metadata of a rendering. It has no times and no paths, so the same command gives the same bytes."""
    plan, pixels, scene = rendering.plan, rendering.plan.pixels, rendering.plan.pixels.scene
    return {
        "schema": SCHEMA,
        "command": command(plan, rendering.metrics),
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
        "reference": rendering.reference_kind,
        "metrics": finite(rendering.metrics),
    }


def finite(numbers: Mapping[str, float]) -> dict[str, float | None]:
    """Return the numbers for JSON, which has no infinity: numbers that are not finite become None."""
    return {name: number if math.isfinite(number) else None for name, number in numbers.items()}
