"""Power spectra of integrands: |f(m)|^2 of a scene over the unit square, repeated in all directions.

``integrand_of`` finds the closed form by the scene's name and options; a scene without one is sampled, and says so.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit import UsageError
from samplekit_spectrum.integrands.closed import closed_form

if TYPE_CHECKING:
    from samplekit import ConfiguredScene
    from samplekit_spectrum.integrands.integrand import Integrand


def integrand_of(scene: ConfiguredScene) -> Integrand:
    """The power spectrum of a scene.

    Raises
    ------
    UsageError
        The scene needs more than the two dimensions of the pixel, or its square is beyond float64.
    """
    if scene.dims != 2:
        raise UsageError(
            f"{scene.text} needs {scene.dims} dimensions: a variance can be predicted for 2, those of the pixel"
        )
    try:
        integrand = _closed_or_sampled(scene)
        known = math.isfinite(integrand.variance)
    except OverflowError:
        known = False
    if not known:
        raise UsageError(f"the square of {scene.text} is beyond float64: its variance cannot be predicted")
    return integrand


def _closed_or_sampled(scene: ConfiguredScene) -> Integrand:
    closed = closed_form(scene) if scene.plugin.name == "samplekit" else None
    if closed is not None:
        return closed
    from samplekit_spectrum.integrands.sampled import sampled_integrand

    with np.errstate(over="ignore", invalid="ignore"):
        return sampled_integrand(scene)
