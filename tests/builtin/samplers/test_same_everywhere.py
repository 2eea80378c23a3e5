"""The same numbers in another process, in plain Python and in other threads; nobody's generator is touched."""

import hashlib
import json
import os
import random
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import samplekit
from samplekit._builtin import samplekit_randomizers, samplekit_samplers

pytestmark = pytest.mark.slow

REQUESTS = [
    *(
        (spec.name + suffix, 25 if spec.counts == samplekit.PrimePowers(2) else 16)
        for spec in samplekit_samplers()
        if not any(option.required for option in spec.options)
        for suffix in ("", *(f"+{randomizer.name}" for randomizer in samplekit_randomizers()))
    ),
    ("van-der-corput:base=5", 16),
    ("van-der-corput:base=7+owen", 16),
    ("latin-hypercube", 1026),
    ("multi-jittered", 1026),
    ("correlated-multi-jittered", 1026),
]

PROGRAM = """
import hashlib, json, sys
import samplekit
print(json.dumps([
    hashlib.sha256(samplekit.points(text, count, dims, realizations=2, seed=2**63 + 1).tobytes()).hexdigest()
    for text, count, dims in json.load(sys.stdin)
]))
"""


def with_dims():
    return [(text, count, min(3, samplekit.sampler(text).spec.dimensions[1] or 3)) for text, count in REQUESTS]


def digests():
    return [
        hashlib.sha256(samplekit.points(text, count, dims, realizations=2, seed=2**63 + 1).tobytes()).hexdigest()
        for text, count, dims in with_dims()
    ]


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "plain Python"])
def test_another_process_makes_the_same_points(compiled):
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM],
        input=json.dumps(with_dims()),
        env={**os.environ, "NUMBA_DISABLE_JIT": "0" if compiled else "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    assert [request for request, a, b in zip(REQUESTS, found, digests(), strict=True) if a != b] == []


def test_threads_make_the_same_points():
    expected = digests()
    with ThreadPoolExecutor(4) as pool:
        assert [future.result() for future in [pool.submit(digests) for _ in range(8)]] == [expected] * 8


def test_global_generators_are_neither_read_nor_written():
    random.seed(5)
    np.random.seed(5)  # noqa: NPY002
    states = random.getstate(), np.random.get_state()  # noqa: NPY002
    before = digests()
    assert random.getstate() == states[0]
    for now, then in zip(np.random.get_state(), states[1], strict=True):  # noqa: NPY002
        assert np.array_equal(now, then)
    random.seed(6)
    np.random.seed(6)  # noqa: NPY002
    assert digests() == before


def test_asking_for_points_leaves_no_trace():
    """The same request after others, of other sizes."""
    before = digests()
    for text in ("sobol+owen", "latin-hypercube", "halton"):
        samplekit.points(text, 5000, 7, realizations=3, seed=9)
    assert digests() == before
