"""The conformance suite: every property that a sampler or a scene declares is tied to a check that can fail.

Checks are plain functions and need no test framework. There are four ways to run them: ``samplekit check NAME``,
``samplekit.testing.check("NAME")``, ``pytest --pyargs samplekit.testing --sampler NAME``, and a subclass of
``SamplerConformance`` in a test file. Importing this module does not import NumPy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
