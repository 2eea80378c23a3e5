"""How an image was made: what ``samplekit info`` reads back, enough to make it again."""

from __future__ import annotations

import math
import platform
import shlex
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from samplekit._integrate.plan import Plan
    from samplekit._integrate.rendering import Rendering

SCHEMA = "samplekit.rendering/1"
_LIBRARIES = ("numpy", "numba", "scipy", "OpenImageIO")


def versions() -> dict[str, str]:
    """Return the versions of samplekit, of Python and of the libraries that numbers depend on.

    Examples
    --------
    >>> import samplekit
    >>> sorted(samplekit.versions())
    ['OpenImageIO', 'numba', 'numpy', 'python', 'samplekit', 'scipy']
    """
    from samplekit import __version__

    return {"samplekit": __version__, "python": platform.python_version()} | {
        name: version(name) for name in _LIBRARIES
    }


def command(plan: Plan, metrics: Collection[str] = ()) -> str:
    """The command that makes this image: without what the image does not depend on (output, threads).

    ``metrics``: the names of those that were computed; some are computed on request alone.
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
    """The provenance of a rendering; the same for the same command, so no times and no paths."""
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
    """The numbers for JSON, which knows no infinity: those that are not finite become null."""
    return {name: number if math.isfinite(number) else None for name, number in numbers.items()}
