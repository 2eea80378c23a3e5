"""samplekit: a laboratory for the point samplers of rendering.

Public names are loaded when they are first used: ``import samplekit`` imports no NumPy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

__version__ = "0.2.0"
