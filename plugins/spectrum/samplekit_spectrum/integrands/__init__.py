"""Power spectra of integrands: |f(m)|^2 of a scene over the unit square, repeated in all directions.

``integrand_of`` finds the closed form by the scene's name and options. The spectrum of a scene without one is computed
from pixel means, and marked as approximate.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit import UsageError
from samplekit_spectrum.integrands.disk import disk
from samplekit_spectrum.integrands.products import bilinear, checker, gaussian
from samplekit_spectrum.integrands.sampled import sampled_integrand
from samplekit_spectrum.integrands.step import step
from samplekit_spectrum.integrands.zoneplate import zoneplate

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    from samplekit import ConfiguredScene
    from samplekit_spectrum.integrands.integrand import Integrand

CLOSED_FORMS: dict[str, Callable[[str, Mapping[str, Any]], Integrand | None]] = {
    "disk": disk,
    "gaussian": gaussian,
    "step": step,
    "checker": checker,
    "bilinear": bilinear,
    "zoneplate": zoneplate,
}
"""Functions of a scene's text and options. They return None if the closed form does not hold for these options."""


def integrand_of(scene: ConfiguredScene) -> Integrand:
    """Return the power spectrum of a scene.

    Raises
    ------
    UsageError
        The scene needs other dimensions than the two of the pixel, or its square is beyond float64.
    """
    if scene.dims != 2:
        raise UsageError(
            f"{scene.text} needs {scene.dims} dimensions: a variance can be predicted for 2, those of the pixel"
        )
    try:
        integrand = _closed_form(scene) or _from_pixel_means(scene)
        finite = math.isfinite(integrand.variance)
    except OverflowError:
        finite = False
    if not finite:
        raise UsageError(f"the square of {scene.text} is beyond float64: its variance cannot be predicted")
    return integrand


def _closed_form(scene: ConfiguredScene) -> Integrand | None:
    if scene.plugin.name != "samplekit" or scene.spec.name not in CLOSED_FORMS:
        return None
    return CLOSED_FORMS[scene.spec.name](scene.text, scene.options)


def _from_pixel_means(scene: ConfiguredScene) -> Integrand:
    with np.errstate(over="ignore", invalid="ignore"):
        return sampled_integrand(scene)
