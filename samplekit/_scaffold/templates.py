"""The files of a new plugin. ``@WORDS@`` are replaced by its names; nothing else is a template language."""

from __future__ import annotations

_PYPROJECT = """\
[build-system]
requires = ["hatchling>=1.26"]
build-backend = "hatchling.build"

[project]
name = "@DISTRIBUTION@"
version = "0.1.0"
description = "The sampler @NAME@ for samplekit."
readme = "README.md"
requires-python = ">=3.11"
# The distribution is samplekit-core; the one that is called samplekit is another project.
dependencies = ["samplekit-core>=@CORE@", "numpy>=2.0"]

[project.optional-dependencies]
test = ["pytest>=8"]

[project.entry-points.samplekit]
@NAME@ = "@PACKAGE@"

[tool.hatch.build.targets.wheel]
packages = ["@PACKAGE@"]

[tool.pytest.ini_options]
testpaths = ["tests"]
xfail_strict = true
"""

_DECLARATION = '''\
"""The declaration of @NAME@. It imports no NumPy: the sampler is imported when somebody uses it."""

from samplekit import LatinStrata, SamplerSpec, hookimpl


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """Return the declarations of this plugin's samplers; `samplekit check @NAME@` checks each claim."""
    return [
        SamplerSpec(
            "@NAME@",
            "@PACKAGE@.sampler:@CLASS@",
            "one point in each of N intervals of every dimension",
            reference="McKay, Beckman, Conover 1979",
            promises=(LatinStrata(),),
        )
    ]
'''

_SAMPLER = '''\
"""The sampler: one set of points at a time, made as a whole. Replace `draw` by your own."""

import numpy as np
from numpy.typing import NDArray
from samplekit import Sampler


class @CLASS@(Sampler):
    """Latin hypercube sampling: a random permutation of N jittered intervals in each dimension."""

    def draw(self, count: int, dims: int, rng: np.random.Generator) -> NDArray[np.float64]:
        """One set, float64[count, dims] in [0, 1): use no randomness but `rng`."""
        cells = np.stack([rng.permutation(count) for _ in range(dims)], axis=1)
        # (cell + r) / count can round up to the next cell, and to 1.0: no further than the last number below it.
        below = np.nextafter((cells + 1) / count, 0.0)
        return np.minimum((cells + rng.random((count, dims))) / count, below)
'''

_TEST = '''\
"""The conformance suite of samplekit checks that the declaration of @NAME@ is true."""

import @PACKAGE@
from samplekit.testing import SamplerConformance


class TestConformance(SamplerConformance):
    def specs(self):
        return @PACKAGE@.samplekit_samplers()


def test_is_found_by_its_name():
    import samplekit

    assert samplekit.points("@NAME@", count=16, dims=2).shape == (1, 16, 2)
'''

_README = """\
# @DISTRIBUTION@

The sampler `@NAME@`, a plugin of samplekit.

```sh
python -m pip install -e '.[test]'
samplekit list samplers
samplekit render --sampler @NAME@ --spp 16
samplekit check @NAME@
python -m pytest
```

- `@PACKAGE@/__init__.py` declares it: the name, what it promises, what it can and cannot make. It stays light.
- `@PACKAGE@/sampler.py` makes the points.
- `tests/test_conformance.py` holds the declaration to its word.

`samplekit check` says which promise is broken, with the smallest set that breaks it, and which promises could be added.
"""

FILES = {
    "pyproject.toml": _PYPROJECT,
    "README.md": _README,
    "@PACKAGE@/__init__.py": _DECLARATION,
    "@PACKAGE@/sampler.py": _SAMPLER,
    "@PACKAGE@/py.typed": "",
    "tests/test_conformance.py": _TEST,
    ".gitignore": "__pycache__/\n*.egg-info/\n.venv/\ndist/\n",
}
"""Path to text."""
