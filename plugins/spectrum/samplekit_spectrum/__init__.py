"""Power spectra of samplers, and the variance that they predict.

Importing this package does not import NumPy: ``power`` and ``predict`` are loaded when they are first used.
"""

import lazy_loader

from samplekit import CommandSpec, hookimpl

# Not __dir__: it would hide the hook below from samplekit.
__getattr__, _, __all__ = lazy_loader.attach_stub(__name__, __file__)


@hookimpl
def samplekit_commands() -> list[CommandSpec]:
    """Declare the commands ``spectrum`` and ``predict``."""
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
