"""The files of a new plugin: templates (:class:`string.Template`) in which ``$words`` stand for its names."""

from __future__ import annotations

_PYPROJECT = """\
[build-system]
requires = ["hatchling>=1.26"]
build-backend = "hatchling.build"

[project]
name = "$distribution"
version = "0.1.0"
description = "The sampler $name for samplekit."
readme = "README.md"
requires-python = ">=3.11"
# The distribution is samplekit-core; the one that is called samplekit is another project.
dependencies = ["samplekit-core>=$core", "numpy>=2.0"]

[project.optional-dependencies]
test = ["pytest>=8"]

[project.entry-points.samplekit]
$name = "$package"

[tool.hatch.build.targets.wheel]
packages = ["$package"]

[tool.pytest.ini_options]
testpaths = ["tests"]
xfail_strict = true
"""

_DECLARATION = '''\
"""The declaration of $name. It imports no NumPy: the sampler is imported when somebody uses it."""

from samplekit import LatinStrata, SamplerSpec, hookimpl


@hookimpl
def samplekit_samplers() -> list[SamplerSpec]:
    """Return the declarations of this plugin's samplers; `samplekit check $name` checks each claim."""
    return [
        SamplerSpec(
            "$name",
            "$package.sampler:$class_name",
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


class $class_name(Sampler):
    """Latin hypercube sampling: a random permutation of N jittered intervals in each dimension."""

    def draw(self, count: int, dims: int, rng: np.random.Generator) -> NDArray[np.float64]:
        """Return one set, float64[count, dims] in [0, 1); all of its randomness comes from `rng`."""
        cells = np.stack([rng.permutation(count) for _ in range(dims)], axis=1)
        # (cell + r) / count can round up to the next cell, or to 1.0: the last number below is the limit.
        below = np.nextafter((cells + 1) / count, 0.0)
        return np.minimum((cells + rng.random((count, dims))) / count, below)
'''

_TEST = '''\
"""The conformance suite of samplekit checks that the declaration of $name is true."""

import $package
from samplekit.testing import SamplerConformance


class TestConformance(SamplerConformance):
    def specs(self):
        return $package.samplekit_samplers()


def test_is_found_by_its_name():
    import samplekit

    assert samplekit.points("$name", count=16, dims=2).shape == (1, 16, 2)
'''

_README = """\
# $distribution

The sampler `$name`, a plugin of samplekit.

```sh
python -m pip install -e '.[test]'
samplekit list samplers
samplekit render --sampler $name --spp 16
samplekit check $name
python -m pytest
```

- `$package/__init__.py` declares it: the name, what it promises, what it can and cannot make. It imports no NumPy.
- `$package/sampler.py` makes the points.
- `tests/test_conformance.py` checks that the declaration is true.

`samplekit check` says which promise is broken, with the smallest set that breaks it, and which promises could be added.
"""

FILES = {
    "pyproject.toml": _PYPROJECT,
    "README.md": _README,
    "$package/__init__.py": _DECLARATION,
    "$package/sampler.py": _SAMPLER,
    "$package/py.typed": "",
    "tests/test_conformance.py": _TEST,
    ".gitignore": "__pycache__/\n*.egg-info/\n.venv/\ndist/\n",
}
"""The text of each file, by its path."""
