"""Kernels and their cache: a damaged one is written anew, and none is made where there is no home."""

import os
import subprocess
import sys

import numpy as np
import pytest

from samplekit.kernels import kernel

pytestmark = pytest.mark.slow

MODULE = """
import numpy as np
from samplekit.kernels._compile import kernel

@kernel("void(float64[::1])")
def one(out):
    out[0] = 1.0
"""
PROGRAM = """
import numpy as np, toy_kernel
out = np.zeros(1)
toy_kernel.one(out)
assert out[0] == 1.0
print(sum(toy_kernel.one.stats.cache_hits.values()))
"""


def run(folder, **environment):
    """Hits of the cache, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(folder), **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return int(done.stdout)


@pytest.mark.parametrize("ending", [".nbi", ".nbc"])
def test_a_damaged_cache_is_written_anew(tmp_path, ending):
    (tmp_path / "toy_kernel.py").write_text(MODULE)
    assert run(tmp_path) == 0
    (damaged,) = (tmp_path / "__pycache__").glob(f"*{ending}")
    damaged.write_bytes(b"damaged")
    assert run(tmp_path) == 0
    assert run(tmp_path) == 1


def test_without_a_home_no_folder_is_made(tmp_path):
    folder = tmp_path / "installed"
    folder.mkdir()
    (folder / "toy_kernel.py").write_text(MODULE)
    # Where the cache beside the module should be is a file: as good as write-protected.
    (folder / "__pycache__").write_bytes(b"")
    run(folder, HOME="~", XDG_CACHE_HOME="", PYTHONDONTWRITEBYTECODE="1")
    assert sorted(path.name for path in folder.iterdir()) == ["__pycache__", "toy_kernel.py"]


HELPERS = """
from samplekit.kernels import helper

FACTOR = {factor}

@helper
def scaled(x):
    return {factor} * x
"""
USER = """
import numpy as np
from samplekit.kernels import kernel
from toy_helpers import scaled

@kernel("void(float64[::1])")
def one(out):
    out[0] = scaled(1.0)
"""
SHOW = """
import numpy as np, toy_kernel
out = np.zeros(1)
toy_kernel.one(out)
print(out[0], sum(toy_kernel.one.stats.cache_hits.values()))
"""


def shown(folder):
    """The kernel's result and the hits of the cache, in a process of its own."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), os.environ.get("PYTHONPATH", "")])}
    done = subprocess.run(
        [sys.executable, "-c", SHOW], cwd=folder, env=environment, capture_output=True, text=True, check=True
    )
    return done.stdout.split()


def test_a_helper_of_another_file_that_changes_makes_the_kernel_anew(tmp_path):
    (tmp_path / "toy_helpers.py").write_text(HELPERS.format(factor=2.0))
    (tmp_path / "toy_kernel.py").write_text(USER)
    assert shown(tmp_path) == ["2.0", "0"]
    assert shown(tmp_path) == ["2.0", "1"]
    (tmp_path / "toy_helpers.py").write_text(HELPERS.format(factor=3.0))
    assert shown(tmp_path) == ["3.0", "0"]


def test_a_kernel_is_compiled_at_its_first_call_and_refuses_other_arguments():
    @kernel("float64(float64[::1])")
    def first(values):
        return values[0]

    assert not first.signatures
    with pytest.raises(TypeError):
        first(np.zeros((2, 2)))
    assert first(np.ones(1)) == 1.0
    assert len(first.signatures) == 1
    with pytest.raises(TypeError):
        first(np.zeros(2, np.float32))
