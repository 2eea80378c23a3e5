"""Power spectra of samplers and the variance that they predict: the declarations.

Nothing here imports NumPy; ``power`` and ``predict`` are loaded when they are first used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from samplekit import CommandSpec, hookimpl

if TYPE_CHECKING:
    from samplekit_spectrum.prediction import predict
    from samplekit_spectrum.spectrum import Spectrum, power

__all__ = ["Spectrum", "power", "predict"]

_MODULE_OF = {
    "Spectrum": "samplekit_spectrum.spectrum",
    "power": "samplekit_spectrum.spectrum",
    "predict": "samplekit_spectrum.prediction",
}


@hookimpl
def samplekit_commands() -> list[CommandSpec]:
    """The commands ``spectrum`` and ``predict``."""
    return [
        CommandSpec(
            "spectrum",
            "samplekit_spectrum.cli.spectrum:spectrum",
            "Expected power spectrum of a sampler, or the spectrum of an error image.",
            reference="Subr, Kautz 2013; Pilleboue et al. 2015",
        ),
        CommandSpec(
            "predict",
            "samplekit_spectrum.cli.predict:predict",
            "Variance predicted from the spectra of sampler and scene, beside the measured one.",
            reference="Pilleboue et al. 2015; Singh, Jarosz 2017",
        ),
    ]


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'samplekit_spectrum' has no attribute {name!r}")
    return getattr(importlib.import_module(_MODULE_OF[name]), name)
