"""A plugin whose declarations import NumPy."""

import numpy as np

from samplekit import SamplerSpec, hookimpl


@hookimpl
def samplekit_samplers():
    return [SamplerSpec("heavy", "faulty_samplers:Plain", f"made with numpy {np.__version__}")]
